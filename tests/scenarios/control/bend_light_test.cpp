#include "scenarios/control/control_run.h"
#include "scenarios/values/pose.h"

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
    const ControlRun run =
        run_control(control, two_lamps, car, [](double t) { return circle(t, 20.0, t < 1.5 ? 150.0 : -150.0); }, {8.0, 0.1});
    EXPECT_NEAR(run.swivel_rad(0, 5.9), 0.1, 1e-9);
    EXPECT_NEAR(run.swivel_rad(1, 5.9), -0.1, 1e-6);
    EXPECT_NEAR(run.swivel_rad(0, 7.9), -0.1, 1e-6);
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
