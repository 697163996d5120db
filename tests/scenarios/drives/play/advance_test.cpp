// Time and distance of a drive: exact, and a function of the tick alone.
#include "scenarios/drives/play/advance.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

Drive with_speed(std::vector<SpeedPoint> profile, double step_s, double duration_s) {
    Drive drive;
    drive.speed = std::move(profile);
    drive.step_s = step_s;
    drive.duration_s = duration_s;
    return drive;
}

TEST(Advance, ConstantSpeed) {
    const Drive drive = with_speed({{0.0, 20.0}}, 0.5, 10.0);
    State state = start(drive);
    EXPECT_EQ(state, (State{0, 0.0, 0.0, 20.0}));
    for (int i = 0; i < 7; ++i)
        state = advance(state, drive);
    EXPECT_EQ(state, (State{7, 3.5, 70.0, 20.0}));
}

TEST(Advance, DistanceIsTheIntegralOfThePiecewiseLinearSpeed) {
    // 10 m/s until 1 s, up to 20 m/s at 3 s, down to a stop at 8 s: 10 + 30 + 50 = 90 m.
    const std::vector<SpeedPoint> profile{{1.0, 10.0}, {3.0, 20.0}, {8.0, 0.0}};
    EXPECT_EQ(distance_m(profile, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 0.5), 5.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 1.0), 10.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 2.0), 10.0 + 12.5);
    EXPECT_DOUBLE_EQ(distance_m(profile, 3.0), 40.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 8.0), 90.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 100.0), 90.0) << "stands after the last point";
    EXPECT_DOUBLE_EQ(speed_mps(profile, 0.2), 10.0);
    EXPECT_DOUBLE_EQ(speed_mps(profile, 5.5), 10.0);
    EXPECT_DOUBLE_EQ(speed_mps(profile, 9.0), 0.0);
    double sum = 0.0;
    constexpr double dt = 1.0e-4;
    for (int i = 0; i < 60'000; ++i)
        sum += dt * speed_mps(profile, (i + 0.5) * dt);
    EXPECT_NEAR(sum, distance_m(profile, 6.0), 1e-9);
}

TEST(Advance, NoDriftOverAMillionSteps) {
    const Drive drive = with_speed({{0.0, 30.0}}, 1.0 / 30.0, 1.0e5);
    State state = start(drive);
    for (int i = 0; i < 1'000'000; ++i)
        state = advance(state, drive);
    EXPECT_NEAR(state.distance_m, 1.0e6, 1e-9) << "adding up 1/30 s gives an error a million times larger";
    EXPECT_EQ(state, advance({999'999, 0.0, 0.0, 0.0}, drive)) << "only the tick counts";
}

TEST(Advance, TicksFillTheDurationWithoutItsEnd) {
    EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 1.0 / 30.0, 12.0)), 360);
    EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 0.1, 0.3)), 3) << "0.3 / 0.1 is 2.9999999999999996";
    EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 0.1, 0.31)), 4);
    EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 1.0, 0.1)), 1);
    for (const int rate : {7, 24, 25, 29, 30, 50, 60, 90, 120})
        for (const int seconds : {1, 3, 10, 3600})
            EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 1.0 / rate, seconds)), rate * seconds) << rate << " Hz, " << seconds << " s";
}

} // namespace
} // namespace fernlicht
