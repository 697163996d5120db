#include "scenarios/sky/daylight.h"

#include "scenarios/sky/ephemeris.h"
#include "scenarios/values/pose.h"

#include <cmath>

namespace fernlicht {
namespace {

constexpr double min_direct_lx = 1e-6;

DirectLight direct_light(const HorizontalPlace& place, double illuminance_lx) {
    return {place.azimuth_rad, place.apparent_rad, illuminance_lx < min_direct_lx ? 0.0 : illuminance_lx};
}

} // namespace

double sky_luminance_cdm2(const Daylight& daylight) { return daylight.horizontal_illuminance_lx / pi; }

Daylight daylight_at(const Daylight& daylight, double time_s) {
    if (!daylight.clock)
        return daylight;
    const SkyClock& clock = *daylight.clock;
    const double day =
        julian_day({clock.year, clock.month, clock.day, (clock.seconds_of_day + clock.rate * time_s) / 3600.0 - clock.utc_offset_h});
    const double centuries = julian_centuries(day + delta_t_s(day) / 86400.0);
    const Ecliptic ecliptic = ecliptic_at(centuries);
    const double sidereal = sidereal_time_rad(day, ecliptic.nutation_rad, ecliptic.obliquity_rad);
    const GeographicPlace here{radians(clock.latitude_deg), radians(clock.longitude_deg)};
    const CelestialPlace sun = sun_place(centuries), moon = moon_place(centuries);
    const HorizontalPlace sun_here = horizontal_place(sun, sidereal, here), moon_here = horizontal_place(moon, sidereal, here);
    const SkyLight of_sun = sun_light(sun_here.altitude_rad, sun_here.apparent_rad, sun.distance_km, clock.cover);
    const SkyLight of_moon = moon_light(moon_here.apparent_rad, moon.distance_km, phase_angle_rad(sun, moon), clock.cover);

    Daylight result = daylight;
    result.sun = direct_light(sun_here, of_sun.direct_lx);
    result.moon = direct_light(moon_here, of_moon.direct_lx);
    result.horizontal_illuminance_lx = of_sun.diffuse_lx + of_moon.diffuse_lx;
    if (result.sun.illuminance_lx > 0.0) {
        result.horizontal_illuminance_lx += result.moon.illuminance_lx * std::fmax(std::sin(result.moon.elevation_rad), 0.0);
        result.moon.illuminance_lx = 0.0;
    }
    return result;
}

} // namespace fernlicht
