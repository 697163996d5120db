#include "metrics/statistics/statistics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>

namespace fernlicht {
namespace {

TEST(Spread, NothingGivesNothing) { EXPECT_FALSE(spread_of({})); }

TEST(Spread, OneSampleIsAllOfIt) {
    const auto spread = spread_of({7.0});
    ASSERT_TRUE(spread);
    EXPECT_EQ(spread->count, 1U);
    for (const double value : {spread->median, spread->p05, spread->p95, spread->minimum, spread->maximum, spread->mean})
        EXPECT_EQ(value, 7.0);
    EXPECT_EQ(spread->standard_deviation, 0.0);
}

// Type 7: place = share * (n - 1). For 1, 2, 4, 8: p05 at 0.15 -> 1.15, median at 1.5 -> 3, p95 at 2.85 -> 4 + 0.85 * 4.
TEST(Spread, QuantilesLieBetweenOrderStatistics) {
    const auto spread = spread_of({8.0, 1.0, 4.0, 2.0});
    ASSERT_TRUE(spread);
    EXPECT_DOUBLE_EQ(spread->p05, 1.15);
    EXPECT_DOUBLE_EQ(spread->median, 3.0);
    EXPECT_DOUBLE_EQ(spread->p95, 7.4);
    EXPECT_DOUBLE_EQ(spread->mean, 3.75);
    // Squares about the mean: 18.0625 + 7.5625 + 3.0625 + 0.0625 = 28.75; over n - 1.
    EXPECT_DOUBLE_EQ(spread->standard_deviation, std::sqrt(28.75 / 3.0));
}

TEST(Spread, HundredAndOneStepsHitTheirPercents) {
    std::vector<double> samples(101);
    std::iota(samples.rbegin(), samples.rend(), 0.0);
    const auto spread = spread_of(samples);
    ASSERT_TRUE(spread);
    EXPECT_DOUBLE_EQ(spread->p05, 5.0);
    EXPECT_DOUBLE_EQ(spread->median, 50.0);
    EXPECT_DOUBLE_EQ(spread->p95, 95.0);
    EXPECT_EQ(spread->minimum, 0.0);
    EXPECT_EQ(spread->maximum, 100.0);
}

// One-pass variance gives 0 or worse here: the squares agree in all 16 digits.
TEST(Spread, DeviationSurvivesAFarMean) {
    const auto spread = spread_of({1e9, 1e9 + 1.0, 1e9 + 2.0});
    ASSERT_TRUE(spread);
    EXPECT_DOUBLE_EQ(spread->standard_deviation, 1.0);
}

TEST(Spread, RefusesWhatIsNoNumber) {
    EXPECT_THROW(spread_of({1.0, std::nan("")}), std::invalid_argument);
    EXPECT_THROW(spread_of({std::numeric_limits<double>::infinity()}), std::invalid_argument);
}

// 1, 1, 2, 4, 9: median 2, distances 1 1 0 2 7.
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
        EXPECT_EQ(interval.low, low);
        EXPECT_EQ(interval.high, high);
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
    EXPECT_EQ(interval->low, 956.0);
    EXPECT_EQ(interval->high, 2001.0 - interval->low);
    EXPECT_NEAR(interval->confidence, 0.9534471795082162, 1e-9); // by whole numbers
    EXPECT_THROW(median_interval({1.0, std::nan("")}), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
