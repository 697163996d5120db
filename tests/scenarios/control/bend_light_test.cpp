#include "scenarios/control/control_run.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

ControlInputs circle(double time_s, double speed_mps, double radius_m) {
    ControlInputs in;
    in.time_s = time_s;
    in.speed_mps = speed_mps;
    in.distance_m = speed_mps * time_s;
    in.yaw_rate_rad_s = speed_mps / radius_m;
    in.steering_rad = (2.7 + 0.003 * speed_mps * speed_mps) / radius_m;
    in.curvature_per_m = in.curvature_25m_per_m = 1.0 / radius_m;
    in.bearing_ahead_rad = 0.5 * speed_mps * 1.5 / radius_m;
    return in;
}

const std::vector<ControlledLamp> two_lamps{{"left", {3.4, 0.6, 0.65}, 0.0}, {"right", {3.4, -0.6, 0.65}, 0.0}};
const ControlledCar car{2.7, 0.003};

ControlParameters bend_light(BendLaw law) {
    ControlParameters control;
    control.bend = BendParameters{};
    control.bend->law = law;
    control.bend->lamps = {"left", "right"};
    return control;
}

/// 20 m/s on a circle of 150 m: 30 m later the car is 0.1 rad to the left of where it points now (k v T / 2 = 20 * 1.5 / 300).
TEST(BendLight, AllLawsLookToWhereACircleLeads) {
    for (const BendLaw law : {BendLaw::steering, BendLaw::yaw_rate, BendLaw::route}) {
        const ControlRun run = run_control(bend_light(law), two_lamps, car, [](double t) { return circle(t, 20.0, 150.0); }, {3.0, 0.1});
        EXPECT_NEAR(run.swivel_rad(0, 2.9), 0.1, 1e-9) << static_cast<int>(law);
        EXPECT_NEAR(run.swivel_rad(1, 0.0), 0.1, 1e-9) << "starts where the law wants it";
        EXPECT_EQ(run.rows.size(), 30U);
    }
}

TEST(BendLight, OuterLampTakesItsShare) {
    ControlParameters control = bend_light(BendLaw::yaw_rate);
    control.bend->outer_share = 0.5;
    const auto run = [&](double radius_m) {
        return run_control(control, two_lamps, car, [=](double t) { return circle(t, 20.0, radius_m); }, {1.0, 0.1});
    };
    EXPECT_NEAR(run(150.0).swivel_rad(0, 1.0), 0.1, 1e-9);
    EXPECT_NEAR(run(150.0).swivel_rad(1, 1.0), 0.05, 1e-9);
    EXPECT_NEAR(run(-150.0).swivel_rad(0, 1.0), -0.05, 1e-9);
    EXPECT_NEAR(run(-150.0).swivel_rad(1, 1.0), -0.1, 1e-9);
}

TEST(BendLight, StandingReversingAndSlowCarsLookStraightAhead) {
    for (const auto& [speed, share] : {std::pair{0.0, 0.0}, {-3.0, 0.0}, {1.4, 0.0}, {2.1, 0.5}, {2.8, 1.0}}) {
        const ControlRun run = run_control(bend_light(BendLaw::yaw_rate), two_lamps, car,
                                           [=](double t) {
                                               ControlInputs in = circle(t, speed, 20.0);
                                               in.yaw_rate_rad_s = 0.1;
                                               return in;
                                           },
                                           {1.0, 0.1});
        EXPECT_NEAR(run.swivel_rad(0, 1.0), share * 0.1 * 1.5 / 2.0, 1e-9) << speed;
    }
}

/// Dead time 30 ms after the tick, then the filter of 0.1 s and the actuator: nothing moves before, all of it has after a second.
TEST(BendLight, FollowsAStepAfterDeadTimeFilterAndActuator) {
    const ControlRun run = run_control(bend_light(BendLaw::yaw_rate), two_lamps, car,
                                       [](double t) { return circle(t, 20.0, t < 0.5 ? 1e9 : 150.0); }, {3.0, 0.1});
    EXPECT_NEAR(run.swivel_rad(0, 0.53), 0.0, 1e-6);
    EXPECT_GT(run.swivel_rad(0, 0.6), 1e-4);
    EXPECT_LT(run.swivel_rad(0, 0.6), 0.03);
    EXPECT_NEAR(run.swivel_rad(0, 2.5), 0.1, 1e-5);
}

TEST(BendLight, LostSignalGoesStraightAheadAndComesBack) {
    ControlParameters control = bend_light(BendLaw::yaw_rate);
    control.failures = {{ControlFailure::Kind::lost_signal, 1.0, 4.0, "ego.yaw_rate_rad_s"}};
    const ControlRun run = run_control(control, two_lamps, car, [](double t) { return circle(t, 20.0, 150.0); }, {8.0, 0.1});
    EXPECT_NEAR(run.swivel_rad(0, 1.0), 0.1, 1e-9);
    EXPECT_NEAR(run.swivel_rad(0, 3.9), 0.0, 1e-6);
    EXPECT_NEAR(run.swivel_rad(0, 7.9), 0.1, 1e-6);
}

TEST(BendLight, StuckSwivelStaysWhereItIs) {
    ControlParameters control = bend_light(BendLaw::yaw_rate);
    control.failures = {{ControlFailure::Kind::stuck_swivel, 1.0, 6.0, "left"}};
    control.stuck_swivel = std::nullopt;
    const ControlRun run =
        run_control(control, two_lamps, car, [](double t) { return circle(t, 20.0, t < 1.5 ? 150.0 : -150.0); }, {8.0, 0.1});
    EXPECT_NEAR(run.swivel_rad(0, 5.9), 0.1, 1e-9);
    EXPECT_NEAR(run.swivel_rad(1, 5.9), -0.1, 1e-6);
    EXPECT_NEAR(run.swivel_rad(0, 7.9), -0.1, 1e-6);
}

/// Left, into a left bend, the lamp jams; then the bend goes right. Within the filter's and the diagnosis' time the other looks straight
/// ahead, and the stuck lamp goes down, or dims where nothing levels it.
TEST(BendLight, AStuckSwivelIsFoundAndMadeSafe) {
    ControlParameters control = bend_light(BendLaw::yaw_rate);
    control.failures = {{ControlFailure::Kind::stuck_swivel, 1.0, 6.0, "left"}};
    const auto run_of = [](const ControlParameters& with, double radius_m = -150.0) {
        return run_control(with, two_lamps, car, [=](double t) { return circle(t, 20.0, t < 1.5 ? 150.0 : radius_m); }, {8.0, 0.1});
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
    const ControlRun run = run_control(control, two_lamps, car, weaving, {20.0, 0.1});
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
    const ControlRun run =
        run_control(bend_light(BendLaw::yaw_rate), two_lamps, car, [](double t) { return circle(t, 20.0, 1.0); }, {1.0, 0.1});
    EXPECT_NEAR(run.swivel_rad(0, 1.0), 0.0, 1e-9) << "20 rad/s are no car's";
    ASSERT_FALSE(run.notes.empty());
    EXPECT_EQ(run.notes[0], "signal ego.yaw_rate_rad_s was outside -6.3 to 6.3 rad/s at 50 ticks, and taken for lost there");
}

TEST(Signals, UnknownNamesNameTheNearest) {
    const SignalTable table({"left"});
    EXPECT_EQ(table.name(table.find("lamp.left.swivel_rad")), "lamp.left.swivel_rad");
    EXPECT_EQ(table.find("ego.speed_mps"), std::size_t{signal::ego_speed});
    try {
        table.find("ego.sped_mps");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "'ego.speed_mps', the nearest signal");
    }
}

} // namespace
} // namespace fernlicht
