// Where sun and moon stand, seen from the Earth's centre: J. Meeus, Astronomical Algorithms, 2nd edition, chapters 22, 25, 47, 48.
// Dates as astronomers count them. Gregorian calendar throughout.
// From places among the stars to directions above a horizon.
#pragma once

#include <glm/vec3.hpp>

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

/// A moment by date and universal time.
struct CalendarTime {
    int year = 2000, month = 1, day = 1; ///< 1 <= month <= 12
    double hours_ut = 0.0;               ///< may lie outside 0..24: it then counts into the neighbouring days
};

/// Days from year 1 on that month has.
int days_in_month(int year, int month);

/// Julian day of universal time (Meeus, Astronomical Algorithms, 7.1).
double julian_day(const CalendarTime& time);

/// Seconds by which dynamical time is ahead of universal time: Espenak and Meeus (NASA, Five Millennium Canon of Solar Eclipses) for
/// 1986 to 2050; their long-term parabola elsewhere, which is minutes off at most between 1600 and 2200.
double delta_t_s(double julian_day_ut);

/// Julian centuries of dynamical time since J2000.0.
double julian_centuries(double julian_day_tt);

/// Apparent sidereal time at Greenwich in radians, 0..2 pi (Meeus 12.4, with the nutation of `nutation_rad` along the ecliptic).
double sidereal_time_rad(double julian_day_ut, double nutation_rad, double obliquity_rad);

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
