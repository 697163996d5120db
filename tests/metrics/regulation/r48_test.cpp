// Loads, bodies and circles worked out by hand, and the body against the simulated car.
#include "metrics/regulation/r48.h"

#include "scenarios/values/pose.h"
#include "scenarios/vehicle/car_run.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(R48Loads, AreThoseOfOurCarByHand) {
    const VehicleParameters car; // 1500 kg, 45 % of it on the rear axle
    const auto loads = r48_load_states(car, 2.7, {});
    ASSERT_EQ(loads.size(), 5u);
    EXPECT_EQ(loads[0], (LoadState{.name = "driver"}));
    EXPECT_NEAR(loads[1].rear_kg, 75.0 * 1.25 / 2.7, 1e-9);
    EXPECT_NEAR(loads[1].front_kg, 75.0 - 75.0 * 1.25 / 2.7, 1e-9);
    EXPECT_NEAR(loads[2].rear_kg, 213.8889, 1e-4); // 75 kg 1.25 m and 225 kg 2.15 m behind the front axle
    EXPECT_NEAR(loads[2].front_kg, 86.1111, 1e-4);
    // The rear axle may carry 1100 kg and has 675: 425 more. The boot behind it takes weight off the front.
    EXPECT_NEAR(loads[3].rear_kg, 425.0, 1e-9);
    EXPECT_NEAR(loads[3].front_kg, 300.0 + 183.8710 - 425.0, 1e-4); // 211.1111 kg times 2.7 / 3.1
    EXPECT_NEAR(loads[4].rear_kg, 425.0, 1e-9);
    EXPECT_NEAR(loads[4].front_kg, 370.1613 - 425.0, 1e-4);
    CarCapacity light;
    light.permissible_kg = 1900.0; // 400 kg with the driver aboard, of which 300 sit
    EXPECT_NEAR(r48_load_states(car, 2.7, light)[3].rear_kg, 213.8889 + 100.0 * 3.1 / 2.7, 1e-4) << "the mass ends it before the axle";
}

TEST(R48Loads, ScaleWithTheCar) {
    VehicleParameters car;
    car.mass_kg = 3000.0;
    const CarCapacity twice = CarCapacity::usual(car, 5.4);
    EXPECT_EQ(twice.boot_m, 6.2);
    EXPECT_EQ(twice.permissible_rear_axle_kg, 2200.0);
    EXPECT_EQ(twice.person_kg, 75.0);
    EXPECT_EQ(CarCapacity::usual({}, 2.7), CarCapacity{});
}

TEST(LoadedBody, StandsAsTheCarModelComesToRest) {
    CarModel model;
    const LoadState load{"", -54.84, 425.0};
    model.car.load_steps = {{1.0, load.front_kg, load.rear_kg}};
    const CarPlace rest = run_car(model, {{0.0, 0.0, 0.0}}, 30.0).at(29.9);
    const LoadedBody body = loaded_body(model.car, model.wheelbase_m, LevellingParameters{}, load);
    EXPECT_NEAR(body.pitch_rad, rest.pitch_rad, 1e-6);
    EXPECT_NEAR(body.levelling_rad, -rest.spring_pitch_rad, 1e-6);
    EXPECT_FALSE(body.at_stop);
    EXPECT_EQ(loaded_body(model.car, model.wheelbase_m, std::nullopt, load).levelling_rad, 0.0);
    LevellingParameters narrow;
    narrow.actuator.min_rad = -0.01;
    const LoadedBody held = loaded_body(model.car, model.wheelbase_m, narrow, load);
    EXPECT_EQ(held.levelling_rad, -0.01);
    EXPECT_TRUE(held.at_stop);
}

TEST(CarCircle, GoesThroughThreePlaces) {
    const auto at = [](double radius_m, double angle) {
        return glm::dvec2(radius_m * std::sin(angle), radius_m * (1.0 - std::cos(angle)));
    };
    const auto left = circle_through(at(150.0, -0.02), at(150.0, 0.0), at(150.0, 0.01));
    ASSERT_TRUE(left);
    EXPECT_NEAR(left->curvature_per_m, 1.0 / 150.0, 1e-9);
    EXPECT_NEAR(left->forward.x, 1.0, 1e-9);
    EXPECT_NEAR(left->forward.y, 0.0, 1e-9);
    EXPECT_NEAR(circle_through({-1.0, -0.01}, {0.0, 0.0}, {1.0, -0.01})->curvature_per_m, -0.02 / (1.0 + 1e-4), 1e-9)
        << "2 sagitta / chord^2";
    EXPECT_EQ(circle_through({0.0, 0.0}, {1.0, 1.0}, {3.0, 3.0})->curvature_per_m, 0.0);
    EXPECT_FALSE(circle_through({1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0})) << "a car that stands";
}

TEST(KinkCrossing, IsTheChordWorkedOutByHand) {
    const auto turned = [](double deg) { return glm::dvec2(std::cos(radians(deg)), std::sin(radians(deg))); };
    const CarCircle left{{0.0, 0.0}, {1.0, 0.0}, 1.0 / 150.0};
    const auto distance_m = [](const std::optional<glm::dvec2>& at, glm::dvec2 from) { return glm::length(at.value() - from); };
    // From the circle itself: 2 R sin of the angle to the tangent.
    EXPECT_NEAR(distance_m(last_crossing_m(left, {0.0, 0.0}, turned(10.0)), {0.0, 0.0}), 52.0945, 1e-4);
    // From 2 m ahead on the tangent, towards 10 degrees to the left: s^2 - 2 (150 sin 10 - 2 cos 10) s + 4 = 0.
    EXPECT_NEAR(distance_m(last_crossing_m(left, {2.0, 0.0}, turned(10.0)), {2.0, 0.0}), 48.0720, 1e-4);
    EXPECT_FALSE(last_crossing_m(left, {2.0, 0.0}, turned(-5.0))) << "out of the bend";
    EXPECT_FALSE(last_crossing_m(left, {2.0, 0.0}, turned(0.0))) << "straight ahead outside of the circle";
    // 0.6 m inside of a car that is not turned: sqrt(2 * 0.6 * 150 - 0.6^2), turned or not.
    EXPECT_NEAR(distance_m(last_crossing_m(left, {0.0, 0.6}, turned(0.0)), {0.0, 0.6}), 13.4030, 1e-4);
    const CarCircle right{{5.0, -3.0}, {0.0, 1.0}, -1.0 / 150.0}; // northwards, bending to the east
    EXPECT_NEAR(distance_m(last_crossing_m(right, {5.0, -1.0}, turned(80.0)), {5.0, -1.0}), 48.0720, 1e-4);
    EXPECT_FALSE(last_crossing_m({{0.0, 0.0}, {1.0, 0.0}, 0.0}, {2.0, 0.1}, turned(-0.01))) << "no bend";
}

} // namespace
} // namespace fernlicht
