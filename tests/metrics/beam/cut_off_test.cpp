// The cut-off's ruler: edges whose sharpness, place and kink are known in closed form.
#include "metrics/beam/cut_off.h"
#include "metrics/beam/cut_off_elbow.h"
#include "metrics/regulation/regulation_check.h"
#include "tests/lamps.h"
#include "tests/metrics/planted_cut_off.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

struct Edge {
    double level_deg = -0.57, kink_h_deg = 0.0, slope = 0.2679491924311227; ///< tan 15 degrees
    double line(double h) const { return level_deg + std::max(0.0, h - kink_h_deg) * slope; }
};

/// The profile over the distance above the edge, in cd.
template <class Profile> CandelaTable edge_table(const Edge& edge, Profile profile, double v_step = 0.01, double h_step = 0.1) {
    return tests::table_of(
        tests::steps(-7.0, 7.0, h_step), tests::steps(-5.0, 5.0, v_step), [&](double h, double v) { return profile(v - edge.line(h)); },
        BetweenSamples::log_cd);
}

/// 10 000 cd falling to 100 cd in a logistic of the logarithm: G = 2 tanh(0.1 / (4 s)) by hand, inflection on the edge.
double logistic(double above, double softness) { return std::pow(10.0, 2.0 + 2.0 / (1.0 + std::exp(above / softness))); }

CandelaTable soft_edge(const Edge& edge = {}, double v_step = 0.01, double h_step = 0.1, double softness = 0.1) {
    return edge_table(
        edge, [&](double above) { return logistic(above, softness); }, v_step, h_step);
}

/// A ramp of k decades a degree over `width`: G = 0.1 k anywhere on it.
double ramp(double above, double k, double width) { return 1e4 * std::pow(10.0, -k * std::clamp(above + width / 2.0, 0.0, width)); }

/// A detector sees most of the brighter side of a steep edge: with 0.069 degrees and softness 0.1 it finds the edge 0.003 degrees higher.
constexpr double detector_lift_deg = 0.004;

const CutOffOptions by_point{.sharpness = SharpnessRule::maximum, .detector_deg = 0.0};

TEST(CutOff, SharpnessIsThatOfTheClosedForms) {
    for (const double k : {1.3, 2.0, 4.0}) {
        const CandelaTable t = edge_table({}, [&](double above) { return ramp(above, k, 0.5); });
        const CutOffFigures c = measure_cut_off({&t, {}}, by_point);
        EXPECT_NEAR(*c.level.sharpness, 0.1 * k, 1e-9) << k;
        EXPECT_NEAR(*c.level.inflection_deg, -0.57, 1e-3) << k;
    }
    for (const double softness : {0.08, 0.12, 0.2}) {
        const CandelaTable t = soft_edge({}, 0.01, 0.1, softness);
        const CutOffFigures c = measure_cut_off({&t, {}}, by_point);
        EXPECT_NEAR(*c.level.sharpness, 2.0 * std::tanh(0.1 / (4.0 * softness)), 2e-4) << softness;
        EXPECT_NEAR(*c.level.inflection_deg, -0.57, 1e-3) << softness;
        EXPECT_LE(*c.linearity_deg, 1e-3);
        // From the inflection on upwards: 2 (1/2 - 1 / (1 + exp(0.1 / s)))
        const CutOffFigures at = measure_cut_off({&t, {}}, {.sharpness = SharpnessRule::at_inflection, .detector_deg = 0.0});
        EXPECT_NEAR(*at.level.sharpness, 2.0 * (0.5 - 1.0 / (1.0 + std::exp(0.1 / softness))), 3e-3) << softness;
    }
    // A disc of diameter d over an exponential ramp of q = k ln 10 per degree multiplies all of it alike: G stays; at the ends it is
    // rounded.
    const CandelaTable wide = edge_table({}, [](double above) { return ramp(above, 3.0, 0.6); });
    EXPECT_NEAR(*measure_cut_off({&wide, {}}).level.sharpness, 0.3, 1e-4);
    const CandelaTable narrow = edge_table({}, [](double above) { return ramp(above, 10.0, 0.1); });
    EXPECT_NEAR(*measure_cut_off({&narrow, {}}, by_point).level.sharpness, 1.0, 1e-6);
    EXPECT_LT(*measure_cut_off({&narrow, {}}).level.sharpness, 0.97);
}

TEST(CutOff, KinkAndShoulderAreFoundWhereTheyAre) {
    for (const double kink : {-0.6, 0.0, 0.4})
        for (const double angle : {15.0, 10.0}) {
            const Edge edge{-0.57, kink, std::tan(angle * 3.14159265358979 / 180.0)};
            const CandelaTable t = soft_edge(edge);
            const CutOffFigures c = measure_cut_off({&t, {}});
            EXPECT_NEAR(*c.kink_h_deg, kink, 0.02);
            EXPECT_NEAR(*c.rise_angle_deg, angle, 0.1);
        }
    // On the line 0.37 above the level part a shoulder of slope m lies 0.37 / m to the right of the kink.
    const Edge edge{-0.57, 0.2, 1.0};
    const CandelaTable t = soft_edge(edge, 0.01, 0.05);
    const CutOffFigures c = measure_cut_off({&t, {}});
    EXPECT_NEAR(c.shoulder.at_deg, -0.20, detector_lift_deg);
    EXPECT_NEAR(*c.shoulder.inflection_deg, 0.57, 0.01);
    EXPECT_NEAR(*c.shoulder.sharpness, 2.0 * std::tanh(0.1 / 0.4), 0.02);
}

TEST(CutOff, LinearityIsTheSpreadOfThreeVerticals) {
    const CandelaTable flat = soft_edge(); // falling to the left by 0.06 a degree
    const CandelaTable t = tests::table_of(
        flat.h_deg, flat.v_deg, [](double h, double v) { return logistic(v - Edge{}.line(h) - 0.06 * std::min(0.0, h), 0.1); }, flat.rule);
    EXPECT_NEAR(*measure_cut_off({&t, {}}).linearity_deg, 0.12, 2e-3);
}

TEST(CutOff, ACoarseFileHasNoSharpnessButAPlace) {
    const CandelaTable t = soft_edge({}, 0.2);
    const CutOffFigures c = measure_cut_off({&t, {}});
    EXPECT_FALSE(c.level.sharpness);
    EXPECT_THAT(c.level.reason, HasSubstr("step of 0.2 degrees at the edge is coarser than the 0.1 degrees"));
    EXPECT_NEAR(*c.level.inflection_deg, -0.57, 0.1);
    EXPECT_NEAR(c.level.position_error_deg, 0.1, 1e-9);
}

// A street luminaire: a cosine's power, and a batwing whose two lobes stand 60 degrees from the nadir and end at the horizon.
TEST(CutOff, ASmoothLuminaireInCoarseStepsHasNone) {
    const auto cosine = [](double h, double v) { return 4000.0 * std::pow(std::cos(std::hypot(h, v) * 3.14159265358979 / 180.0), 30.0); };
    const auto batwing = [](double, double v) { return 20.0 + 2000.0 * std::exp(-0.5 * std::pow((v + 30.0) / 12.0, 2)); };
    for (const double step : {0.25, 1.0, 2.5, 5.0}) {
        const std::vector<double> angles = tests::steps(-60.0, 60.0, step);
        for (const CandelaTable& t : {tests::table_of(angles, angles, cosine), tests::table_of(angles, angles, batwing)}) {
            SCOPED_TRACE(step);
            const CutOffFigures c = measure_cut_off({&t, {}});
            for (const CutOffScan* scan : {&c.level, &c.level_inner, &c.level_outer, &c.rise[0], &c.rise[1], &c.rise[2]}) {
                EXPECT_FALSE(scan->sharpness);
                EXPECT_FALSE(scan->inflection_deg);
                EXPECT_THAT(scan->reason, testing::AnyOf(HasSubstr("no edge: in steps"), HasSubstr("within the scan falls")));
            }
            EXPECT_FALSE(c.linearity_deg);
            for (const AimRule rule : {AimRule::automatic, AimRule::cut_off, AimRule::elbow, AimRule::vol, AimRule::vor}) {
                const Aim aim = aim_of(t, rule);
                EXPECT_FALSE(aim.found);
                EXPECT_EQ(aim.turned, Direction{});
                EXPECT_THAT(aim.how, HasSubstr("left as filed"));
            }
        }
    }
}

TEST(CutOff, WhereThereIsNoneItSaysSo) {
    const CandelaTable flat = edge_table({}, [](double) { return 500.0; });
    EXPECT_FALSE(measure_cut_off({&flat, {}}).level.inflection_deg);
    const CandelaTable soft = edge_table({}, [](double above) { return ramp(above, 0.5, 2.0); });
    EXPECT_THAT(measure_cut_off({&soft, {}}).level.reason, HasSubstr("no edge: the greatest G is 0.050"));
    CandelaTable dark = edge_table({}, [](double above) { return above > 0.0 ? 0.0 : 1000.0; });
    EXPECT_THAT(measure_cut_off({&dark, {}}).level.reason, HasSubstr("ends in 0 cd"));
    CandelaTable elsewhere = soft_edge();
    for (double& v : elsewhere.v_deg)
        v -= 40.0;
    EXPECT_THAT(measure_cut_off({&elsewhere, {}}).level.reason, HasSubstr("outside the file's angles"));
    const CandelaTable even = soft_edge({-0.57, 0.0, 0.0});
    const CutOffFigures level = measure_cut_off({&even, {}});
    EXPECT_FALSE(level.kink_h_deg);
    EXPECT_THAT(level.kink_reason, HasSubstr("too little to meet"));
}

TEST(Aim, FindsALampTurnedAway) {
    for (const auto& [right, up] : {std::pair{0.0, 0.3}, {0.4, -0.2}, {-0.7, 0.5}}) {
        const Edge edge{-0.57 + up, right};
        const CandelaTable t = soft_edge(edge);
        const Aim aim = aim_of(t, AimRule::cut_off);
        EXPECT_TRUE(aim.found);
        EXPECT_NEAR(aim.turned.v_deg, -up, 0.01);
        EXPECT_NEAR(aim.turned.h_deg, -right, 0.02);
        EXPECT_NEAR(*aim.cut_off->level.inflection_deg, -0.57, 0.003);
        EXPECT_NEAR(*aim.cut_off->kink_h_deg, 0.0, 0.003);
    }
}

TEST(Aim, ByTheLineAt02DPutsTheShoulderOnLineA) {
    const Edge edge{-0.40, 0.6, 0.8}; // the shoulder at 0.37 / 0.8 right of the kink
    const CandelaTable t = soft_edge(edge, 0.01, 0.05);
    const Aim aim = aim_of(t, AimRule::cut_off_by_line);
    EXPECT_NEAR(aim.turned.v_deg, -0.17, 0.01);
    EXPECT_NEAR(aim.turned.h_deg, 0.5 - (0.6 + 0.37 / 0.8), 0.02);
}

TEST(Aim, OfTheUsPutsTheGradientWhereTheStandardSays) {
    const CandelaTable t = soft_edge({-0.3, 0.0});
    const Aim vol = aim_of(t, AimRule::vol);
    EXPECT_NEAR(vol.turned.v_deg, -0.4 + 0.3, detector_lift_deg);
    EXPECT_EQ(vol.turned.h_deg, 0.0);
    const Aim vor = aim_of(t, AimRule::vor); // the edge 2 degrees right: -0.3 + 2 tan 15
    EXPECT_NEAR(vor.turned.v_deg, 0.3 - 2.0 * std::tan(15.0 * 3.14159265358979 / 180.0), detector_lift_deg);
}

TEST(Aim, ByMaximumCentresTheAreaOf80PerCent) {
    const CandelaTable t = tests::table_of(
        tests::steps(-7.0, 7.0, 0.1), tests::steps(-5.0, 5.0, 0.1),
        [](double h, double v) { return 50000.0 * std::exp(-0.5 * (std::pow((h - 0.7) / 3.0, 2) + std::pow((v + 0.25) / 1.0, 2))); },
        BetweenSamples::log_cd);
    const Aim aim = aim_of(t, AimRule::maximum);
    EXPECT_NEAR(aim.turned.h_deg, -0.7, 0.02);
    EXPECT_NEAR(aim.turned.v_deg, 0.25, 0.02);
}

TEST(Aim, WithoutAnEdgeTheLampStaysAndItIsSaid) {
    const CandelaTable flat = edge_table({}, [](double) { return 500.0; });
    for (const AimRule rule : {AimRule::cut_off, AimRule::cut_off_by_line, AimRule::vol, AimRule::vor}) {
        const Aim aim = aim_of(flat, rule);
        EXPECT_FALSE(aim.found);
        EXPECT_EQ(aim.turned, Direction{});
        EXPECT_THAT(aim.how, HasSubstr("left as filed"));
    }
    const CandelaTable coarse = soft_edge({}, 1.0, 0.1, 0.3);
    EXPECT_THAT(aim_of(coarse, AimRule::cut_off).how, HasSubstr("known to 0.5 degrees only"));
}

// The elbow's fit and the aim that goes by it, over beams whose elbow is known. tests/calibration/aim.cpp says how right it is over
// hundreds.

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

TEST(Elbow, TurnsWithTheLampAndSaysWhereThereIsNone) {
    const CandelaTable t = planted::beam({});
    const CutOffElbow there = fit_elbow({&t, {}}), turned = fit_elbow({&t, {0.37, -0.21}});
    EXPECT_NEAR(turned.at->h_deg - there.at->h_deg, 0.37, 0.01);
    EXPECT_NEAR(turned.at->v_deg - there.at->v_deg, -0.21, 1e-3);
    CandelaTable flat = planted::beam({});
    std::ranges::fill(flat.cd, 500.0);
    EXPECT_THAT(fit_elbow({&flat, {}}).reason, HasSubstr("an edge in 0 columns only"));
    const CandelaTable level = planted::beam({.angle_deg = 1.0, .rise_deg = 9.0});
    EXPECT_THAT(fit_elbow({&level, {}}).reason, HasSubstr("no rise of 3 degrees"));
}

// The rise of this lamp ends before 2 degrees right: the line through 1, 2 and 3 degrees is not its rise.
const planted::CutOff short_rise{.elbow_h_deg = 0.4, .angle_deg = 15.0, .rise_deg = 1.3, .softness_deg = 0.08, .step_deg = 0.05};

TEST(Elbow, AShortRiseIsNoStraightLineAndIsAimedByTheElbowAlone) {
    const CandelaTable t = planted::beam(short_rise);
    const CutOffFigures c = measure_cut_off({&t, {}});
    EXPECT_FALSE(c.kink_h_deg);
    EXPECT_THAT(c.kink_reason, HasSubstr("leaves a straight line by 0.09 degrees"));
    const Aim by_text = aim_of(t, AimRule::cut_off);
    EXPECT_FALSE(by_text.found);
    EXPECT_EQ(by_text.turned.h_deg, 0.0);
    EXPECT_EQ(by_text.bound.h_deg, 0.0);
    EXPECT_GT(by_text.bound.v_deg, 0.0);
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
    CheckOptions not_re_aimed{.aim = std::nullopt, .re_aim = false};
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

TEST(Elbow, AnyAngleIsTurnedAtOnceInBothTraffics) {
    for (const planted::CutOff& c : planted_shapes) {
        const CandelaTable right = planted::beam(c), left = mirrored(right);
        Regulation limitless;
        limitless.aim = AimRule::automatic;
        const Aim aim = check_regulation(limitless, {right}, {}).aims.front();
        const Aim other = check_regulation(limitless, {left}, {.aim = std::nullopt, .left_hand_traffic = true}).aims.front();
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
