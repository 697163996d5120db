#include "metrics/statistics/work_precision.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// Bars of a tenth each way, of seven timings.
WorkPrecisionRow row(const char* label, double error, double seconds, double floor = 0.0) {
    WorkPrecisionRow r;
    r.label = label;
    r.error = {error, 0.9 * error, 1.1 * error};
    r.seconds = {seconds, 0.9 * seconds, 1.1 * seconds, 7, true};
    r.floor = floor;
    return r;
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

TEST(WorkPrecision, EqualsDoNotBeatOneAnother) {
    const std::vector<Standing> s = standings({row("a", 1.0, 1.0), row("b", 1.0, 1.0)});
    EXPECT_TRUE(s[0].on_front && s[1].on_front);
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

TEST(WorkPrecision, WhatIsNotMeasuredHasNoStanding) {
    WorkPrecisionRow none = row("none", 0.0, 0.1);
    none.error.reset();
    const std::vector<Standing> s = standings({none, row("a", 1.0, 1.0)});
    EXPECT_FALSE(s[0].on_front);
    EXPECT_FALSE(s[0].dominated_by);
    EXPECT_TRUE(s[1].on_front);
    EXPECT_TRUE(standings({}).empty());
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

} // namespace
} // namespace fernlicht
