#include "metrics/readings/moved_by_light.h"

#include "metrics/readings/left_open.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>

namespace fernlicht {
namespace {

constexpr double rating_by_light = 2.0 / 2.302585092994046; // de Boer: W = 5 - 2 lg (E ...), after ln E

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
    if (!own || !reading.value.number())
        return std::nullopt;
    std::optional<double> below_lx, above_lx, below, above;
    for (const auto& [name, other] : played.readings) {
        const auto parts = name.starts_with(own->before) ? limit_in(name) : std::nullopt;
        if (!parts || parts->before != own->before || parts->after != own->after || !other.value.number())
            continue;
        if (parts->limit_lx < own->limit_lx && parts->limit_lx > below_lx.value_or(0.0)) {
            below_lx = parts->limit_lx;
            below = other.value.number();
        }
        if (parts->limit_lx > own->limit_lx && (!above_lx || parts->limit_lx < *above_lx)) {
            above_lx = parts->limit_lx;
            above = other.value.number();
        }
    }
    std::optional<double> slope;
    if (below)
        slope = std::abs(*below - *reading.value.number()) / std::log(own->limit_lx / *below_lx);
    if (above)
        slope = std::max(slope.value_or(0.0), std::abs(*above - *reading.value.number()) / std::log(*above_lx / own->limit_lx));
    return slope;
}

/// Times and lengths below a rating, over the ratings that have them: the steepest slope, by how the rating goes with the light.
std::optional<double> slope_over_ratings(const PlayedReadings& played, const Reading& reading) {
    const std::size_t begin = reading.name.find("_below_"), end = reading.name.find("_de_boer_");
    if (begin == std::string::npos || end == std::string::npos || begin >= end)
        return std::nullopt;
    const std::string before = reading.name.substr(0, begin + 7), after = reading.name.substr(end);
    std::map<double, double> by_rating;
    for (const auto& [name, other] : played.readings)
        if (double rating = 0.0; other.value.number() && name.starts_with(before) && name.ends_with(after)) {
            const char *first = name.data() + before.size(), *last = name.data() + name.size() - after.size();
            if (std::from_chars(first, last, rating).ptr == last)
                by_rating[rating] = *other.value.number();
        }
    std::optional<double> slope;
    for (auto above = by_rating.begin(); above != by_rating.end(); ++above)
        if (above != by_rating.begin()) {
            const auto below = std::prev(above);
            slope = std::max(slope.value_or(0.0), std::abs(above->second - below->second) / (above->first - below->first));
        }
    return slope ? std::optional(*slope * rating_by_light) : std::nullopt;
}

/// Detection: the level of a target goes with the light at most, so the distance moves no further than the steepest fall of the level over
/// the distance lets it.
std::optional<double> slope_over_distance(const PlayedReadings& played, const Reading& reading) {
    std::map<double, double> levels;
    std::string target = reading.name.substr(std::string("detection_").size()); // "card_own_p05_m"
    for (const char* end : {"_m", "_min", "_p05"})
        if (target.ends_with(end))
            target.resize(target.size() - std::string(end).size());
    const std::string begin = "visibility_level_" + target + "_at_";
    for (const auto& [name, other] : played.readings)
        if (double at_m = 0.0; other.value.number().value_or(0.0) > 0.0 && name.starts_with(begin)) {
            const char* first = name.data() + begin.size();
            if (std::from_chars(first, name.data() + name.size(), at_m).ec == std::errc{})
                levels[at_m] = *other.value.number();
        }
    std::optional<double> slope;
    for (auto far = levels.begin(); far != levels.end(); ++far)
        if (far != levels.begin() && reading.value.number()) {
            const auto near = std::prev(far);
            const double fall = std::abs(std::log(far->second / near->second));
            if (fall > 0.0)
                slope = std::max(slope.value_or(0.0), (far->first - near->first) / fall);
        }
    return slope;
}

} // namespace

std::optional<double> moved_by_light(const PlayedReadings& played, const Reading& reading) {
    if (!reading.value.number())
        return std::nullopt;
    const std::string& name = reading.name;
    if (name.ends_with("_de_boer_min"))
        return rating_by_light;
    if (name.find("_de_boer_") != std::string::npos)
        return slope_over_ratings(played, reading);
    if (name.starts_with("detection_"))
        return slope_over_distance(played, reading);
    if (name.starts_with("foreground_ratio_"))
        return 2.0 * std::abs(*reading.value.number()); // one range up, the other down
    if (reading.unit == "lx" || reading.unit == "cd/m2" || reading.unit == "%")
        return std::abs(*reading.value.number()); // illuminance, luminance and threshold increment go with the light
    const auto slope = slope_over_limits(played, reading);
    if (const auto tenth = value_of(played, extent_subject(reading.name) + "_per_tenth_flux_m");
        tenth && name.starts_with("reach_") && !extent_subject(reading.name).empty())
        return std::max(slope.value_or(0.0), std::abs(*tenth) / 0.1);
    return slope;
}

} // namespace fernlicht
