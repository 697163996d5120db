#include "metrics/statistics.h"

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

} // namespace
} // namespace fernlicht
