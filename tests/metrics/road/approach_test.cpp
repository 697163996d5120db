#include "metrics/road/approach.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// 10 m/s from 40 m away to the place: 1, 2, 8, 2, 0 lx.
const Approach course{{0.0, 40.0, 1.0}, {1.0, 30.0, 2.0}, {2.0, 20.0, 8.0}, {3.0, 10.0, 2.0}, {4.0, 0.0, 0.0}};

TEST(Approach, RunsStraightInTheLogarithm) {
    EXPECT_DOUBLE_EQ(value_at(course, 30.0).number().value(), 2.0);
    EXPECT_NEAR(value_at(course, 25.0).number().value(), 4.0, 1e-12); // half way from 2 to 8
    EXPECT_NEAR(value_at(course, 5.0).number().value(), 1.0, 1e-12) << "towards the dark in the value itself";
    EXPECT_DOUBLE_EQ(value_at(course, 0.0).number().value(), 0.0);
    EXPECT_THAT(value_at(course, 41.0).reason(), HasSubstr("from 40.0 m away to 0.0 m"));
    EXPECT_FALSE(value_at({}, 5.0).measured());
}

TEST(Approach, IsReachedFromFarthestAway) {
    EXPECT_NEAR(reached_from_m(course, 4.0, false).number().value(), 25.0, 1e-12); // between 2 and 8
    EXPECT_NEAR(reached_from_m(course, 2.0, false).number().value(), 30.0, 1e-12);
    EXPECT_EQ(reached_from_m(course, 9.0, false).number().value(), 0.0) << "nowhere";
    EXPECT_EQ(reached_from_m(course, 1.0, false), Value::at_least(40.0)) << "from the first moment on";
    EXPECT_FALSE(reached_from_m({}, 1.0, false).measured());
}

TEST(Approach, WhatWasNotDrivenIsNotDark) {
    const Approach cut(course.begin(), course.begin() + 2); // ends 30 m before the place with 2 lx
    EXPECT_EQ(cut_short(cut, false), "the drive comes from 40.0 m to 30.0 m before it");
    EXPECT_EQ(reached_from_m(cut, 9.0, false), Value::at_most(30.0)) << "what is nearer was not driven";
    EXPECT_EQ(reached_from_m(cut, 9.0, true), Value(0.0)) << "the next moment was beyond the place";
    EXPECT_NEAR(reached_from_m(cut, std::sqrt(2.0), false).number().value(), 35.0, 1e-12) << "it came far enough to know this";
    EXPECT_EQ(cut_short(Approach(course.begin(), course.begin() + 4), false), "") << "10 m are near enough";
    EXPECT_EQ(cut_short({}, false), "");
}

TEST(Approach, CountsTimeAndLengthOnBothSides) {
    const Stretch lit = at_or_above(course, 4.0); // from 25 m to 15 m
    EXPECT_NEAR(lit.length_m, 10.0, 1e-12);
    EXPECT_NEAR(lit.time_s, 1.0, 1e-12);
    EXPECT_NEAR(below(course, 4.0).time_s, 3.0, 1e-12);
    EXPECT_NEAR(below(course, 4.0).length_m, 30.0, 1e-12);
    Approach away = course; // distances gone instead of those to go
    for (ApproachSample& sample : away)
        sample.distance_m = 100.0 - sample.distance_m;
    EXPECT_NEAR(at_or_above(away, 4.0).length_m, 10.0, 1e-12);
}

TEST(Approach, LeavesOutWhatWasNotMeasured) {
    Approach gap = course;
    gap[3].value.reset();
    EXPECT_NEAR(at_or_above(gap, 4.0).time_s, 0.5, 1e-12) << "from 25 m to 20 m; nothing runs through the gap";
    EXPECT_NEAR(below(gap, 4.0).time_s, 1.5, 1e-12);
    EXPECT_FALSE(value_at(gap, 15.0).measured());
    EXPECT_EQ(largest(gap), 8.0);
    EXPECT_EQ(smallest(gap), 0.0);
    EXPECT_EQ(smallest({{0.0, 1.0, std::nullopt}}), std::nullopt);
}

} // namespace
} // namespace fernlicht
