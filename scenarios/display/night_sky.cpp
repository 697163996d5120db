#include "scenarios/display/night_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace fernlicht {
namespace {

constexpr double cdm2_a_nanolambert = 1.0e-5 / std::numbers::pi, lx_a_footcandle = 10.7639104;
constexpr double nearest_deg = 0.3; // off the moon's disc
constexpr double town_falls_rad = 35.0 * std::numbers::pi / 180.0, walker_rad = 0.25 * std::numbers::pi;

double angle_between(const glm::dvec3& a, const glm::dvec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

double air_masses(double sine_of_elevation) {
    const double sine2 = 1.0 - sine_of_elevation * sine_of_elevation;
    return 1.0 / std::sqrt(1.0 - 0.96 * sine2);
}

/// Of moonlight by the angle from the moon: air, and aerosol.
double scattered_by_angle(double deg) {
    const double cosine = std::cos(deg * std::numbers::pi / 180.0);
    return std::pow(10.0, 5.36) * (1.06 + cosine * cosine) + std::pow(10.0, 6.15 - deg / 40.0);
}

} // namespace

double moon_disc_cdm2(const SkyMoon& moon) { return moon.illuminance_lx / (2.0 * std::numbers::pi * (1.0 - std::cos(moon_radius_rad))); }

double night_sky_cdm2(const NightSky& sky, const SkyMoon& moon, const glm::dvec3& towards) {
    if (!(towards.z > 0.0))
        return 0.0;
    const double masses = air_masses(towards.z), k = sky.extinction_mag;
    double sum = sky.zenith_cdm2 * masses * std::pow(10.0, -0.4 * k * (masses - 1.0));
    if (moon.illuminance_lx > 0.0) {
        const double deg = std::max(angle_between(towards, moon.towards) * 180.0 / std::numbers::pi, nearest_deg);
        sum += cdm2_a_nanolambert * scattered_by_angle(deg) * moon.illuminance_lx / lx_a_footcandle *
               (1.0 - std::pow(10.0, -0.4 * k * masses));
    }
    for (const Town& town : sky.towns) {
        const double apart = angle_between(towards, {std::sin(town.azimuth_rad), std::cos(town.azimuth_rad), 0.0});
        sum +=
            0.01 * town.inhabitants * std::pow(town.distance_km, -2.5) * sky.zenith_cdm2 * std::exp((walker_rad - apart) / town_falls_rad);
    }
    return sum;
}

} // namespace fernlicht
