// Change points against published values, and how often chance makes one.
#include "metrics/statistics/change_point.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace fernlicht {
namespace {

/// Flow of the Nile at Aswan, 1871 to 1970, 1e8 m3 a year (Cobb 1978): the textbooks' example of one change, after 1898.
const std::vector<double> nile{1120, 1160, 963,  1210, 1160, 1160, 813,  1230, 1370, 1140, 995,  935,  1110, 994, 1020, 960,  1180,
                               799,  958,  1140, 1100, 1210, 1150, 1250, 1260, 1220, 1030, 1100, 774,  840,  874, 694,  940,  833,
                               701,  916,  692,  1020, 1050, 969,  831,  726,  456,  824,  702,  1120, 1100, 832, 764,  821,  768,
                               845,  864,  862,  698,  845,  744,  796,  1040, 759,  781,  865,  845,  944,  984, 897,  822,  1010,
                               771,  676,  649,  846,  812,  742,  801,  1040, 860,  874,  848,  890,  744,  749, 838,  1050, 918,
                               986,  797,  923,  975,  815,  1020, 906,  901,  1170, 912,  746,  919,  718,  714, 740};

/// Normal, by the sum of twelve: the standard's distributions differ from library to library.
double normal_of(std::mt19937_64& generator) {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
        sum += static_cast<double>(generator() >> 11U) * 0x1p-53;
    return sum;
}

/// Times of 10 ms within 1.5 %, `factor` times as long from `from` on.
std::vector<double> noisy_times(std::size_t nights, std::uint64_t seed, std::size_t from = 1000, double factor = 1.0) {
    std::mt19937_64 generator(seed);
    std::vector<double> times;
    for (std::size_t i = 0; i < nights; ++i)
        times.push_back(0.01 * (1.0 + 0.015 * normal_of(generator)) * (i >= from ? factor : 1.0));
    return times;
}

TEST(ChangePoint, TheNileChangesAfter1898) {
    ASSERT_EQ(nile.size(), 100U);
    const std::optional<LevelStep> step = largest_step(nile);
    ASSERT_TRUE(step);
    EXPECT_EQ(step->first, 28U); // 1899 begins the new level
    // sup F = 75.93, as R's strucchange has it (Zeileis et al. 2002).
    EXPECT_NEAR(98.0 * step->z * step->z / (99.0 - step->z * step->z), 75.93, 0.005);
    const std::optional<ChangePoint> change = change_point(nile);
    ASSERT_TRUE(change);
    EXPECT_EQ(change->first, 28U);
    EXPECT_DOUBLE_EQ(change->p, 1e-4); // none of 9999 orders
}

TEST(ChangePoint, ByHand) {
    // Sums off the mean 2: -1, -2, 0; s^2 = 1; scales sqrt(3/4), 1, sqrt(3/4).
    const std::optional<LevelStep> step = largest_step({1.0, 1.0, 3.0, 3.0});
    ASSERT_TRUE(step);
    EXPECT_EQ(step->first, 2U);
    EXPECT_DOUBLE_EQ(step->z, 2.0 / std::sqrt(4.0 / 3.0));
    // Two of six at an end: 2 of the 15 ways to place them.
    const std::optional<ChangePoint> change = change_point({1.0, 1.0, 1.0, 1.0, 2.0, 2.0}, 1, 99999);
    ASSERT_TRUE(change);
    EXPECT_EQ(change->first, 4U);
    EXPECT_NEAR(change->p, 2.0 / 15.0, 0.004); // four standard deviations of 99999 orders
    EXPECT_DOUBLE_EQ(change->ratio, 2.0);
}

TEST(ChangePoint, ChanceMakesOneAsOftenAsItSays) {
    int found = 0;
    constexpr int series = 1000;
    for (std::uint64_t seed = 0; seed < series; ++seed)
        found += change_point(noisy_times(20, seed), 1, 199)->p <= 0.05 ? 1 : 0;
    EXPECT_NEAR(found / 1000.0, 0.05, 4.0 * std::sqrt(0.05 * 0.95 / series));
}

TEST(ChangePoint, OneBadNightIsNoChangeAndHidesNone) {
    std::vector<double> times = noisy_times(30, 5, 22, 1.1);
    times[7] *= 4.0;
    const std::optional<ChangePoint> change = change_point(times);
    ASSERT_TRUE(change);
    EXPECT_EQ(change->first, 22U);
    EXPECT_LT(change->p, 0.001);
    EXPECT_NEAR(change->ratio, 1.1, 0.01);
    std::vector<double> outlier = noisy_times(30, 6);
    outlier.back() *= 4.0;
    EXPECT_GT(change_point(outlier)->p, 0.05);
}

TEST(ChangePoint, SeveralLevelsInSeveralSeries) {
    std::vector<std::vector<double>> series;
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        series.push_back(noisy_times(60, 100 + seed));
    for (std::size_t i = 20; i < 60; ++i)
        series[4][i] *= i < 45 ? 1.1 : 1.1 * 1.2;
    for (std::size_t i = 50; i < 60; ++i)
        series[9][i] *= 0.9;
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (const SeriesChange& one : change_points(series, 0.01))
        found.emplace_back(one.series, one.change.first);
    EXPECT_THAT(found, testing::ElementsAre(std::pair(4, 20), std::pair(4, 45), std::pair(9, 50)));
    EXPECT_NEAR(change_points(series, 0.01)[1].change.ratio, 1.2, 0.02);
}

/// The least p of the usual number of orders is above what a single discovery among so many must pass.
TEST(ChangePoint, OneOfManySeriesIsFound) {
    std::vector<std::vector<double>> series;
    for (std::uint64_t seed = 0; seed < 150; ++seed)
        series.push_back(noisy_times(30, 500 + seed, seed == 77 ? 20 : 1000, 2.0));
    const std::vector<SeriesChange> found = change_points(series, 0.01);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(std::pair(found[0].series, found[0].change.first), std::pair(std::size_t{77}, std::size_t{20}));
    EXPECT_LE(found[0].change.p, 0.1 * 0.01 / 150.0);
    EXPECT_EQ(change_points(series, 0.01)[0].change.p, found[0].change.p);
}

TEST(ChangePoint, TooFewOrEqualSamplesTellNothing) {
    EXPECT_FALSE(change_point(std::vector<double>{1.0, 1.0, 1.0, 2.0, 2.0}));
    EXPECT_FALSE(change_point(std::vector<double>(30, 0.01)));
    EXPECT_FALSE(largest_step(std::vector<double>{1.0}));
    EXPECT_TRUE(change_points(std::vector<std::vector<double>>{{}, {1.0}}, 0.05).empty());
    EXPECT_THROW(change_point({1.0, 0.0}), std::invalid_argument);
    EXPECT_THROW(largest_step({1.0, std::numeric_limits<double>::quiet_NaN()}), std::invalid_argument);
}

/// Benjamini and Hochberg (1995), section 3.2: 15 tests of thrombolysis, of which their procedure finds four at 5 %.
TEST(Discoveries, AsPublished) {
    const std::vector<double> p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                                0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0};
    std::vector<bool> expected(15, false);
    std::fill_n(expected.begin(), 4, true);
    EXPECT_EQ(discoveries(p, 0.05), expected);
    EXPECT_EQ(discoveries({0.04, 0.03}, 0.05), (std::vector{true, true})); // step-up: the larger one carries both
    EXPECT_TRUE(discoveries({}, 0.05).empty());
    EXPECT_THROW(discoveries({1.1}, 0.05), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
