#include "scenarios/openscenario/reader/read_environment.h"

#include "scenarios/sky/sky_light.h"

#include <cmath>

namespace fernlicht::osc {
namespace {

constexpr double mean_sun_km = 149.598e6;

/// Files before 1.2 have an intensity. It was meant in lux; many write a share instead, which here is one of the clear sky's sun.
std::optional<double> illuminance_of_intensity_lx(const OscNode& sun) {
    const auto intensity = sun.number_if("intensity"), elevation = sun.number_if("elevation");
    if (!intensity || *intensity > 1.0 || !elevation)
        return intensity;
    return *intensity * sun_light(*elevation, *elevation, mean_sun_km, SkyCover::clear).direct_lx;
}

void read_weather(const OscNode& node, Environment& out) {
    if (node.has("fractionalCloudCover"))
        out.cloud_state = node.text("fractionalCloudCover");
    else if (node.has("cloudState"))
        out.cloud_state = node.text("cloudState");
    if (const auto sun = node.find("Sun")) {
        out.sun_azimuth_rad = sun->number_if("azimuth");
        out.sun_elevation_rad = sun->number_if("elevation");
        out.sun_illuminance_lx = sun->has("illuminance") ? sun->number_if("illuminance") : illuminance_of_intensity_lx(*sun);
    }
    if (const auto fog = node.find("Fog"); fog && fog->has("visualRange")) {
        out.fog_visual_range_m = fog->number("visualRange");
        if (!(*out.fog_visual_range_m > 0.0))
            fog->refuse("visualRange", "found a range that is not above 0", "metres above 0");
    }
    if (const auto rain = node.find("Precipitation")) {
        out.precipitation = rain->text_or("precipitationType", rain->text_or("type", "dry"));
        out.precipitation_mm_per_h =
            rain->has("precipitationIntensity") ? rain->number_if("precipitationIntensity") : rain->number_if("intensity"); // 1.0: 0..1
    }
}

} // namespace

Environment read_environment(const OscNode& node) {
    Environment out;
    out.name = node.name();
    if (const auto time = node.find("TimeOfDay")) {
        out.date_time = time->has("dateTime") ? std::optional(time->text("dateTime")) : std::nullopt;
        out.time_runs = time->flag_or("animation", false);
    }
    if (const auto weather = node.find("Weather"))
        read_weather(*weather, out);
    if (const auto road = node.find("RoadCondition")) {
        out.friction_scale = road->has("frictionScaleFactor") ? road->number_if("frictionScaleFactor") : road->number_if("frictionScale");
        if (road->has("wetness"))
            out.wetness = road->text("wetness");
    }
    return out;
}

} // namespace fernlicht::osc
