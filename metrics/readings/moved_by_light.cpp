#include "metrics/readings/moved_by_light.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace fernlicht {
namespace {

constexpr double rating_by_light = 2.0 / 2.302585092994046; // de Boer: W = 5 - 2 lg (E ...), after ln E

/// The steeper of the slopes to the thresholds next to this one, over the logarithm of the light.
std::optional<double> slope_over_limits(const PlayedReadings& played, const Reading& reading) {
    ReadingKey key = reading.key;
    const double own_lx = key.threshold.value;
    std::map<double, double> by_lx;
    for (const auto& [other, found] : played.readings) {
        key.threshold.value = other.threshold.value;
        if (key == other && found.value.number() && other.threshold.value > 0.0)
            by_lx[other.threshold.value] = *found.value.number();
    }
    std::optional<double> slope;
    const auto own = by_lx.find(own_lx);
    if (own == by_lx.end())
        return slope;
    if (own != by_lx.begin())
        slope = std::abs(std::prev(own)->second - own->second) / std::log(own_lx / std::prev(own)->first);
    if (const auto above = std::next(own); above != by_lx.end())
        slope = std::max(slope.value_or(0.0), std::abs(above->second - own->second) / std::log(above->first / own_lx));
    return slope;
}

/// Times and lengths below a rating, over the ratings that have them: the steepest slope, by how the rating goes with the light.
std::optional<double> slope_over_ratings(const PlayedReadings& played, const Reading& reading) {
    ReadingKey key = reading.key;
    std::map<double, double> by_rating;
    for (const auto& [other, found] : played.readings) {
        key.threshold.value = other.threshold.value;
        if (key == other && found.value.number())
            by_rating[other.threshold.value] = *found.value.number();
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
    const ReadingKey& key = reading.key;
    std::map<double, double> levels;
    for (const auto& [other, found] : played.readings)
        if (other.quantity == Quantity::visibility_level && other.subject == key.subject && other.lane == key.lane &&
            other.place == key.place && other.aspect == Aspect::value && found.value.number().value_or(0.0) > 0.0)
            levels[*other.distance_m] = *found.value.number();
    std::optional<double> slope;
    for (auto far = levels.begin(); far != levels.end(); ++far)
        if (far != levels.begin()) {
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
    const double size = std::abs(*reading.value.number());
    switch (row_of(reading.key.quantity).with_light) {
    case WithLight::proportional:
        return size;
    case WithLight::twice:
        return 2.0 * size;
    case WithLight::like_de_boer:
        return rating_by_light;
    case WithLight::over_distance:
        return slope_over_distance(played, reading);
    case WithLight::over_thresholds:
        break;
    case WithLight::unknown:
        return std::nullopt;
    }
    if (reading.key.threshold.unit == ThresholdUnit::percent)
        return std::nullopt;
    if (reading.key.threshold.unit == ThresholdUnit::de_boer)
        return slope_over_ratings(played, reading);
    const auto slope = slope_over_limits(played, reading);
    const auto tenth = reading.key.quantity == Quantity::reach
                           ? value_of(played, about_lane(Quantity::reach, reading.key, Aspect::per_tenth_flux))
                           : std::nullopt;
    return tenth ? std::optional(std::max(slope.value_or(0.0), std::abs(*tenth) / 0.1)) : slope;
}

} // namespace fernlicht
