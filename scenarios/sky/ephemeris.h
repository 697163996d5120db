// Where sun and moon stand, seen from the Earth's centre: J. Meeus, Astronomical Algorithms, 2nd edition, chapters 22, 25, 47, 48.
#pragma once

namespace fernlicht {

inline constexpr double astronomical_unit_km = 149597870.7;

/// Nutation along the ecliptic within 0.5 arc seconds, and the true obliquity (Meeus, chapter 22).
struct Ecliptic {
    double nutation_rad = 0.0, obliquity_rad = 0.0;
};
Ecliptic ecliptic_at(double centuries_tt);

/// Apparent place: of the true equinox of date, aberration and nutation included.
struct CelestialPlace {
    double longitude_rad = 0.0, latitude_rad = 0.0; ///< ecliptic
    double right_ascension_rad = 0.0, declination_rad = 0.0;
    double distance_km = 0.0;
};

/// Within 0.01 degrees between 1800 and 2200 (chapter 25, low accuracy).
CelestialPlace sun_place(double centuries_tt);
/// Within 10 arc seconds in longitude and 4 in latitude (chapter 47).
CelestialPlace moon_place(double centuries_tt);

/// Sun - moon - Earth, 0 at full moon, pi at new moon (Meeus 48.2 and 48.3).
double phase_angle_rad(const CelestialPlace& sun, const CelestialPlace& moon);
/// Of the moon's disc, 0..1 (48.1).
double illuminated_fraction(double phase_angle_rad);

} // namespace fernlicht
