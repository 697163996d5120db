// Evenness of light against lights whose gradients and patches are known.
#include "metrics/seeing/homogeneity.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// 1 to 80 m every 0.5 m, 3.5 m wide every 0.25 m; a driver's eye 1.2 m above the lamps' place.
template <class Lux> LaneLight lane(Lux lux) {
    LaneLight light;
    for (int k = 2; k <= 160; ++k)
        light.ahead_m.push_back(0.5 * k);
    for (int k = -7; k <= 7; ++k)
        light.offset_m.push_back(0.25 * k);
    for (const double ahead_m : light.ahead_m)
        for (const double offset_m : light.offset_m) {
            light.lx.push_back(lux(ahead_m, offset_m));
            light.seen_at.push_back({ahead_m, offset_m, -1.2});
        }
    return light;
}

double cube(double x) { return x * x * x; }

TEST(Homogeneity, GradientsOfKnownLights) {
    // lg E falls by 0.02 a metre along and by 0.1 across.
    const Gradients even = largest_gradients(lane([](double x, double y) { return 100.0 * std::pow(10.0, -0.02 * x - 0.1 * y); }), 1e-9);
    EXPECT_NEAR(even.along.per_m, 0.02, 1e-12);
    EXPECT_NEAR(even.across.per_m, 0.1, 1e-12);
    // Seen from the driver a metre along is smallest at the far end: 0.5 m at 79.5 m, in front of the eye: atan(1.2/79.5) - atan(1.2/80).
    const double degrees_along = (std::atan(1.2 / 79.5) - std::atan(1.2 / 80.0)) * 180.0 / 3.14159265358979323846;
    EXPECT_NEAR(even.along.per_degree, 0.01 / degrees_along, 2e-3 * 0.01 / degrees_along) << "columns beside the eye differ by 0.1 %";
    const Gradients cubic = largest_gradients(lane([](double x, double) { return 1e6 / cube(x); }), 1e-9);
    EXPECT_NEAR(cubic.along.per_m, 3.0 * std::log10(1.5) / 0.5, 1e-9) << "between 1 and 1.5 m";
    EXPECT_EQ(cubic.across.per_m, 0.0);
    EXPECT_EQ(largest_gradients(lane([](double, double) { return 0.5; }), 1.0).along.per_m, 0.0) << "too dark to count";
}

TEST(Homogeneity, APowerOfTheDistanceHasNoPatches) {
    for (const double power : {1.0, 2.0, 3.0, 4.0}) {
        const Unevenness found =
            patches(lane([&](double x, double y) { return 1e6 * std::pow(x, -power) * std::pow(1.5, y); }), 1e-9, 1.01);
        EXPECT_EQ(found.dark.count, 0) << power;
        EXPECT_EQ(found.bright.count, 0) << power;
    }
}

TEST(Homogeneity, FindsPlantedPatches) {
    const auto strip = [](double from_m, double to_m, double times) {
        return lane([=](double x, double y) { return 1e6 / cube(x) * (x > from_m && x < to_m && y > 0.6 ? times : 1.0); });
    };
    const Unevenness dark = patches(strip(29.9, 34.1, 0.4), 1e-9, 1.5); // rows 30 to 34 m: nine of 0.5 m
    EXPECT_EQ(dark.dark.count, 1);
    EXPECT_NEAR(dark.dark.longest_m, 4.5, 1e-9);
    EXPECT_EQ(dark.bright.count, 0);
    const Unevenness bright = patches(strip(29.9, 34.1, 2.5), 1e-9, 1.5);
    EXPECT_EQ(bright.bright.count, 1);
    EXPECT_NEAR(bright.bright.longest_m, 4.5, 1e-9);
    EXPECT_EQ(patches(strip(29.9, 34.1, 0.9), 1e-9, 1.5).dark.count, 0) << "weaker than the factor";
    EXPECT_EQ(patches(strip(29.9, 34.1, 0.4), 1e9, 1.5).dark.count, 0) << "all too dark to count";
}

TEST(Homogeneity, ForegroundAgainstDistance) {
    EXPECT_NEAR(foreground_ratio(lane([](double, double) { return 7.0; })).number().value(), 1.0, 1e-12);
    EXPECT_NEAR(foreground_ratio(lane([](double x, double) { return x < 20.0 ? 30.0 : 3.0; })).number().value(), 10.0, 1e-12);
    // 1/x from 5 to 15 m and from 40 to 60 m: (ln 3 / 10) / (ln 1.5 / 20); trapezia of half a metre lie h^2/12 (1/25 - 1/225) = 7e-4 above
    // ln 3.
    const double by_hand = std::log(3.0) / 10.0 / (std::log(1.5) / 20.0);
    EXPECT_NEAR(foreground_ratio(lane([](double x, double) { return 1.0 / x; })).number().value(), by_hand, 7e-4 * by_hand);
    EXPECT_FALSE(foreground_ratio(lane([](double x, double) { return x < 20.0 ? 30.0 : 0.0; })).measured());
    EXPECT_FALSE(foreground_ratio({}).measured());
}

TEST(Homogeneity, RefusesAGridThatDoesNotFit) {
    LaneLight light = lane([](double, double) { return 1.0; });
    light.lx.pop_back();
    EXPECT_THROW(largest_gradients(light, 1.0), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
