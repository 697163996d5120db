#include "scenarios/drives/story_environment.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Sun of a scenario: from north over east, as OpenSCENARIO 1.x has it; diffuse light by its height as a clear sky gives it is not known,
/// so that it is a tenth of the sun's.
constexpr double diffuse_share = 0.1;

void tell_sun(const osc::Environment& from, Drive& drive) {
    if (!from.sun_elevation_rad || !from.sun_illuminance_lx)
        return;
    Daylight daylight;
    daylight.name = "storyboard";
    const double elevation = *from.sun_elevation_rad, direct = std::clamp(*from.sun_illuminance_lx, 0.0, 150'000.0);
    if (elevation > 0.0 && direct > 0.0) {
        daylight.sun = {std::fmod(from.sun_azimuth_rad.value_or(0.0), 2.0 * pi), std::min(elevation, 0.5 * pi), direct};
        daylight.horizontal_illuminance_lx = diffuse_share * direct * std::sin(daylight.sun.elevation_rad);
    }
    drive.daylight = daylight;
}

void tell_weather(const osc::Environment& from, Drive& drive) {
    Weather weather;
    if (from.fog_visual_range_m && *from.fog_visual_range_m < 20'000.0) {
        weather.extinction_per_m = extinction_of_range_per_m(*from.fog_visual_range_m);
        weather.asymmetry = fog_asymmetry;
    }
    if (from.precipitation && *from.precipitation != "dry" && from.precipitation_mm_per_h && *from.precipitation_mm_per_h > 0.0) {
        const double rate = *from.precipitation_mm_per_h;
        const Intensity intensity = rate <= 2.5 ? Intensity::light : rate <= 7.6 ? Intensity::moderate : Intensity::heavy;
        weather = together(weather, *from.precipitation == "snow" ? snow(intensity) : rain(intensity));
    }
    if (from.wetness) // shares of a full film of water by the standard's words [estimate]
        weather.wetness = std::max(weather.wetness, *from.wetness == "dry" ? 0.0 : *from.wetness == "moist" ? 0.4 : 1.0);
    drive.weather = weather;
}

} // namespace

void tell_environment(Drive& drive, const osc::PlayedStory& story) {
    const osc::EnvironmentChange* first = nullptr;
    for (const osc::EnvironmentChange& change : story.environment) {
        if (change.time_s <= 0.0)
            first = &change;
        else
            drive.notes.push_back(fmt::format("at {} s the storyboard changes the environment to '{}': daylight and weather stay as they "
                                              "were at the begin",
                                              change.time_s, change.environment.name));
    }
    if (!first)
        return;
    if (!drive.storyboard->own_daylight) {
        tell_sun(first->environment, drive);
        if (first->environment.date_time && !drive.daylight.clock)
            drive.notes.push_back(fmt::format("the storyboard's time of day {} has no place: daylight follows its sun, or the drive's "
                                              "daylight: {{date, time, latitude_deg, ...}}",
                                              *first->environment.date_time));
    }
    if (!drive.storyboard->own_weather)
        tell_weather(first->environment, drive);
}

} // namespace fernlicht
