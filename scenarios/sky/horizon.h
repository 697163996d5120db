// From places among the stars to directions above a horizon.
#pragma once

#include "scenarios/sky/ephemeris.h"

#include <glm/vec3.hpp>

namespace fernlicht {

struct GeographicPlace {
    double latitude_rad = 0.0, longitude_rad = 0.0; ///< north and east positive
};

/// As seen from a place: azimuth from north over east, 0..2 pi. `altitude_rad` is geometric (as if without air), `apparent_rad` with
/// refraction.
struct HorizontalPlace {
    double azimuth_rad = 0.0, altitude_rad = 0.0, apparent_rad = 0.0;
};

/// Refraction of a geometric altitude, in radians: Saemundsson (Meeus 16.4), for `pressure_hpa` and `temperature_c`. Falls to nothing by 5
/// degrees below the horizon, and is 0 from there on.
double refraction_rad(double altitude_rad, double pressure_hpa = 1010.0, double temperature_c = 10.0);

/// `sidereal_rad`: apparent, at Greenwich. Parallax is taken from the distance on a spherical Earth of 6378.14 km.
HorizontalPlace horizontal_place(const CelestialPlace& body, double sidereal_rad, const GeographicPlace& from);

/// Unit vector in a world with x east, y north, z up.
glm::dvec3 horizon_direction(double azimuth_rad, double elevation_rad);

} // namespace fernlicht
