#include "scenarios/sky/horizon.h"

#include "scenarios/values/pose.h"

#include <cmath>

namespace fernlicht {

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
