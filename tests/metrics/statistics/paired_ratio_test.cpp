#include "metrics/statistics/statistics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

namespace fernlicht {
namespace {

std::vector<double> times(const std::vector<double>& reference, const std::vector<double>& ratios) {
    std::vector<double> result;
    for (std::size_t i = 0; i < ratios.size(); ++i)
        result.push_back(reference[i] * ratios[i]);
    return result;
}

const std::vector<double> drifting{1.0, 2.0, 4.0, 8.0, 4.0, 2.0, 1.0}; // the machine slows down eightfold and recovers

TEST(PairedRatio, WhatSlowsTheWholeRoundCancels) {
    const auto ratio = paired_ratio(times(drifting, {1.02, 1.03, 1.02, 1.04, 1.02, 1.03, 1.02}), drifting);
    ASSERT_TRUE(ratio);
    EXPECT_EQ(ratio->rounds, 7U);
    EXPECT_DOUBLE_EQ(ratio->median, 1.02);
    EXPECT_EQ(ratio->difference, Difference::slower);
}

// Type 7 at 0.05 and 0.95 of seven: places 0.3 and 5.7, so between 0.5 and 1 and between 2 and 4 in the logarithm.
TEST(PairedRatio, SpreadLiesBetweenOrderStatisticsOfTheLogarithm) {
    const auto ratio = paired_ratio(times(drifting, {1.0, 4.0, 0.5, 1.0, 2.0, 1.5, 1.5}), drifting);
    ASSERT_TRUE(ratio);
    EXPECT_DOUBLE_EQ(ratio->median, 1.5);
    EXPECT_NEAR(ratio->p05, 0.5 * std::pow(2.0, 0.3), 1e-15);
    EXPECT_NEAR(ratio->p95, 2.0 * std::pow(2.0, 0.7), 1e-14);
    EXPECT_EQ(ratio->difference, Difference::not_distinguishable);
}

TEST(PairedRatio, ADifferenceInsideTheSpreadIsRefused) {
    EXPECT_EQ(paired_ratio(times(drifting, {0.97, 1.02, 1.06, 1.03, 0.98, 1.02, 1.02}), drifting)->difference,
              Difference::not_distinguishable);
    EXPECT_EQ(paired_ratio(times(drifting, {1.001, 1.02, 1.06, 1.03, 1.002, 1.02, 1.02}), drifting)->difference, Difference::slower);
    EXPECT_EQ(paired_ratio(drifting, drifting)->difference, Difference::not_distinguishable);
}

TEST(PairedRatio, ExchangingBothTurnsTheVerdictRound) {
    const std::vector<double> other = times(drifting, {1.3, 1.2, 1.25, 1.4, 1.2, 1.1, 1.6});
    const auto there = paired_ratio(other, drifting), back = paired_ratio(drifting, other);
    EXPECT_EQ(there->difference, Difference::slower);
    EXPECT_EQ(back->difference, Difference::faster);
    EXPECT_NEAR(there->median * back->median, 1.0, 1e-15);
    EXPECT_NEAR(there->p05 * back->p95, 1.0, 1e-15);
}

TEST(PairedRatio, TooFewRoundsTellNothing) {
    EXPECT_FALSE(paired_ratio({}, {}));
    const auto five = paired_ratio({2, 2, 2, 2, 2}, {1, 1, 1, 1, 1}), six = paired_ratio({2, 2, 2, 2, 2, 2}, {1, 1, 1, 1, 1, 1});
    EXPECT_DOUBLE_EQ(five->median, 2.0);
    EXPECT_EQ(five->difference, Difference::not_distinguishable);
    EXPECT_EQ(six->difference, Difference::slower);
}

TEST(PairedRatio, RefusesWhatIsNoTime) {
    EXPECT_THROW(paired_ratio({1.0}, {1.0, 2.0}), std::invalid_argument);
    EXPECT_THROW(paired_ratio({1.0}, {0.0}), std::invalid_argument);
    EXPECT_THROW(paired_ratio({-1.0}, {1.0}), std::invalid_argument);
    EXPECT_THROW(paired_ratio({std::numeric_limits<double>::infinity()}, {1.0}), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
