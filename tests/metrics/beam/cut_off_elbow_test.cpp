// The elbow's fit and the aim that goes by it, over beams whose elbow is known. tests/calibration/aim.cpp says how right it is over
// hundreds.
#include "metrics/beam/cut_off_elbow.h"

#include "metrics/regulation/regulation_check.h"
#include "tests/metrics/planted_cut_off.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

const std::vector<planted::CutOff> planted_shapes{
    {.elbow_h_deg = 0.4, .angle_deg = 15.0, .rise_deg = 1.0},
    {.elbow_h_deg = -1.3, .angle_deg = 15.0, .rise_deg = 4.0, .softness_deg = 0.2, .noise = 0.02},
    {.elbow_h_deg = 0.9, .level_v_deg = 0.6, .angle_deg = 45.0, .rise_deg = 1.5, .noise = 0.01},
    {.elbow_h_deg = 0.0, .level_v_deg = -2.0, .angle_deg = 70.0, .rise_deg = 2.0, .softness_deg = 0.05},
};

TEST(Elbow, IsFoundWhereItWasPlantedWithItsAngleAndItsShoulder) {
    for (const planted::CutOff& c : planted_shapes) {
        const CandelaTable t = planted::beam(c);
        const CutOffElbow elbow = fit_elbow({&t, {}});
        ASSERT_TRUE(elbow.at) << elbow.reason;
        EXPECT_NEAR(elbow.at->h_deg, c.elbow_h_deg, elbow.uncertainty.h_deg);
        EXPECT_NEAR(elbow.at->v_deg, c.level_v_deg, elbow.uncertainty.v_deg);
        EXPECT_LT(elbow.uncertainty.h_deg, 0.1);
        EXPECT_LT(elbow.uncertainty.v_deg, 0.05);
        EXPECT_NEAR(elbow.rise_angle_deg, c.angle_deg, 0.1 * c.angle_deg);
        ASSERT_TRUE(elbow.rise_to_h_deg);
        EXPECT_NEAR(*elbow.rise_to_h_deg, c.elbow_h_deg + c.rise_h_deg(), 0.1);
        EXPECT_NEAR(elbow.edge_deg(*elbow.rise_to_h_deg + 1.0), c.edge(8.0), 0.05);
    }
}

TEST(Elbow, TurnsWithTheLamp) {
    const CandelaTable t = planted::beam({});
    const CutOffElbow there = fit_elbow({&t, {}}), turned = fit_elbow({&t, {0.37, -0.21}});
    EXPECT_NEAR(turned.at->h_deg - there.at->h_deg, 0.37, 0.01);
    EXPECT_NEAR(turned.at->v_deg - there.at->v_deg, -0.21, 1e-3);
}

TEST(Elbow, WhereThereIsNoneItSaysWhy) {
    CandelaTable flat = planted::beam({});
    std::ranges::fill(flat.cd, 500.0);
    EXPECT_THAT(fit_elbow({&flat, {}}).reason, HasSubstr("an edge in 0 columns only"));
    const CandelaTable level = planted::beam({.angle_deg = 1.0, .rise_deg = 9.0});
    EXPECT_THAT(fit_elbow({&level, {}}).reason, HasSubstr("no rise of 3 degrees"));
}

// The rise of this lamp ends before 2 degrees right: the line through 1, 2 and 3 degrees is not its rise.
const planted::CutOff short_rise{.elbow_h_deg = 0.4, .angle_deg = 15.0, .rise_deg = 1.3, .softness_deg = 0.08, .step_deg = 0.05};

TEST(Elbow, ThreePointsOffAStraightLineAreNoRise) {
    const CandelaTable t = planted::beam(short_rise);
    const CutOffFigures c = measure_cut_off({&t, {}});
    EXPECT_FALSE(c.kink_h_deg);
    EXPECT_THAT(c.kink_reason, HasSubstr("leaves a straight line by 0.09 degrees"));
}

TEST(Elbow, AShortRiseIsAimedByTheElbowAndByNothingElse) {
    const CandelaTable t = planted::beam(short_rise);
    const Aim by_text = aim_of(t, AimRule::cut_off);
    EXPECT_FALSE(by_text.found);
    EXPECT_EQ(by_text.turned.h_deg, 0.0);
    EXPECT_THAT(by_text.how, HasSubstr("left as filed sideways: the edge at 1, 2 and 3 degrees right"));
    EXPECT_THAT(aim_of(t, AimRule::cut_off_by_line).how, HasSubstr("the rise ends 0.3"));
    const Aim aim = aim_of(t, AimRule::automatic);
    EXPECT_EQ(aim.rule, AimRule::elbow);
    EXPECT_NEAR(aim.turned.h_deg, -short_rise.elbow_h_deg, 0.02);
    EXPECT_THAT(aim.how, HasSubstr("elbow set on V-V"));
    EXPECT_THAT(aim.how, HasSubstr("not by the kink: the edge at 1, 2 and 3 degrees right"));
    // What stands right of V-V is judged as on the same lamp filed with its elbow there.
    planted::CutOff straight = short_rise;
    straight.elbow_h_deg = 0.0;
    const CandelaTable aimed = planted::beam(straight);
    const auto found = [&](const CandelaTable& lamp, const CheckOptions& options) {
        const RegulationCheck check = check_regulation(regulation("r112-b"), {lamp}, options);
        return std::ranges::find(check.rows, "75R", &RowResult::id)->found;
    };
    CheckOptions not_re_aimed;
    not_re_aimed.re_aim = false;
    EXPECT_NEAR(found(t, not_re_aimed) / found(aimed, {.aim = AimRule::as_is}), 1.0, 0.05);
}

// The line at 0.2 D is met 1.38 degrees right of the elbow of such a beam, 0.88 right of line A.
TEST(Elbow, ABeamOf15DegreesThatIsRightAsFiledStaysThere) {
    for (const double rise_deg : {2.0, 2.5, 3.0}) {
        const CandelaTable t = planted::beam({.rise_deg = rise_deg, .step_deg = 0.05});
        const Aim aim = aim_of(t, AimRule::automatic);
        ASSERT_TRUE(aim.found) << aim.how;
        EXPECT_NE(aim.rule, AimRule::cut_off_by_line);
        EXPECT_NEAR(aim.turned.h_deg, 0.0, 0.05) << rise_deg << ": " << aim.how;
        EXPECT_THAT(aim.how, testing::AnyOf(HasSubstr("kink set on V-V"), HasSubstr("nor by the line at 0.2 D: ")));
    }
    const CandelaTable t = planted::beam({.rise_deg = 2.0, .step_deg = 0.05});
    EXPECT_THAT(aim_of(t, AimRule::automatic).how, HasSubstr("it would leave the elbow at 0.8"));
    EXPECT_NEAR(aim_of(t, AimRule::cut_off_by_line).turned.h_deg, -0.88, 0.05); // who asks for it, gets it
}

TEST(Elbow, WhereNothingAimedSidewaysThereIsNoBound) {
    const CandelaTable t = planted::beam({.rise_deg = 1.3, .step_deg = 0.05});
    const Aim aim = aim_of(t, AimRule::cut_off);
    ASSERT_FALSE(aim.found);
    EXPECT_EQ(aim.turned.h_deg, 0.0);
    EXPECT_EQ(aim.bound.h_deg, 0.0);
    EXPECT_GT(aim.bound.v_deg, 0.0);
}

TEST(Elbow, AnyAngleIsTurnedAtOnceInBothTraffics) {
    for (const planted::CutOff& c : planted_shapes) {
        const CandelaTable right = planted::beam(c), left = mirrored(right);
        const Regulation none;
        const Aim aim = check_regulation(none, {right}, {.aim = AimRule::automatic}).aims.front();
        const Aim other = check_regulation(none, {left}, {.aim = AimRule::automatic, .left_hand_traffic = true}).aims.front();
        ASSERT_TRUE(aim.found) << aim.how;
        EXPECT_NEAR(aim.turned.v_deg, -0.57 - c.level_v_deg, aim.bound.v_deg);
        EXPECT_LE(std::abs(aim.residual.v_deg), aim.bound.v_deg);
        EXPECT_LE(aim.rounds, 5);
        EXPECT_DOUBLE_EQ(other.turned.h_deg, -aim.turned.h_deg);
        EXPECT_DOUBLE_EQ(other.turned.v_deg, aim.turned.v_deg);
    }
}

// Round 2.5 degrees left this edge steps down: a turn by what the kink seems to be off moves the level part from one side of the step to
// the other, and the next correction is as large.
TEST(Elbow, WhatDoesNotConvergeStaysAsFiled) {
    CandelaTable t = planted::beam({.step_deg = 0.05});
    for (std::size_t v = 0; v < t.v_deg.size(); ++v)
        for (std::size_t h = 0; h < t.h_deg.size(); ++h) {
            const double at = t.h_deg[h], edge = -0.57 + 0.5 * std::clamp(-2.3 - at, 0.0, 0.4) + 0.268 * std::max(0.0, at);
            t.at(v, h) = std::pow(10.0, 2.6 + 2.0 / (1.0 + std::exp((t.v_deg[v] - edge) / 0.1)));
        }
    const Aim aim = aim_of(t, AimRule::cut_off);
    EXPECT_FALSE(aim.found);
    EXPECT_EQ(aim.turned, Direction{});
    EXPECT_THAT(aim.how, HasSubstr("not converged after"));
}

TEST(Elbow, VerdictsThatTheAimChangesAreTold) {
    const planted::CutOff high{.elbow_h_deg = 0.5, .level_v_deg = 0.6};
    const CandelaTable t = planted::beam(high);
    const RegulationCheck check = check_regulation(regulation("r112-b"), {t});
    ASSERT_FALSE(check.as_filed.empty());
    for (const RowResult& row : check.as_filed) {
        const auto aimed = std::ranges::find(check.rows, row.id, &RowResult::id);
        ASSERT_NE(aimed, check.rows.end());
        EXPECT_NE(aimed->verdict, row.verdict) << row.id;
    }
    EXPECT_EQ(check.verdict_as_filed, RowVerdict::fail);
    EXPECT_TRUE(check_regulation(regulation("r112-b"), {t}, {.aim = AimRule::as_is}).as_filed.empty());
}

} // namespace
} // namespace fernlicht
