// The light of the sky at a moment: sun, moon and what comes diffusely from all sides.
#pragma once

#include "scenarios/sky/ephemeris.h"
#include "scenarios/sky/sky_light.h"

#include <optional>
#include <string>

namespace fernlicht {

/// Sun or moon: parallel light. Shines only with illuminance above 0.
struct DirectLight {
    double azimuth_rad = 0.0;    ///< from north (world y) over east (world x)
    double elevation_rad = 0.0;  ///< as it is seen, refraction included
    double illuminance_lx = 0.0; ///< on a plane perpendicular to it

    glm::dvec3 towards() const { return horizon_direction(azimuth_rad, elevation_rad); } ///< unit vector in the world
    bool operator==(const DirectLight&) const = default;
};

/// When and where the light of the sky is asked for.
struct SkyClock {
    int year = 2000, month = 1, day = 1;
    int seconds_of_day = 0; ///< local time, 0 to 86399
    double utc_offset_h = 0.0;
    double latitude_deg = 0.0, longitude_deg = 0.0; ///< north and east positive
    SkyCover cover = SkyCover::clear;
    double rate = 0.0; ///< seconds of the sky for a second of the drive; 0: it stands still

    bool operator==(const SkyClock&) const = default;
};

struct Daylight {
    std::string name = "night";
    double horizontal_illuminance_lx = 0.0; ///< diffuse, from a uniform sky
    DirectLight sun = {}, moon = {};        ///< one of them at most shines: beside the sun the moon's light counts as diffuse
    std::optional<SkyClock> clock = std::nullopt;

    /// The one that shines; nullptr: neither.
    const DirectLight* direct() const { return sun.illuminance_lx > 0.0 ? &sun : moon.illuminance_lx > 0.0 ? &moon : nullptr; }
    bool operator==(const Daylight&) const = default;
};

/// Of the uniform sky with this horizontal illuminance: E / pi.
double sky_luminance_cdm2(const Daylight& daylight);

/// The light `time_s` after the clock's date and time, at the clock's rate. The name is kept from `daylight`. Without a clock: `daylight`
/// itself. Direct light below 1e-6 lx is none.
Daylight daylight_at(const Daylight& daylight, double time_s);

} // namespace fernlicht
