#include "scenarios/sky/ephemeris.h"

#include "scenarios/sky/moon_terms.h"
#include "scenarios/values/pose.h"

#include <cmath>
#include <cstdlib>

namespace fernlicht {
namespace {

constexpr double arc_second = pi / (180.0 * 3600.0);

double turn(double degrees_any) { return radians(degrees_any - 360.0 * std::floor(degrees_any / 360.0)); }

/// Longitude of the mean ascending node of the moon's orbit.
double node_rad(double t) { return turn(125.04452 - 1934.136261 * t); }

/// Ecliptic -> equatorial (13.3, 13.4).
void place_on_equator(CelestialPlace& place, double obliquity_rad) {
    const double ce = std::cos(obliquity_rad), se = std::sin(obliquity_rad);
    const double l = place.longitude_rad, b = place.latitude_rad;
    const double ra = std::atan2(std::sin(l) * ce * std::cos(b) - std::sin(b) * se, std::cos(l) * std::cos(b));
    place.right_ascension_rad = ra < 0.0 ? ra + 2.0 * pi : ra;
    place.declination_rad = std::asin(std::sin(b) * ce + std::cos(b) * se * std::sin(l));
}

/// Terms with the sun's anomaly shrink with the Earth's eccentricity.
double eccentricity_factor(int multiple_of_sun, double e) {
    return std::abs(multiple_of_sun) == 0 ? 1.0 : std::abs(multiple_of_sun) == 1 ? e : e * e;
}

} // namespace

Ecliptic ecliptic_at(double t) {
    const double node = node_rad(t), sun = turn(280.4665 + 36000.7698 * t), moon = turn(218.3165 + 481267.8813 * t);
    const double longitude =
        -17.20 * std::sin(node) - 1.32 * std::sin(2.0 * sun) - 0.23 * std::sin(2.0 * moon) + 0.21 * std::sin(2.0 * node);
    const double tilt = 9.20 * std::cos(node) + 0.57 * std::cos(2.0 * sun) + 0.10 * std::cos(2.0 * moon) - 0.09 * std::cos(2.0 * node);
    const double mean = 84381.448 + t * (-46.8150 + t * (-0.00059 + t * 0.001813));
    return {longitude * arc_second, (mean + tilt) * arc_second};
}

CelestialPlace sun_place(double t) {
    const double mean_longitude_deg = 280.46646 + t * (36000.76983 + t * 0.0003032);
    const double anomaly = turn(357.52911 + t * (35999.05029 - t * 0.0001537));
    const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
    const double centre_deg = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                              (0.019993 - t * 0.000101) * std::sin(2.0 * anomaly) + 0.000289 * std::sin(3.0 * anomaly);
    const double node = turn(125.04 - 1934.136 * t);
    CelestialPlace sun;
    sun.longitude_rad = turn(mean_longitude_deg + centre_deg - 0.00569 - 0.00478 * std::sin(node));
    sun.distance_km = astronomical_unit_km * 1.000001018 * (1.0 - eccentricity * eccentricity) /
                      (1.0 + eccentricity * std::cos(anomaly + radians(centre_deg)));
    place_on_equator(sun, ecliptic_at(t).obliquity_rad);
    return sun;
}

CelestialPlace moon_place(double t) {
    const double mean = turn(218.3164477 + t * (481267.88123421 + t * (-0.0015786 + t * (1.0 / 538841.0 - t / 65194000.0))));
    const double elongation = turn(297.8501921 + t * (445267.1114034 + t * (-0.0018819 + t * (1.0 / 545868.0 - t / 113065000.0))));
    const double sun = turn(357.5291092 + t * (35999.0502909 + t * (-0.0001536 + t / 24490000.0)));
    const double anomaly = turn(134.9633964 + t * (477198.8675055 + t * (0.0087414 + t * (1.0 / 69699.0 - t / 14712000.0))));
    const double latitude = turn(93.2720950 + t * (483202.0175233 + t * (-0.0036539 + t * (-1.0 / 3526000.0 + t / 863310000.0))));
    const double a1 = turn(119.75 + 131.849 * t), a2 = turn(53.09 + 479264.290 * t), a3 = turn(313.45 + 481266.484 * t);
    const double e = 1.0 - t * (0.002516 + t * 0.0000074);

    double l = 3958.0 * std::sin(a1) + 1962.0 * std::sin(mean - latitude) + 318.0 * std::sin(a2), r = 0.0;
    for (const MoonLongitudeTerm& term : moon_longitude_terms) {
        const double angle = term.elongation * elongation + term.sun * sun + term.moon * anomaly + term.latitude * latitude;
        const double factor = eccentricity_factor(term.sun, e);
        l += factor * term.longitude_udeg * std::sin(angle);
        r += factor * term.distance_m * std::cos(angle);
    }
    double b = -2235.0 * std::sin(mean) + 382.0 * std::sin(a3) + 175.0 * (std::sin(a1 - latitude) + std::sin(a1 + latitude)) +
               127.0 * std::sin(mean - anomaly) - 115.0 * std::sin(mean + anomaly);
    for (const MoonLatitudeTerm& term : moon_latitude_terms)
        b += eccentricity_factor(term.sun, e) * term.latitude_udeg *
             std::sin(term.elongation * elongation + term.sun * sun + term.moon * anomaly + term.latitude * latitude);

    const Ecliptic ecliptic = ecliptic_at(t);
    CelestialPlace moon;
    moon.longitude_rad = turn(degrees(mean) + 1e-6 * l + degrees(ecliptic.nutation_rad));
    moon.latitude_rad = radians(1e-6 * b);
    moon.distance_km = 385000.56 + 1e-3 * r;
    place_on_equator(moon, ecliptic.obliquity_rad);
    return moon;
}

double phase_angle_rad(const CelestialPlace& sun, const CelestialPlace& moon) {
    const double cosine =
        std::sin(sun.declination_rad) * std::sin(moon.declination_rad) +
        std::cos(sun.declination_rad) * std::cos(moon.declination_rad) * std::cos(sun.right_ascension_rad - moon.right_ascension_rad);
    const double sine = std::sqrt(std::fmax(1.0 - cosine * cosine, 0.0));
    return std::atan2(sun.distance_km * sine, moon.distance_km - sun.distance_km * cosine);
}

int days_in_month(int year, int month) {
    const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return month == 2 ? (leap ? 29 : 28) : (month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31);
}

double julian_day(const CalendarTime& time) {
    const int y = time.month > 2 ? time.year : time.year - 1, m = time.month > 2 ? time.month : time.month + 12;
    const double century = std::floor(y / 100.0), leap = 2.0 - century + std::floor(century / 4.0);
    return std::floor(365.25 * (y + 4716)) + std::floor(30.6001 * (m + 1)) + time.day + leap - 1524.5 + time.hours_ut / 24.0;
}

double delta_t_s(double julian_day_ut) {
    const double year = 2000.0 + (julian_day_ut - 2451544.5) / 365.2425, t = year - 2000.0;
    if (year >= 1986.0 && year < 2005.0)
        return 63.86 + t * (0.3345 + t * (-0.060374 + t * (0.0017275 + t * (0.000651814 + t * 0.00002373599))));
    if (year >= 2005.0 && year < 2050.0)
        return 62.92 + t * (0.32217 + t * 0.005589);
    const double u = (year - 1820.0) / 100.0;
    return -20.0 + 32.0 * u * u;
}

double julian_centuries(double julian_day_tt) { return (julian_day_tt - 2451545.0) / 36525.0; }

double sidereal_time_rad(double julian_day_ut, double nutation_rad, double obliquity_rad) {
    const double days = julian_day_ut - 2451545.0, t = days / 36525.0;
    const double mean_deg = 280.46061837 + 360.98564736629 * days + t * t * (0.000387933 - t / 38710000.0);
    const double angle = radians(std::fmod(mean_deg, 360.0)) + nutation_rad * std::cos(obliquity_rad);
    return angle - 2.0 * pi * std::floor(angle / (2.0 * pi));
}

double refraction_rad(double altitude_rad, double pressure_hpa, double temperature_c) {
    const double h = degrees(altitude_rad);
    if (h < -5.0)
        return 0.0;
    const double arc_minutes = 1.02 / std::tan(radians(h + 10.3 / (h + 5.11)));
    return radians(std::fmax(arc_minutes, 0.0) / 60.0) * (pressure_hpa / 1010.0) * (283.0 / (273.0 + temperature_c));
}

HorizontalPlace horizontal_place(const CelestialPlace& body, double sidereal_rad, const GeographicPlace& from) {
    const double hour_angle = sidereal_rad + from.longitude_rad - body.right_ascension_rad;
    const double cd = std::cos(body.declination_rad), sd = std::sin(body.declination_rad);
    const double cp = std::cos(from.latitude_rad), sp = std::sin(from.latitude_rad);
    const double east = -cd * std::sin(hour_angle), north = sd * cp - cd * sp * std::cos(hour_angle);
    const double up = sp * sd + cp * cd * std::cos(hour_angle) - 6378.14 / body.distance_km;
    HorizontalPlace place;
    const double azimuth = std::atan2(east, north);
    place.azimuth_rad = azimuth < 0.0 ? azimuth + 2.0 * pi : azimuth;
    place.altitude_rad = std::atan2(up, std::hypot(east, north));
    place.apparent_rad = place.altitude_rad + refraction_rad(place.altitude_rad);
    return place;
}

glm::dvec3 horizon_direction(double azimuth_rad, double elevation_rad) {
    const double level = std::cos(elevation_rad);
    return {std::sin(azimuth_rad) * level, std::cos(azimuth_rad) * level, std::sin(elevation_rad)};
}

} // namespace fernlicht
