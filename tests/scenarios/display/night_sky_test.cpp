#include "scenarios/display/night_sky.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fernlicht {
namespace {

constexpr double degree_rad = std::numbers::pi / 180.0;

glm::dvec3 sky_at(double azimuth_deg, double elevation_deg) {
    return {std::cos(elevation_deg * degree_rad) * std::sin(azimuth_deg * degree_rad),
            std::cos(elevation_deg * degree_rad) * std::cos(azimuth_deg * degree_rad), std::sin(elevation_deg * degree_rad)};
}

/// By hand, k = 0.3: X(60) = 1 / sqrt(1 - 0.96 0.75) = 1.889822, 10^(-0.12 0.889822) = 0.782026; X(90) = 5, 10^(-0.48) = 0.331131.
TEST(NightSky, BrightensTowardsTheHorizonAsTheAirLets) {
    const NightSky sky;
    EXPECT_NEAR(night_sky_cdm2(sky, {}, sky_at(0.0, 90.0)), 2.5e-4, 1.0e-12);
    EXPECT_NEAR(night_sky_cdm2(sky, {}, sky_at(10.0, 30.0)), 2.5e-4 * 1.889822 * 0.782026, 1.0e-9);
    EXPECT_NEAR(night_sky_cdm2(sky, {}, sky_at(10.0, 1.0e-6)), 2.5e-4 * 5.0 * 0.331131, 1.0e-9);
    EXPECT_EQ(night_sky_cdm2(sky, {}, sky_at(10.0, -0.001)), 0.0);
}

/// Moon at the zenith, 0.2 lx = 0.01858061 fc; 45 degrees off it, X = 1 / sqrt(1 - 0.48) = 1.386750: f = 10^5.36 1.56 + 10^5.025 =
/// 463300.7, 1 - 10^(-0.12 1.386750) = 0.318305; 463300.7 0.01858061 0.318305 nL = 2740.1 nL = 8.7220e-3 cd/m2.
TEST(NightSky, MoonlightScattersAsPublished) {
    const NightSky dark{.zenith_cdm2 = 0.0};
    const SkyMoon moon{{0.0, 0.0, 1.0}, 0.2};
    EXPECT_NEAR(night_sky_cdm2(dark, moon, sky_at(123.0, 45.0)) / 8.7220e-3, 1.0, 1.0e-3);
    EXPECT_GT(night_sky_cdm2(dark, moon, sky_at(0.0, 85.0)), night_sky_cdm2(dark, moon, sky_at(0.0, 60.0)));
    // 0.2 lx over a disc of 6.8068e-5 sr.
    EXPECT_NEAR(moon_disc_cdm2(moon), 2938.2, 1.0);
}

/// 0.01 P d^-2.5 of the natural zenith: 100 000 inhabitants 10 km away light the sky at 45 degrees 3.162 times as bright.
TEST(NightSky, TownsGlowByWalkersLaw) {
    NightSky sky, bare;
    sky.towns = {{"east", 90.0 * degree_rad, 10.0, 1.0e5}};
    const auto glow = [&](double azimuth_deg, double elevation_deg) {
        return (night_sky_cdm2(sky, {}, sky_at(azimuth_deg, elevation_deg)) -
                night_sky_cdm2(bare, {}, sky_at(azimuth_deg, elevation_deg))) /
               2.5e-4;
    };
    EXPECT_NEAR(glow(90.0, 45.0), 3.16228, 1.0e-4);
    EXPECT_NEAR(glow(0.0, 90.0), 3.16228 * std::exp(-45.0 / 35.0), 1.0e-4);
    EXPECT_GT(glow(90.0, 5.0), glow(90.0, 45.0));
    EXPECT_GT(glow(90.0, 5.0), 3.0 * glow(270.0, 5.0));
}

} // namespace
} // namespace fernlicht
