// Bins, rounding, exclusion and interpolated limits against values worked out by hand.
#include "metrics/rating/light_limits.h"

#include <array>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// One sample a tick of 0.02 s: distance and light.
LightApproach nearing(std::initializer_list<std::pair<double, double>> distance_and_lx) {
    LightApproach approach;
    for (const auto& [distance_m, lx] : distance_and_lx) {
        const int tick = static_cast<int>(approach.size());
        approach.push_back({tick, 0.02 * tick, distance_m, lx, 0.0, false});
    }
    return approach;
}

LimitCurve far_ranges() {
    LimitCurve curve;
    curve.ranges = {{60.0, 120.0, 0.6, {}}, {120.0, 220.0, 0.3, {}}};
    return curve;
}

JudgingRules rounding() {
    JudgingRules rules;
    rules.round_lx = 0.1;
    return rules;
}

TEST(RatingRounding, IsThatOfAstmE29) {
    for (const auto& [value, step, rounded] : std::initializer_list<std::array<double, 3>>{{0.349, 0.1, 0.3},
                                                                                           {0.35, 0.1, 0.4}, // halves to the even one
                                                                                           {0.25, 0.1, 0.2},
                                                                                           {0.45, 0.1, 0.4},
                                                                                           {3.15, 0.1, 3.2},
                                                                                           {18.95, 0.1, 19.0},
                                                                                           {0.05, 0.1, 0.0},
                                                                                           {0.3, 0.1, 0.3},
                                                                                           {0.375, 0.25, 0.5},
                                                                                           {12.5, 5.0, 10.0},
                                                                                           {0.04999, 0.1, 0.0}})
        EXPECT_DOUBLE_EQ(rounded_to(value, step), rounded) << value << " to " << step;
}

TEST(LightLimits, TakesTheMaximumOfEachRangeRounded) {
    const LightApproach approach =
        nearing({{230.0, 9.0}, {220.0, 0.34}, {170.0, 0.2}, {120.0, 0.33}, {119.9, 0.64}, {60.0, 0.65}, {59.0, 9.0}});
    const auto ranges = judge_light(approach, far_ranges(), 15.0, 220.0, rounding());
    ASSERT_EQ(ranges.size(), 2U);
    EXPECT_EQ(ranges[0].verdict, RatingVerdict::within); // 0.65 is 0.6, for 6 is even
    EXPECT_EQ(ranges[0].worst->distance_m, 60.0);
    EXPECT_EQ(ranges[0].samples, 2U); // 120 m begins the next range
    EXPECT_DOUBLE_EQ(*ranges[0].lx, 0.6);
    EXPECT_DOUBLE_EQ(ranges[0].margin(), 0.0);
    EXPECT_EQ(ranges[1].verdict, RatingVerdict::within);
    EXPECT_EQ(ranges[1].samples, 3U); // the last range has its end
    EXPECT_EQ(ranges[1].worst->tick, 1);
    const auto unrounded = judge_light(approach, far_ranges(), 15.0, 220.0, {});
    EXPECT_EQ(unrounded[0].verdict, RatingVerdict::exceeded);
    EXPECT_NEAR(unrounded[1].margin(), (0.3 - 0.34) / 0.3, 1e-12);
}

TEST(LightLimits, MeasuresWhereTheRowDoesAndSaysWhereTheDriveDoesNot) {
    const LightApproach approach = nearing({{150.0, 0.1}, {100.0, 0.7}, {50.0, 0.1}});
    const auto near = judge_light(approach, far_ranges(), 15.0, 80.0, rounding());
    ASSERT_EQ(near.size(), 1U);
    EXPECT_EQ(near[0].range.to_m, 80.0);
    EXPECT_EQ(near[0].verdict, RatingVerdict::not_measured); // no moment between 60 and 80 m
    const auto far = judge_light(approach, far_ranges(), 15.0, 220.0, rounding());
    EXPECT_EQ(far[0].verdict, RatingVerdict::exceeded);
    EXPECT_EQ(far[1].verdict, RatingVerdict::not_measured);
    EXPECT_EQ(far[1].why, "the drive has light from 50.0 to 150.0 m only");
    EXPECT_EQ(judge_light({}, far_ranges(), 15.0, 220.0, rounding())[0].verdict, RatingVerdict::not_measured);
}

TEST(LightLimits, RunLinearlyBetweenTheEndsOfARange) {
    LimitCurve curve;
    curve.ranges = {{20.0, 40.0, 3.0, 1.0}};
    const LightApproach approach = nearing({{45.0, 0.0}, {30.0, 2.1}, {22.0, 2.7}, {19.0, 0.0}}); // limits 2.0 and 2.8
    const auto ranges = judge_light(approach, curve, 15.0, 220.0, {});
    EXPECT_EQ(ranges[0].verdict, RatingVerdict::exceeded);
    EXPECT_EQ(ranges[0].worst->distance_m, 30.0);
    EXPECT_NEAR(*ranges[0].limit_lx, 2.0, 1e-12);
    EXPECT_NEAR(ranges[0].margin(), -0.05, 1e-12);
    const LimitRange cut = judge_light(approach, curve, 25.0, 35.0, {})[0].range;
    EXPECT_NEAR(*cut.at_most_lx, 2.5, 1e-12);
    EXPECT_NEAR(*cut.at_most_lx_far, 1.5, 1e-12);
}

TEST(LightLimits, LeaveOutWhatPitchesAwayFromTheMean) {
    LightApproach approach = nearing({{300.0, 0.1}, {200.0, 0.1}, {180.0, 5.0}, {160.0, 0.2}, {140.0, 0.1}, {130.0, 0.1}, {110.0, 0.1}});
    approach[0].pitch_deg = 50.0; // before the distance measured: not in the mean
    approach[2].pitch_deg = 0.5;  // the mean of five is 0.1: this is 0.4 off it, the others 0.1
    EXPECT_NEAR(*leave_out_pitching(approach, 120.0, 220.0, 0.3), 0.1, 1e-12);
    const auto ranges = judge_light(approach, far_ranges(), 120.0, 220.0, rounding());
    ASSERT_EQ(ranges.size(), 1U);
    EXPECT_EQ(ranges[0].left_out, 1U);
    EXPECT_EQ(ranges[0].samples, 4U);
    EXPECT_EQ(ranges[0].verdict, RatingVerdict::within);
    EXPECT_DOUBLE_EQ(*ranges[0].lx, 0.2);
    EXPECT_EQ(leave_out_pitching(approach, 1.0, 2.0, 0.3), std::nullopt);
}

TEST(LightLimits, LetAMomentPassWhereThatIsAllowed) {
    // 0.36 lx is 20 % above 0.3 during three ticks of 0.02 s, then 0.4 lx is 33 % above during one.
    const LightApproach approach = nearing(
        {{230.0, 0.1}, {215.0, 0.1}, {210.0, 0.36}, {205.0, 0.36}, {200.0, 0.36}, {195.0, 0.1}, {190.0, 0.4}, {185.0, 0.1}, {110.0, 0.1}});
    JudgingRules rules = rounding();
    const auto judged = [&] { return judge_light(approach, far_ranges(), 120.0, 220.0, rules).front(); };
    EXPECT_EQ(judged().verdict, RatingVerdict::exceeded);
    rules.excess = {true, 25.0, 0.1, 1.0, Known::assumed, ""};
    EXPECT_EQ(judged().excused, 3U);
    EXPECT_EQ(judged().worst->distance_m, 190.0); // too bright to pass
    EXPECT_EQ(judged().verdict, RatingVerdict::exceeded);
    rules.excess.percent = 40.0;
    EXPECT_EQ(judged().excused, 4U);
    EXPECT_EQ(judged().verdict, RatingVerdict::within);
    rules.excess.for_s = 0.05; // three ticks last 0.06 s, over 15 m; one lasts 0.02 s
    EXPECT_EQ(judged().excused, 1U);
    rules.excess.for_m = 15.0;
    EXPECT_EQ(judged().excused, 4U);
}

TEST(LightLimits, TellLightAloneWithoutALimit) {
    LimitCurve curve;
    curve.ranges = {{20.0, 40.0, {}, {}}};
    const auto ranges = judge_light(nearing({{45.0, 9.0}, {30.0, 2.0}, {25.0, 1.0}, {15.0, 9.0}}), curve, 0.0, 100.0, {});
    EXPECT_EQ(ranges[0].verdict, RatingVerdict::told);
    EXPECT_EQ(*ranges[0].lx, 2.0);
}

TEST(RatingVerdicts, AreAsBadAsTheWorst) {
    using enum RatingVerdict;
    EXPECT_EQ(worst_of(told, within), within);
    EXPECT_EQ(worst_of(not_measured, within), not_measured);
    EXPECT_EQ(worst_of(not_measured, exceeded), exceeded);
    EXPECT_EQ(worst_of(told, told), told);
}

/// 0.349 of 0.34 lx is farther above its limit than 3.16 of 3.1, but rounds to 0.3 of 0.3; 3.16 rounds to 3.2 of 3.1.
TEST(RatingLimits, RoundingDoesNotHideAnotherMomentAboveItsLimit) {
    LimitCurve falling;
    falling.ranges = {{30.0, 60.0, 3.1, 0.3}};
    const LightApproach approach = nearing({{60.0, 0.1}, {30.0 + 30.0 * (3.1 - 0.34) / 2.8, 0.349}, {30.0, 3.16}});
    const RangeJudgement judged = judge_light(approach, falling, 30.0, 60.0, rounding()).at(0);
    EXPECT_EQ(judged.verdict, RatingVerdict::exceeded);
    EXPECT_EQ(judged.worst->tick, 2);
    EXPECT_DOUBLE_EQ(*judged.lx, 3.2);
}

} // namespace
} // namespace fernlicht
