#include "metrics/statistics/statistics.h"
#include "metrics/statistics/work_precision.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace fernlicht {
namespace {

using Order = std::vector<std::size_t>;

TEST(Spread, OfNothingOfOneSampleAndOfNoNumber) {
    EXPECT_FALSE(spread_of({}));
    const auto one = spread_of({7.0}).value();
    for (const double value : {one.median, one.p05, one.p95, one.minimum, one.maximum, one.mean})
        EXPECT_EQ(value, 7.0);
    EXPECT_EQ(std::tuple(one.count, one.standard_deviation), std::tuple(1U, 0.0));
    EXPECT_THROW(spread_of({1.0, std::nan("")}), std::invalid_argument);
    EXPECT_THROW(spread_of({std::numeric_limits<double>::infinity()}), std::invalid_argument);
}

// Type 7: place = share * (n - 1). For 1, 2, 4, 8: p05 at 0.15 -> 1.15, median at 1.5 -> 3, p95 at 2.85 -> 4 + 0.85 * 4. Squares about the
// mean: 18.0625 + 7.5625 + 3.0625 + 0.0625 = 28.75; over n - 1.
TEST(Spread, QuantilesLieBetweenOrderStatistics) {
    std::vector<double> percents(101);
    std::iota(percents.rbegin(), percents.rend(), 0.0);
    for (const auto& [spread, p05, median, p95] :
         {std::tuple(spread_of({8.0, 1.0, 4.0, 2.0}).value(), 1.15, 3.0, 7.4), std::tuple(spread_of(percents).value(), 5.0, 50.0, 95.0)}) {
        EXPECT_DOUBLE_EQ(spread.p05, p05);
        EXPECT_DOUBLE_EQ(spread.median, median);
        EXPECT_DOUBLE_EQ(spread.p95, p95);
    }
    EXPECT_EQ(std::tuple(spread_of(percents)->minimum, spread_of(percents)->maximum), std::tuple(0.0, 100.0));
    EXPECT_DOUBLE_EQ(spread_of({8.0, 1.0, 4.0, 2.0})->mean, 3.75);
    EXPECT_DOUBLE_EQ(spread_of({8.0, 1.0, 4.0, 2.0})->standard_deviation, std::sqrt(28.75 / 3.0));
    // One-pass variance gives 0 or worse here: the squares agree in all 16 digits.
    EXPECT_DOUBLE_EQ(spread_of({1e9, 1e9 + 1.0, 1e9 + 2.0})->standard_deviation, 1.0);
}

// 1, 1, 2, 4, 9: median 2, distances 1 1 0 2 7.
TEST(InOrder, AsComparingPutsThem) {
    std::vector<float> errors{0.0F, 1e-40F, 3e38F, 0.5F};
    for (int i = 0; i < 5000; ++i)
        errors.push_back(std::ldexp(static_cast<float>(i * 7919 % 5003), i % 90 - 60));
    for (const float odd : {1.0F, -0.0F, -2.0F}) {
        errors.push_back(odd);
        std::vector<float> sorted = errors;
        std::ranges::sort(sorted);
        EXPECT_EQ(in_order(errors), sorted);
    }
}

TEST(MedianAbsoluteDeviation, OfAHandful) {
    EXPECT_FALSE(median_absolute_deviation({}));
    EXPECT_EQ(median_absolute_deviation({4.0, 1.0, 9.0, 2.0, 1.0}), 1.0);
    EXPECT_EQ(median_absolute_deviation({4.0, 1.0, 1e9, 2.0, 1.0}), 1.0);
    EXPECT_EQ(median_absolute_deviation({1.0, 2.0, 4.0, 8.0}), 1.5); // median 3, distances 2 1 1 5
}

// Binomial(n, 1/2): 1 - 2 / 32 = 0.9375 with five, 1 - 2 / 64 = 0.96875 with six; with ten the second from each end holds
// 1 - 2 (1 + 10) / 1024 = 0.978515625, with twenty the sixth 1 - 2 (1 + 20 + 190 + 1140 + 4845 + 15504) / 2^20 = 1 - 43400 / 1048576.
TEST(MedianInterval, AsInTheTablesOfTheSignTest) {
    EXPECT_FALSE(median_interval({}));
    EXPECT_FALSE(median_interval({1.0, 2.0, 3.0, 4.0, 5.0}));
    std::vector<double> samples(20);
    std::iota(samples.rbegin(), samples.rend(), 1.0);
    const auto of_first = [&](std::ptrdiff_t n) { return median_interval({samples.end() - n, samples.end()}).value(); };
    const auto expect = [](const MedianInterval& interval, double low, double high, double confidence) {
        EXPECT_EQ(std::tuple(interval.low, interval.high), std::tuple(low, high));
        EXPECT_NEAR(interval.confidence, confidence, 1e-14);
    };
    expect(of_first(6), 1.0, 6.0, 0.96875);
    expect(of_first(10), 2.0, 9.0, 0.978515625);
    expect(of_first(20), 6.0, 15.0, 1.0 - 43400.0 / 1048576.0);
    expect(median_interval({7.0, 3.0}, 0.5).value(), 3.0, 7.0, 0.5);
}

// The normal approximation gives the k-th from each end with k = n / 2 - 1.96 sqrt(n) / 2 = 956.2.
TEST(MedianInterval, HoldsForMoreSamplesThanTheSmallestDoubleHasHalvings) {
    std::vector<double> samples(2000);
    std::iota(samples.begin(), samples.end(), 1.0);
    const auto interval = median_interval(samples);
    ASSERT_TRUE(interval);
    EXPECT_EQ(std::tuple(interval->low, interval->high), std::tuple(956.0, 2001.0 - interval->low));
    EXPECT_NEAR(interval->confidence, 0.9534471795082162, 1e-9); // by whole numbers
    EXPECT_THROW(median_interval({1.0, std::nan("")}), std::invalid_argument);
}

// Two-sided quantiles from printed tables of Student's t (NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2).
TEST(SpreadTest, BoundsAreThoseOfPrintedTables) {
    EXPECT_NEAR(spread_test({2, 1.0}, {1, 0.0}, 0.05, 1)->bound, 12.706, 5e-4);
    EXPECT_NEAR(spread_test({6, 1.0}, {1, 0.0}, 0.05, 1)->bound, 2.571, 5e-4);
    EXPECT_NEAR(spread_test({6, 1.0}, {6, 1.0}, 0.01, 1)->bound, 3.169, 5e-4);
    EXPECT_NEAR(spread_test({101, 1.0}, {1, 0.0}, 0.002, 1)->bound, 3.174, 5e-4);
    EXPECT_NEAR(normal_bound(0.05, 1), 1.960, 5e-4);
    EXPECT_NEAR(normal_bound(0.01, 1), 2.576, 5e-4);
    EXPECT_DOUBLE_EQ(spread_test({6, 1.0}, {1, 0.0}, 0.05, 5)->bound, spread_test({6, 1.0}, {1, 0.0}, 0.01, 1)->bound);
    EXPECT_DOUBLE_EQ(normal_bound(0.05, 5), normal_bound(0.01, 1));
}

// By hand: samples {1, 2, 3} (variance 1) and {4, 6} (variance 2): s^2 = (2*1 + 1*2) / 3 = 4/3, error sqrt(4/3 (1/3 + 1/2)) = sqrt(10/9).
TEST(SpreadTest, StandardErrorByHandAndNoTestWithoutSpread) {
    const auto test = spread_test({3, 1.0}, {2, 2.0}, 0.05, 1);
    ASSERT_TRUE(test);
    EXPECT_EQ(test->freedom, 3);
    EXPECT_NEAR(test->standard_error, std::sqrt(10.0 / 9.0), 1e-15);
    EXPECT_NEAR(spread_test({4, 9.0}, {1, 0.0}, 0.05, 1)->standard_error, 3.0 * std::sqrt(1.25), 1e-15);
    EXPECT_FALSE(spread_test({1, 0.0}, {1, 0.0}, 0.05, 1));
    EXPECT_FALSE(spread_test({9, 0.0}, {9, 0.0}, 0.05, 1));
    EXPECT_THROW(spread_test({0, 0.0}, {1, 0.0}, 0.05, 1), std::invalid_argument);
    EXPECT_THROW(spread_test({2, -1.0}, {1, 0.0}, 0.05, 1), std::invalid_argument);
    EXPECT_THROW(spread_test({2, std::numeric_limits<double>::quiet_NaN()}, {1, 0.0}, 0.05, 1), std::invalid_argument);
    EXPECT_THROW(spread_test({2, 1.0}, {1, 0.0}, 0.0, 1), std::invalid_argument);
    EXPECT_THROW(spread_test({2, 1.0}, {1, 0.0}, 0.05, 0), std::invalid_argument);
    EXPECT_THROW(normal_bound(1.0, 1), std::invalid_argument);
}

std::vector<double> times(const std::vector<double>& reference, const std::vector<double>& ratios) {
    std::vector<double> result;
    for (std::size_t i = 0; i < ratios.size(); ++i)
        result.push_back(reference[i] * ratios[i]);
    return result;
}

const std::vector<double> drifting{1.0, 2.0, 4.0, 8.0, 4.0, 2.0, 1.0}; // the machine slows down eightfold and recovers

// What slows the whole round cancels. Type 7 at 0.05 and 0.95 of seven: places 0.3 and 5.7, so between 0.5 and 1 and between 2 and 4 in the
// logarithm.
TEST(PairedRatio, MedianAndSpreadAreThoseOfTheLogarithm) {
    const auto even = paired_ratio(times(drifting, {1.02, 1.03, 1.02, 1.04, 1.02, 1.03, 1.02}), drifting).value(),
               uneven = paired_ratio(times(drifting, {1.0, 4.0, 0.5, 1.0, 2.0, 1.5, 1.5}), drifting).value();
    EXPECT_EQ(std::tuple(even.rounds, even.difference), std::tuple(7U, Difference::slower));
    EXPECT_DOUBLE_EQ(even.median, 1.02);
    EXPECT_DOUBLE_EQ(uneven.median, 1.5);
    EXPECT_NEAR(uneven.p05, 0.5 * std::pow(2.0, 0.3), 1e-15);
    EXPECT_NEAR(uneven.p95, 2.0 * std::pow(2.0, 0.7), 1e-14);
    EXPECT_EQ(uneven.difference, Difference::not_distinguishable);
}

TEST(PairedRatio, ADifferenceInsideTheSpreadIsRefusedAndExchangingBothTurnsIt) {
    EXPECT_EQ(paired_ratio(times(drifting, {0.97, 1.02, 1.06, 1.03, 0.98, 1.02, 1.02}), drifting)->difference,
              Difference::not_distinguishable);
    EXPECT_EQ(paired_ratio(times(drifting, {1.001, 1.02, 1.06, 1.03, 1.002, 1.02, 1.02}), drifting)->difference, Difference::slower);
    EXPECT_EQ(paired_ratio(drifting, drifting)->difference, Difference::not_distinguishable);
    const std::vector<double> other = times(drifting, {1.3, 1.2, 1.25, 1.4, 1.2, 1.1, 1.6});
    const auto there = paired_ratio(other, drifting), back = paired_ratio(drifting, other);
    EXPECT_EQ(there->difference, Difference::slower);
    EXPECT_EQ(back->difference, Difference::faster);
    EXPECT_NEAR(there->median * back->median, 1.0, 1e-15);
    EXPECT_NEAR(there->p05 * back->p95, 1.0, 1e-15);
}

TEST(PairedRatio, TooFewRoundsTellNothingAndNoTimesAreRefused) {
    EXPECT_FALSE(paired_ratio({}, {}));
    const auto five = paired_ratio({2, 2, 2, 2, 2}, {1, 1, 1, 1, 1}), six = paired_ratio({2, 2, 2, 2, 2, 2}, {1, 1, 1, 1, 1, 1});
    EXPECT_DOUBLE_EQ(five->median, 2.0);
    EXPECT_EQ(five->difference, Difference::not_distinguishable);
    EXPECT_EQ(six->difference, Difference::slower);
    EXPECT_THROW(paired_ratio({1.0}, {1.0, 2.0}), std::invalid_argument);
    EXPECT_THROW(paired_ratio({1.0}, {0.0}), std::invalid_argument);
    EXPECT_THROW(paired_ratio({-1.0}, {1.0}), std::invalid_argument);
    EXPECT_THROW(paired_ratio({std::numeric_limits<double>::infinity()}, {1.0}), std::invalid_argument);
}

// By an implementation of mt19937-64 and of the shuffle in another language.
TEST(RandomOrder, IsTheSeedsOwnOnEveryMachine) {
    std::mt19937_64 generator(1);
    for (const Order& expected : {Order{4, 6, 3, 5, 1, 7, 2, 0}, Order{0, 5, 6, 3, 7, 4, 2, 1}, Order{7, 5, 2, 3, 0, 1, 6, 4}})
        EXPECT_EQ(random_order(8, generator), expected);
    generator.seed(2);
    EXPECT_EQ(random_order(8, generator), (Order{7, 5, 2, 0, 3, 1, 6, 4}));
    EXPECT_EQ(random_order(0, generator), Order{});
    EXPECT_EQ(random_order(1, generator), Order{0});
}

// 6000 draws among 6 orders: each 1000 times, give or take 5 deviations of sqrt(6000 / 6 * 5 / 6) = 29.
TEST(RandomOrder, EveryOrderComesEquallyOften) {
    std::mt19937_64 generator(3);
    std::map<Order, int> seen;
    for (int i = 0; i < 6000; ++i)
        ++seen[random_order(3, generator)];
    EXPECT_EQ(seen.size(), 6U);
    for (const auto& [order, times] : seen)
        EXPECT_NEAR(times, 1000, 145) << order[0] << order[1] << order[2];
}

// Of 2^64 numbers the remainders of 3 * 2^62 would come twice as often below 2^62 as above, were none drawn again.
TEST(Below, FavoursNoNumber) {
    std::mt19937_64 generator(4);
    constexpr std::uint64_t third = std::uint64_t{1} << 62;
    int low = 0;
    for (int i = 0; i < 3000; ++i) {
        const std::uint64_t drawn = below(3 * third, generator);
        ASSERT_LT(drawn, 3 * third);
        low += drawn < third ? 1 : 0;
    }
    EXPECT_NEAR(low, 1000, 130); // 5 deviations of sqrt(3000 / 3 * 2 / 3)
    EXPECT_THROW(below(0, generator), std::invalid_argument);
}

/// Bars of a tenth each way, of seven timings.
WorkPrecisionRow row(const char* label, double error, double seconds, double floor = 0.0) {
    return {.label = label,
            .error = Interval{error, 0.9 * error, 1.1 * error},
            .seconds = Interval{seconds, 0.9 * seconds, 1.1 * seconds, 7, true},
            .floor = floor};
}

TEST(WorkPrecision, FrontIsWhatNobodyBeatsInBoth) {
    const std::vector<Standing> s = standings({row("quick", 10.0, 1.0), row("middle", 3.0, 2.0), row("exact", 1.0, 4.0),
                                               row("slow", 3.0, 3.0), row("bad", 20.0, 5.0), row("near", 3.05, 2.02)});
    EXPECT_TRUE(s[0].on_front && s[1].on_front && s[2].on_front);
    EXPECT_FALSE(s[3].on_front);
    EXPECT_EQ(s[3].dominated_by, 1U); // as exact, and faster
    EXPECT_TRUE(s[3].surely);
    EXPECT_TRUE(s[4].surely);         // farther off and slower, both beyond the bars
    EXPECT_EQ(s[4].dominated_by, 2U); // by all of them; the one with the least error is named
    EXPECT_EQ(s[5].dominated_by, 1U);
    EXPECT_FALSE(s[5].surely); // bars overlap in both
    EXPECT_FALSE(s[0].dominated_by);
}

TEST(WorkPrecision, OneSureAdvantageIsNotEnoughWhereTheOtherIsInDoubt) {
    const std::vector<Standing> s = standings({row("a", 1.0, 1.0), row("far off", 9.0, 1.05), row("slow", 1.05, 9.0)});
    EXPECT_EQ(s[1].dominated_by, 0U);
    EXPECT_FALSE(s[1].surely); // it may be the faster one
    EXPECT_EQ(s[2].dominated_by, 0U);
    EXPECT_FALSE(s[2].surely); // it may be the more exact one
}

TEST(WorkPrecision, FewTimingsMakeNothingSure) {
    WorkPrecisionRow good = row("good", 1.0, 1.0), bad = row("bad", 9.0, 9.0);
    const auto sure = [&](std::size_t of_good, std::size_t of_bad) {
        good.seconds->samples = of_good;
        bad.seconds->samples = of_bad;
        const std::vector<Standing> s = standings({good, bad});
        EXPECT_EQ(s[1].dominated_by, 0U); // by its figures it is
        return s[1].surely;
    };
    EXPECT_TRUE(sure(3, 3)); // in one order of 20
    EXPECT_FALSE(sure(1, 7));
    EXPECT_FALSE(sure(7, 1));
    EXPECT_FALSE(sure(2, 2));
    EXPECT_FALSE(sure(0, 0));
    bad.seconds = good.seconds = {1.0, 1.0, 1.0, 1}; // the same time, found once
    EXPECT_FALSE(standings({good, bad})[1].surely);
    good.error = bad.error;
    good.seconds->value = 0.5;
    good.seconds->high = 0.5;
    EXPECT_FALSE(standings({good, bad})[1].surely); // as exact, and once found to be faster
}

TEST(WorkPrecision, EqualsDoNotBeatOneAnotherAndWhatIsNotMeasuredHasNoStanding) {
    const std::vector<Standing> equal = standings({row("a", 1.0, 1.0), row("b", 1.0, 1.0)});
    EXPECT_TRUE(equal[0].on_front && equal[1].on_front);
    WorkPrecisionRow none = row("none", 0.0, 0.1);
    none.error.reset();
    const std::vector<Standing> s = standings({none, row("a", 1.0, 1.0)});
    EXPECT_FALSE(s[0].on_front || s[0].dominated_by);
    EXPECT_TRUE(s[1].on_front);
    EXPECT_TRUE(standings({}).empty());
}

TEST(WorkPrecision, BelowTheFloorNobodyIsBetter) {
    const WorkPrecisionRow a = row("a", 0.2, 1.0, 0.5), b = row("b", 0.01, 2.0, 0.5);
    EXPECT_TRUE(a.below_floor());
    EXPECT_EQ(b.claimed_error(), 0.5);
    const std::vector<Standing> s = standings({a, b});
    EXPECT_TRUE(s[0].on_front);
    EXPECT_EQ(s[1].dominated_by, 0U); // no more exact as far as can be known, and slower
    EXPECT_EQ(row("c", 0.6, 1.0, 0.5).claimed_error(), 0.6);
}

TEST(WorkPrecision, SlopeOfAPowerIsItsExponent) {
    std::vector<std::pair<double, double>> points;
    for (const double work : {1.0, 4.0, 16.0, 100.0})
        points.emplace_back(work, 7.0 * std::pow(work, -0.5));
    EXPECT_NEAR(logarithmic_slope(points).value(), -0.5, 1e-12);
    points.emplace_back(1000.0, 0.0); // no logarithm: left out
    EXPECT_NEAR(logarithmic_slope(points).value(), -0.5, 1e-12);
    EXPECT_FALSE(logarithmic_slope({{2.0, 1.0}, {2.0, 3.0}}));
    EXPECT_FALSE(logarithmic_slope({}));
}

// Abramowitz and Stegun 1964, table 26.8.
TEST(ChiSquaredBound, IsTheTables) {
    EXPECT_NEAR(chi_squared_bound(1, 0.001), 10.828, 5e-4);
    EXPECT_NEAR(chi_squared_bound(10, 0.001), 29.588, 5e-4);
    EXPECT_NEAR(chi_squared_bound(30, 0.05), 43.773, 5e-4);
    EXPECT_THROW(chi_squared_bound(0, 0.001), std::invalid_argument);
    EXPECT_THROW(chi_squared_bound(3, 0.0), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
