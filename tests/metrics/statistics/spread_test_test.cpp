#include "metrics/statistics/statistics.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

namespace fernlicht {
namespace {

// Two-sided quantiles from printed tables of Student's t (NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2).
TEST(SpreadTest, BoundsAreThoseOfPrintedTables) {
    EXPECT_NEAR(spread_test({2, 1.0}, {1, 0.0}, 0.05, 1)->bound, 12.706, 5e-4);
    EXPECT_NEAR(spread_test({6, 1.0}, {1, 0.0}, 0.05, 1)->bound, 2.571, 5e-4);
    EXPECT_NEAR(spread_test({6, 1.0}, {6, 1.0}, 0.01, 1)->bound, 3.169, 5e-4);
    EXPECT_NEAR(spread_test({101, 1.0}, {1, 0.0}, 0.002, 1)->bound, 3.174, 5e-4);
    EXPECT_NEAR(normal_bound(0.05, 1), 1.960, 5e-4);
    EXPECT_NEAR(normal_bound(0.01, 1), 2.576, 5e-4);
}

TEST(SpreadTest, ManyComparisonsShareTheFalseAlarm) {
    EXPECT_DOUBLE_EQ(spread_test({6, 1.0}, {1, 0.0}, 0.05, 5)->bound, spread_test({6, 1.0}, {1, 0.0}, 0.01, 1)->bound);
    EXPECT_DOUBLE_EQ(normal_bound(0.05, 5), normal_bound(0.01, 1));
}

// By hand: samples {1, 2, 3} (variance 1) and {4, 6} (variance 2): s^2 = (2*1 + 1*2) / 3 = 4/3, error sqrt(4/3 (1/3 + 1/2)) = sqrt(10/9).
TEST(SpreadTest, StandardErrorByHand) {
    const auto test = spread_test({3, 1.0}, {2, 2.0}, 0.05, 1);
    ASSERT_TRUE(test);
    EXPECT_EQ(test->freedom, 3);
    EXPECT_NEAR(test->standard_error, std::sqrt(10.0 / 9.0), 1e-15);
    EXPECT_NEAR(spread_test({4, 9.0}, {1, 0.0}, 0.05, 1)->standard_error, 3.0 * std::sqrt(1.25), 1e-15);
}

TEST(SpreadTest, NothingThatVariesIsNoTest) {
    EXPECT_FALSE(spread_test({1, 0.0}, {1, 0.0}, 0.05, 1));
    EXPECT_FALSE(spread_test({9, 0.0}, {9, 0.0}, 0.05, 1));
}

TEST(SpreadTest, RefusesWhatIsNoSample) {
    EXPECT_THROW(spread_test({0, 0.0}, {1, 0.0}, 0.05, 1), std::invalid_argument);
    EXPECT_THROW(spread_test({2, -1.0}, {1, 0.0}, 0.05, 1), std::invalid_argument);
    EXPECT_THROW(spread_test({2, std::numeric_limits<double>::quiet_NaN()}, {1, 0.0}, 0.05, 1), std::invalid_argument);
    EXPECT_THROW(spread_test({2, 1.0}, {1, 0.0}, 0.0, 1), std::invalid_argument);
    EXPECT_THROW(spread_test({2, 1.0}, {1, 0.0}, 0.05, 0), std::invalid_argument);
    EXPECT_THROW(normal_bound(1.0, 1), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
