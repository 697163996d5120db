#include "scenarios/openscenario/read_environment.h"

#include <cmath>

namespace fernlicht::osc {
namespace {

void read_weather(const OscNode& node, Environment& out) {
    if (node.has("fractionalCloudCover"))
        out.cloud_state = node.text("fractionalCloudCover");
    else if (node.has("cloudState"))
        out.cloud_state = node.text("cloudState");
    if (const auto sun = node.find("Sun")) {
        out.sun_azimuth_rad = sun->number_if("azimuth");
        out.sun_elevation_rad = sun->number_if("elevation");
        out.sun_illuminance_lx = sun->has("illuminance") ? sun->number_if("illuminance") : sun->number_if("intensity");
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
