// The sky of a clear night as pictures show it: airglow and stars that brighten towards the horizon, moonlight scattered in the air, the
// glow of towns. Readings have the drive's uniform sky.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace fernlicht {

/// Lights up the sky above it.
struct Town {
    std::string name;
    double azimuth_rad = 0.0;     ///< from north (world y) over east (world x)
    double distance_km = 20.0;    ///< > 0; Walker's law was found from 10 to 50
    double inhabitants = 10000.0; ///< >= 0
    bool operator==(const Town&) const = default;
};

struct NightSky {
    double zenith_cdm2 = 2.5e-4; ///< without moon and towns; 79 nL, a dark site of Krisciunas and Schaefer 1991
    double extinction_mag = 0.3; ///< of the air above, magnitudes at the zenith; 0.17 on a mountain, 0.3 in clear air of lowlands
    std::vector<Town> towns = {};
    bool operator==(const NightSky&) const = default;
};

/// The moon as the ground has it: unit vector to its centre, illuminance behind the air on a plane across it, 0: none.
struct SkyMoon {
    glm::dvec3 towards{0.0, 0.0, 1.0};
    double illuminance_lx = 0.0;
};

/// cd/m2 in the direction of a unit vector, z up; 0 below the horizon. With X = (1 - 0.96 sin^2 Z)^-0.5 and k the extinction:
/// - of the sky itself, zenith 10^(-0.4 k (X - 1)) X, and of the moon off its disc, f(rho) E 10^..., both Krisciunas and Schaefer 1991
///   (doi:10.1086/132921), equations 2, 3, 15, 21;
/// - of a town of P inhabitants d km away 0.01 P d^-2.5 of the zenith's at 45 degrees above it (Walker 1977, doi:10.1086/130142). How it
///   falls with the angle from the town's place on the horizon, by e in 35 degrees, is ours: a quarter of it is left at the zenith.
double night_sky_cdm2(const NightSky& sky, const SkyMoon& moon, const glm::dvec3& towards);

/// Luminance of the moon's disc, of 0.2667 degrees in radius.
double moon_disc_cdm2(const SkyMoon& moon);
inline constexpr double moon_radius_rad = 0.2667 * 3.14159265358979323846 / 180.0;

} // namespace fernlicht
