// The laws beside the bend light, each step by step: thresholds, hysteresis, delays, what a lost signal does.
#include "scenarios/control/control_run.h"
#include "scenarios/control/control_stability.h"
#include "scenarios/control/lamp_controller.h"
#include "scenarios/control/laws.h"
#include "scenarios/values/pose.h"
#include "tests/trial.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SignalTable at_kmh(double speed_kmh) {
    SignalTable table({"left"});
    table[signal::ego_speed] = speed_kmh / 3.6;
    return table;
}

TEST(BeamModes, SpeedChoosesWithHysteresisAndDelay) {
    BeamModes modes(ModeParameters{});
    const auto after = [&](double kmh, double s) {
        BeamMode mode = BeamMode::c;
        for (int k = 0; k < std::lround(s / 0.1); ++k)
            mode = modes.step(at_kmh(kmh), 0.1);
        return mode;
    };
    EXPECT_EQ(after(80, 0.1), BeamMode::c);
    EXPECT_EQ(after(49, 1.9), BeamMode::c) << "asked for, but not long enough";
    EXPECT_EQ(after(49, 0.3), BeamMode::v);
    EXPECT_EQ(after(54, 5.0), BeamMode::v) << "inside the hysteresis";
    EXPECT_EQ(after(56, 2.2), BeamMode::c);
    EXPECT_EQ(after(111, 2.2), BeamMode::e);
    EXPECT_EQ(after(106, 5.0), BeamMode::e);
    EXPECT_EQ(after(104, 2.2), BeamMode::c);
}

TEST(BeamModes, MotorwayLightWetnessAndWipers) {
    const auto first = [](double kmh, std::size_t place, double value) {
        SignalTable table = at_kmh(kmh);
        table[place] = value;
        return BeamModes(ModeParameters{}).step(table, 0.0);
    };
    EXPECT_EQ(first(80, signal::road_motorway, 1.0), BeamMode::e);
    EXPECT_EQ(first(58, signal::environment_illuminance, 12.0), BeamMode::v);
    EXPECT_EQ(first(58, signal::environment_illuminance, 8.0), BeamMode::c);
    EXPECT_EQ(first(120, signal::environment_wetness, 0.6), BeamMode::w) << "wet comes before fast";
    EXPECT_EQ(first(30, signal::ego_wipers, nan), BeamMode::c);
    BeamModes modes(ModeParameters{});
    SignalTable wiping = at_kmh(80);
    wiping[signal::ego_wipers] = 1.0;
    for (int k = 0; k < 1200; ++k)
        EXPECT_EQ(modes.step(wiping, 0.1), BeamMode::c) << k;
    for (int k = 0; k < 30; ++k)
        modes.step(wiping, 0.1);
    EXPECT_EQ(modes.step(wiping, 0.1), BeamMode::w) << "two minutes, and the delay";
}

TEST(CorneringLight, TurnsOnBySteeringAndIndicatorWhileSlow) {
    CorneringLight light(CorneringParameters{.fade_s = 0.0});
    const auto left = [&](double kmh, double steering_rad, double indicator = 0.0) {
        SignalTable table = at_kmh(kmh);
        table[signal::ego_steering] = steering_rad;
        table[signal::ego_indicator] = indicator;
        const CorneringLight::Levels levels = light.step(table, 0.02);
        return std::pair(levels.left, levels.right);
    };
    EXPECT_EQ(left(20, 0.05), std::pair(0.0, 0.0));
    EXPECT_EQ(left(20, 0.07), std::pair(1.0, 0.0));
    EXPECT_EQ(left(20, 0.05), std::pair(1.0, 0.0)) << "hysteresis";
    EXPECT_EQ(left(20, 0.03), std::pair(0.0, 0.0));
    EXPECT_EQ(left(20, -0.07), std::pair(0.0, 1.0));
    EXPECT_EQ(left(41, -0.07), std::pair(0.0, 0.0));
    EXPECT_EQ(left(38, -0.07), std::pair(0.0, 0.0)) << "not again before it is slower still";
    EXPECT_EQ(left(34, -0.07), std::pair(0.0, 1.0));
    EXPECT_EQ(left(10, 0.0, 1.0), std::pair(1.0, 0.0));
    EXPECT_EQ(left(10, nan), std::pair(0.0, 0.0));
}

TEST(CorneringLight, Fades) {
    CorneringLight light(CorneringParameters{});
    SignalTable table = at_kmh(10);
    table[signal::ego_steering] = 0.3;
    EXPECT_NEAR(light.step(table, 0.1).left, 0.2, 1e-12) << "0.5 s for all of it";
}

TEST(HighBeam, DipsForOthersAfterItsDelaysAndStaysOffInTown) {
    HighBeam beam(HighBeamParameters{}, true);
    SignalTable table = at_kmh(80);
    EXPECT_EQ(beam.step(table, 0.0), 1.0) << "starts as it would be";
    table[signal::others_nearest_oncoming] = 399.0;
    EXPECT_EQ(beam.step(table, 0.1), 1.0);
    EXPECT_EQ(beam.step(table, 0.1), 0.0) << "0.2 s, then 0.1 s of fading";
    table[signal::others_nearest_oncoming] = 401.0;
    for (int k = 0; k < 14; ++k)
        EXPECT_EQ(beam.step(table, 0.1), 0.0);
    EXPECT_EQ(beam.step(table, 0.1), 1.0);
    table[signal::others_nearest_preceding] = 150.0;
    for (int k = 0; k < 5; ++k)
        beam.step(table, 0.1);
    EXPECT_EQ(beam.step(table, 0.1), 0.0);
    for (const auto& [place, value] : std::initializer_list<std::pair<std::size_t, double>>{{signal::environment_illuminance, 11.0},
                                                                                            {signal::ego_speed, 5.0},
                                                                                            {signal::ego_speed, nan},
                                                                                            {signal::others_nearest_oncoming, nan}}) {
        SignalTable lit = at_kmh(80);
        lit[place] = value;
        EXPECT_EQ(HighBeam(HighBeamParameters{}, true).step(lit, 0.0), 0.0) << place << ' ' << value;
    }
}

/// 50 m before the lamp, 2 m wide, 3 m to the left of it: atan(2/50) to atan(4/50).
TEST(GlareFree, WindowsKnowWhereOthersAre) {
    const OtherUser other{"car", 53.4, 3.6, 3.14, 20.0, 2.0, 1.5, true};
    const LampPlace lamp{{3.4, 0.6, 0.65}};
    const AngleBox seen = *seen_box(other, lamp);
    EXPECT_NEAR(seen.left_deg, -4.5739, 1e-4);
    EXPECT_NEAR(seen.right_deg, -2.2906, 1e-4);
    EXPECT_NEAR(seen.bottom_deg, -0.7442, 1e-4) << "0.65 m below the lamp, 50.04 m away";
    EXPECT_NEAR(seen.top_deg, 0.9732, 1e-4);
    const AngleBox turned = *seen_box(other, {lamp.position_m, 0.1, 0.01});
    EXPECT_NEAR(turned.left_deg, seen.left_deg + 5.7296, 0.01) << "a lamp that looks to the left has it farther to the right";
    EXPECT_NEAR(turned.top_deg, seen.top_deg - 0.573, 0.01);
    // A lamp whose left side is 30 degrees up has what is to its left lower: 4 m beside the axis by 2 m.
    EXPECT_NEAR(seen_box(other, {lamp.position_m, 0.0, 0.0, radians(30.0)})->bottom_deg,
                degrees(std::atan((-0.65 * std::cos(radians(30.0)) - 4.0 * 0.5) / 50.1)), 0.01);
    EXPECT_EQ(seen_box({"behind", 3.0, 0.0}, lamp), std::nullopt);
    OtherUser higher = other;
    higher.up_m = 1.0;
    EXPECT_NEAR(seen_box(higher, lamp)->bottom_deg, 0.3998, 1e-3);

    GlareFreeParameters parameters;
    LampWindows windows({{-9, -5.2, -90, 90}, {-5.2, -2, -90, 90}, {-2, -1.9, -90, 90}, {-1.9, 3, -90, 90}}, parameters);
    const HighBeamParameters reach;
    EXPECT_THAT(windows.step({other}, reach, lamp, {}, 0.0), testing::ElementsAre(1, 0, 0, 0)) << "half a degree of margin";
    EXPECT_THAT(windows.step({}, reach, lamp, {}, 0.4), testing::ElementsAre(1, 0, 0, 0)) << "not lit again at once";
    EXPECT_THAT(windows.step({}, reach, lamp, {}, 0.2), testing::ElementsAre(1, 1, 1, 1));
    // 20 m/s towards it and 20 of its own: 30 m on it is 20 m away, atan(2/20) to atan(4/20) left. Its far side stays where it was.
    const OtherUser later = seen_later(other, {20.0, 0.0}, 0.75);
    EXPECT_NEAR(later.ahead_m, 23.4, 1e-3);
    EXPECT_NEAR(seen_box(later, lamp)->left_deg, -11.310, 0.1);
    const OtherUser turned_away = seen_later({"ahead", 50.0, 0.0, 0.0, 0.0}, {20.0, 0.2}, 1.0); // R 100 m, 0.2 rad
    EXPECT_NEAR(turned_away.ahead_m, (50.0 - 19.8669) * std::cos(0.2) - 1.99334 * std::sin(0.2), 1e-3);
    EXPECT_NEAR(turned_away.left_m, -1.99334 * std::cos(0.2) - (50.0 - 19.8669) * std::sin(0.2), 1e-3);
    parameters.foresee_s = 0.75;
    LampWindows foreseeing({{-12, -9, -90, 90}, {-9, -5.2, -90, 90}, {-2, -1.9, -90, 90}, {-1.7, 3, -90, 90}}, parameters);
    EXPECT_THAT(foreseeing.step({other}, reach, lamp, {20.0, 0.0}, 0.0), testing::ElementsAre(0, 0, 0, 1));
    parameters.foresee_s = 0.0;
    LampWindows pixels({{-5, -2, -6, -1.3}, {-5, -2, -1.2, 0}, {-5, -2, 1.4, 3}, {-5, -2, 1.5, 3}}, parameters);
    EXPECT_THAT(pixels.step({other}, reach, lamp, {}, 0.0), testing::ElementsAre(1, 0, 0, 1)) << "half a degree above and below, too";
}

TEST(GlareFree, AMaskedBeamIsDarkInItsWindowsAndWholeBesideThem) {
    const CandelaTable table{{-10, 0, 10}, {-5, 5}, {100, 200, 300, 100, 200, 300}, {}, BetweenSamples::linear_cd};
    const CandelaTable dark = masked(table, {{-4, -2}, {-2, 3}, {3, 6}}, {1.0, 0.0, 0.5});
    check_invariants(dark);
    for (const auto& [h, share] : {std::pair(-7.0, 1.0),
                                   {-3.0, 1.0},
                                   {-2.2, 1.0},
                                   {-2.0, 0.0},
                                   {0.0, 0.0},
                                   {2.9, 0.0},
                                   {3.0, 0.0},
                                   {5.0, 0.5},
                                   {6.0, 0.5},
                                   {6.2, 1.0}})
        EXPECT_NEAR(intensity_cd(dark, h, 0.0), share * intensity_cd(table, h, 0.0), 1e-9) << h;
    EXPECT_NEAR(intensity_cd(dark, -2.05, 0.0), 0.5 * intensity_cd(table, -2.1, 0.0), 1e-9) << "the edge rises inside the lit neighbour";
    EXPECT_THROW(masked(table, {{0, 1}}, {}), std::invalid_argument);
}

TEST(ControlStability, ExtremesStayInsideAndErrorGoesWithTheSquareOfThePeriod) {
    for (const ExtremeTrial& trial : control_with_extreme_signals())
        EXPECT_LT(trial.error, 1e-6) << trial.what;
    for (const ExtremeTrial& trial : control_mirrored())
        EXPECT_LT(trial.error, 1e-12) << trial.what;
    /// The filter takes a tick's input for all of the period before it, half a period early; holding the command is half a period late.
    /// What is left goes with the square.
    const double coarse = control_period_error_rad(BendLaw::yaw_rate, 0.02), fine = control_period_error_rad(BendLaw::yaw_rate, 0.01);
    EXPECT_GT(coarse, 1e-5);
    EXPECT_NEAR(coarse / fine, 4.0, 0.5);
}

ControlInputs circle(double time_s, double speed_mps, double radius_m) {
    ControlInputs in{.time_s = time_s,
                     .distance_m = speed_mps * time_s,
                     .speed_mps = speed_mps,
                     .yaw_rate_rad_s = speed_mps / radius_m,
                     .steering_rad = (2.7 + 0.003 * speed_mps * speed_mps) / radius_m};
    in.curvature_per_m = in.curvature_25m_per_m = 1.0 / radius_m;
    in.bearing_ahead_rad = 0.5 * speed_mps * 1.5 / radius_m;
    return in;
}

TEST(ControlLoopWindows, OneThatIsLostAndFailsStaysAsItWas) {
    const std::string window = "lamp.left.segments[1]";
    const ControlParameters control{.failures = {{.at_s = 0.1, .what = window}}};
    ControlLoop loop(control, {{"left", {3.4, 0.6, 0.65}, 0.0, {{-4.0, 0.0, -90.0, 90.0}, {0.0, 4.0, -90.0, 90.0}}}}, {}, {}, {window});
    for (int tick = 0; tick < 10; ++tick) {
        ControlInputs in{.time_s = 0.02 * tick};
        in.written = {{loop.signals().find(window), tick < 5 ? 0.25 : nan}};
        loop.step(in);
    }
    EXPECT_EQ(loop.lamp_at(0, 0.18).segments.back().second, (std::vector<double>{0.25, 1.0}));
}

const std::vector<ControlledLamp> two_lamps{{"left", {3.4, 0.6, 0.65}, 0.0}, {"right", {3.4, -0.6, 0.65}, 0.0}};
const ControlledCar car{2.7, 0.003};

ControlParameters bend_light(BendLaw law) { return plain_bend_light(law, 0.02); }

ControlRun ran(const ControlParameters& control, double end_s, const std::function<ControlInputs(double)>& inputs) {
    return run_control(control, two_lamps, car, inputs, {end_s, 0.1});
}

/// 20 m/s on a circle of 150 m: 30 m later the car is 0.1 rad to the left of where it points now (k v T / 2 = 20 * 1.5 / 300).
TEST(BendLight, AllLawsLookToWhereACircleLeads) {
    for (const BendLaw law : {BendLaw::steering, BendLaw::yaw_rate, BendLaw::route}) {
        const ControlRun run = ran(bend_light(law), 3.0, [](double t) { return circle(t, 20.0, 150.0); });
        EXPECT_NEAR(run.swivel_rad(0, 2.9), 0.1, 1e-9) << static_cast<int>(law);
        EXPECT_NEAR(run.swivel_rad(1, 0.0), 0.1, 1e-9) << "starts where the law wants it";
        EXPECT_EQ(run.rows.size(), 30U);
    }
}

TEST(BendLight, OuterLampTakesItsShare) {
    ControlParameters control = bend_light(BendLaw::yaw_rate);
    control.bend->outer_share = 0.5;
    const auto run = [&](double radius_m) { return ran(control, 1.0, [=](double t) { return circle(t, 20.0, radius_m); }); };
    EXPECT_NEAR(run(150.0).swivel_rad(0, 1.0), 0.1, 1e-9);
    EXPECT_NEAR(run(150.0).swivel_rad(1, 1.0), 0.05, 1e-9);
    EXPECT_NEAR(run(-150.0).swivel_rad(0, 1.0), -0.05, 1e-9);
    EXPECT_NEAR(run(-150.0).swivel_rad(1, 1.0), -0.1, 1e-9);
}

TEST(BendLight, StandingReversingAndSlowCarsLookStraightAhead) {
    for (const auto& [speed, share] : {std::pair{0.0, 0.0}, {-3.0, 0.0}, {1.4, 0.0}, {2.1, 0.5}, {2.8, 1.0}}) {
        const ControlRun run = ran(bend_light(BendLaw::yaw_rate), 1.0, [v = speed](double t) {
            ControlInputs in = circle(t, v, 20.0);
            in.yaw_rate_rad_s = 0.1;
            return in;
        });
        EXPECT_NEAR(run.swivel_rad(0, 1.0), share * 0.1 * 1.5 / 2.0, 1e-9) << speed;
    }
}

/// Dead time 30 ms after the tick, then the filter of 0.1 s and the actuator: nothing moves before, all of it has after a second.
TEST(BendLight, FollowsAStepAfterDeadTimeFilterAndActuator) {
    const ControlRun run = ran(bend_light(BendLaw::yaw_rate), 3.0, [](double t) { return circle(t, 20.0, t < 0.5 ? 1e9 : 150.0); });
    EXPECT_NEAR(run.swivel_rad(0, 0.53), 0.0, 1e-6);
    EXPECT_GT(run.swivel_rad(0, 0.6), 1e-4);
    EXPECT_LT(run.swivel_rad(0, 0.6), 0.03);
    EXPECT_NEAR(run.swivel_rad(0, 2.5), 0.1, 1e-5);
}

TEST(BendLight, FailuresGoStraightAheadOrStayAndComeBack) {
    ControlParameters control = bend_light(BendLaw::yaw_rate);
    control.failures = {{ControlFailure::Kind::lost_signal, 1.0, 4.0, "ego.yaw_rate_rad_s"}};
    const ControlRun run = ran(control, 8.0, [](double t) { return circle(t, 20.0, 150.0); });
    EXPECT_NEAR(run.swivel_rad(0, 1.0), 0.1, 1e-9);
    EXPECT_NEAR(run.swivel_rad(0, 3.9), 0.0, 1e-6);
    EXPECT_NEAR(run.swivel_rad(0, 7.9), 0.1, 1e-6);
    ControlParameters other_control = bend_light(BendLaw::yaw_rate);
    other_control.failures = {{ControlFailure::Kind::stuck_swivel, 1.0, 6.0, "left"}};
    other_control.stuck_swivel = std::nullopt;
    const ControlRun other_run = ran(other_control, 8.0, [](double t) { return circle(t, 20.0, t < 1.5 ? 150.0 : -150.0); });
    EXPECT_NEAR(other_run.swivel_rad(0, 5.9), 0.1, 1e-9);
    EXPECT_NEAR(other_run.swivel_rad(1, 5.9), -0.1, 1e-6);
    EXPECT_NEAR(other_run.swivel_rad(0, 7.9), -0.1, 1e-6);
}

/// Left, into a left bend, the lamp jams; then the bend goes right. Within the filter's and the diagnosis' time the other looks straight
/// ahead, and the stuck lamp goes down, or dims where nothing levels it.
TEST(BendLight, AStuckSwivelIsFoundAndMadeSafe) {
    ControlParameters control = bend_light(BendLaw::yaw_rate);
    control.failures = {{ControlFailure::Kind::stuck_swivel, 1.0, 6.0, "left"}};
    const auto run_of = [](const ControlParameters& with, double radius_m = -150.0) {
        return ran(with, 8.0, [=](double t) { return circle(t, 20.0, t < 1.5 ? 150.0 : radius_m); });
    };
    const ControlRun dimmed = run_of(control);
    EXPECT_NEAR(dimmed.swivel_rad(0, 5.9), 0.1, 1e-9);
    EXPECT_EQ(dimmed.level(0, 1.9), 1.0) << "not before it was off for half a second";
    EXPECT_EQ(dimmed.level(0, 2.3), 0.1);
    EXPECT_EQ(dimmed.level(1, 5.9), 1.0);
    EXPECT_NEAR(dimmed.swivel_rad(1, 5.9), 0.0, 1e-4) << "straight ahead, in a bend";
    EXPECT_NEAR(dimmed.swivel_rad(0, 7.9), 0.0, 1e-4) << "freed it goes straight ahead";
    EXPECT_EQ(dimmed.level(0, 7.9), 1.0) << "and need not be dim";
    EXPECT_NEAR(dimmed.swivel_rad(1, 7.9), 0.0, 1e-4) << "nobody trusts it again";

    control.levelling = LevellingParameters{};
    const ControlRun lowered = run_of(control);
    EXPECT_NEAR(lowered.pitch_rad(0, 5.9), -0.0262, 1e-5);
    EXPECT_NEAR(lowered.pitch_rad(1, 5.9), 0.0, 1e-9);
    EXPECT_EQ(lowered.level(0, 5.9), 1.0);

    const ControlRun as_asked = run_of(control, 150.0);
    EXPECT_NEAR(as_asked.pitch_rad(0, 5.9), 0.0, 1e-9) << "stuck where it is wanted nothing tells";
    EXPECT_NEAR(as_asked.swivel_rad(1, 5.9), 0.1, 1e-6);
}

/// The quickest that the law asks for, against the actuator's rate limit: it lags by many degrees and is not stuck. Nor at its stop.
TEST(BendLight, AHealthySwivelIsNeverFoundStuck) {
    ControlParameters control = bend_light(BendLaw::yaw_rate);
    control.bend->filter_s = 0.0;
    control.bend->actuator.rate_limit_rad_s = 0.05;
    const auto weaving = [](double t) { return circle(t, 30.0, std::fmod(t, 4.0) < 2.0 ? 60.0 : -60.0); };
    const ControlRun run = ran(control, 20.0, weaving);
    const std::size_t stuck = std::size_t{signal::count} + std::size_t{lamp_signal::swivel_stuck};
    double least = 0.0, most = 0.0;
    for (const auto& row : run.rows) {
        EXPECT_EQ(row[stuck], 0.0);
        least = std::min(least, row[std::size_t{signal::count} + std::size_t{lamp_signal::swivel}]);
        most = std::max(most, row[std::size_t{signal::count} + std::size_t{lamp_signal::swivel}]);
    }
    EXPECT_GT(most - least, 0.08);
}

TEST(BendLight, ValuesThatNoCarHasAreLostSignals) {
    const ControlRun run = ran(bend_light(BendLaw::yaw_rate), 1.0, [](double t) { return circle(t, 20.0, 1.0); });
    EXPECT_NEAR(run.swivel_rad(0, 1.0), 0.0, 1e-9) << "20 rad/s are no car's";
    ASSERT_FALSE(run.notes.empty());
    EXPECT_EQ(run.notes[0], "signal ego.yaw_rate_rad_s was outside -6.3 to 6.3 rad/s at 50 ticks, and taken for lost there");
}

TEST(Signals, UnknownNamesNameTheNearest) {
    const SignalTable table({"left"});
    EXPECT_EQ(table.name(table.find("lamp.left.swivel_rad")), "lamp.left.swivel_rad");
    EXPECT_EQ(table.find("ego.speed_mps"), std::size_t{signal::ego_speed});
    EXPECT_EQ(tests::refusal_of<std::invalid_argument>([&] { table.find("ego.sped_mps"); }), "'ego.speed_mps', the nearest signal");
}

} // namespace
} // namespace fernlicht
