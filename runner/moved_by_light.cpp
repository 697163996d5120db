#include "runner/moved_by_light.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace fernlicht {
namespace {

std::optional<double> value_of(const PlayedReadings& played, const std::string& name) {
    const auto found = played.readings.find(name);
    return found == played.readings.end() ? std::nullopt : found->second.value;
}

/// "reach_5lx_road_own" of "reach_5lx_road_own_left_edge_p05_m": the subject that trust rows are named by.
std::string subject_of(const std::string& name) {
    for (const char* lane : {"_own", "_all"})
        if (const std::size_t at = name.find(lane); at != std::string::npos)
            return name.substr(0, at + std::string(lane).size());
    return {};
}

/// A reading's name round its limit: "reach", 5, "road_own_m" of "reach_5lx_road_own_m".
struct LimitInName {
    std::string before, after;
    double limit_lx = 0.0;
};

std::optional<LimitInName> limit_in(const std::string& name) {
    const std::size_t end = name.find("lx_");
    const std::size_t begin = end == std::string::npos ? end : name.rfind('_', end);
    if (begin == std::string::npos)
        return std::nullopt;
    LimitInName parts{name.substr(0, begin + 1), name.substr(end)};
    const char *first = name.data() + begin + 1, *last = name.data() + end;
    const auto [rest, error] = std::from_chars(first, last, parts.limit_lx);
    return error == std::errc{} && rest == last && parts.limit_lx > 0.0 ? std::optional(parts) : std::nullopt;
}

/// The steeper of the slopes to the limits next to this one, over the logarithm of the limit.
std::optional<double> slope_over_limits(const PlayedReadings& played, const Reading& reading) {
    const auto own = limit_in(reading.name);
    if (!own || !reading.value)
        return std::nullopt;
    std::optional<double> below_lx, above_lx, below, above;
    for (const auto& [name, other] : played.readings) {
        const auto parts = name.starts_with(own->before) ? limit_in(name) : std::nullopt;
        if (!parts || parts->before != own->before || parts->after != own->after || !other.value)
            continue;
        if (parts->limit_lx < own->limit_lx && parts->limit_lx > below_lx.value_or(0.0)) {
            below_lx = parts->limit_lx;
            below = other.value;
        }
        if (parts->limit_lx > own->limit_lx && (!above_lx || parts->limit_lx < *above_lx)) {
            above_lx = parts->limit_lx;
            above = other.value;
        }
    }
    std::optional<double> slope;
    if (below)
        slope = std::abs(*below - *reading.value) / std::log(own->limit_lx / *below_lx);
    if (above)
        slope = std::max(slope.value_or(0.0), std::abs(*above - *reading.value) / std::log(*above_lx / own->limit_lx));
    return slope;
}

} // namespace

std::optional<double> moved_by_light(const PlayedReadings& played, const Reading& reading) {
    if (!reading.value)
        return std::nullopt;
    if (reading.name.find("_de_boer_") != std::string::npos)
        return 2.0 / std::log(10.0); // W = 5 - 2 lg E ...
    if (reading.unit == "lx" || reading.unit == "cd/m2" || reading.unit == "%")
        return std::abs(*reading.value); // illuminance, luminance and threshold increment go with the light
    const auto slope = slope_over_limits(played, reading);
    if (const auto tenth = value_of(played, subject_of(reading.name) + "_per_tenth_flux_m");
        tenth && reading.name.starts_with("reach_") && !subject_of(reading.name).empty())
        return std::max(slope.value_or(0.0), std::abs(*tenth) / 0.1);
    return slope;
}

} // namespace fernlicht
