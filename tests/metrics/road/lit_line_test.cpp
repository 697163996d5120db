#include "metrics/road/lit_line.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(Crossing, IsStraightInTheLogarithmAndFallsBackWhereItIsDark) {
    EXPECT_DOUBLE_EQ(crossing_share(100.0, 1.0, 10.0), 0.5);
    EXPECT_DOUBLE_EQ(crossing_share(1.0, 100.0, 10.0), 0.5);
    EXPECT_DOUBLE_EQ(crossing_share(10.0, 0.0, 4.0), 0.6);
    EXPECT_DOUBLE_EQ(crossing_share(5.0, 1.0, 5.0), 0.0);
    EXPECT_DOUBLE_EQ(between_samples(100.0, 1.0, 0.5), 10.0);
    EXPECT_DOUBLE_EQ(between_samples(10.0, 0.0, 0.25), 7.5);
}

TEST(LitLine, NothingLit) {
    const LitLine line = lit_line({{0.0, 0.5}, {1.0, 0.9}, {2.0, 0.0}}, 1.0);
    EXPECT_FALSE(line.lit);
    EXPECT_EQ(line.last_m, 0.0);
    EXPECT_EQ(line.lit_m, 0.0);
    EXPECT_EQ(line.unlit_before_last_m, 0.0);
    EXPECT_FALSE(line.lit_at_end);
}

// Dark to 1.5, lit to 3.5, dark to 5.5, lit to 6.5: crossings half way, 100 : 1 about 10.
TEST(LitLine, GapsBeforeTheReachAreAddedUp) {
    const LitLine line =
        lit_line({{0.0, 1.0}, {1.0, 1.0}, {2.0, 100.0}, {3.0, 100.0}, {4.0, 1.0}, {5.0, 1.0}, {6.0, 100.0}, {7.0, 1.0}, {8.0, 1.0}}, 10.0);
    EXPECT_TRUE(line.lit);
    EXPECT_DOUBLE_EQ(line.first_m, 1.5);
    EXPECT_DOUBLE_EQ(line.last_m, 6.5);
    EXPECT_DOUBLE_EQ(line.lit_m, 3.0);
    EXPECT_DOUBLE_EQ(line.unlit_before_last_m, 3.5);
    EXPECT_FALSE(line.lit_at_end);
}

TEST(LitLine, ExactlyTheLimitIsLit) {
    const LitLine line = lit_line({{0.0, 5.0}, {1.0, 5.0}, {2.0, 1.0}}, 5.0);
    EXPECT_DOUBLE_EQ(line.last_m, 1.0);
    EXPECT_DOUBLE_EQ(line.lit_m, 1.0);
}

TEST(LitLine, ALitSampleBetweenDarkOnesCounts) {
    const LitLine line = lit_line({{0.0, 0.0}, {1.0, 10.0}, {2.0, 0.0}}, 5.0);
    EXPECT_DOUBLE_EQ(line.first_m, 0.5);
    EXPECT_DOUBLE_EQ(line.last_m, 1.5);
}

TEST(LitLine, WhatWasNotLookedAtIsNeitherLitNorDark) {
    const LitLine line = lit_line({{0.0, 9.0}, {1.0, 9.0}, {2.0, std::nullopt}, {3.0, 9.0}, {4.0, 9.0}, {5.0, std::nullopt}}, 5.0);
    EXPECT_DOUBLE_EQ(line.lit_m, 2.0);
    EXPECT_DOUBLE_EQ(line.last_m, 4.0);
    EXPECT_EQ(line.unlit_before_last_m, 0.0);
    EXPECT_TRUE(line.lit_at_end);
}

TEST(LitLine, EmptyAndSingle) {
    EXPECT_FALSE(lit_line({}, 1.0).lit);
    const LitLine one = lit_line({{3.0, 2.0}}, 1.0);
    EXPECT_TRUE(one.lit);
    EXPECT_EQ(one.last_m, 3.0);
    EXPECT_TRUE(one.lit_at_end);
}

} // namespace
} // namespace fernlicht
