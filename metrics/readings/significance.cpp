#include "metrics/readings/significance.h"

#include <algorithm>
#include <iterator>

namespace fernlicht {
namespace {

/// Calculated from the lamps' tables in double precision, on places and by definitions that leave no choice.
constexpr double double_precision = 1e-6;
/// The own lane's grid of evenness (docs/seeing.md): patches begin and end at its points.
constexpr double evenness_step_m = 0.5;

/// Of a reading; nullopt where it is missing or no number.
std::optional<double> value_of(const ReadingsOfCell& played, const ReadingKey& key) {
    const auto found = played.readings.find(key);
    return found == played.readings.end() ? std::nullopt : found->second.value.number();
}

/// What is told of all readings of the key's surface, lane and threshold: the median at its place, where either edge stands for both, else
/// on the lane's centre.
std::optional<double> about_lane(const ReadingsOfCell& played, Quantity quantity, const ReadingKey& key, Aspect aspect) {
    ReadingKey row{.quantity = quantity,
                   .surface = key.surface,
                   .lane = key.lane,
                   .threshold = key.threshold,
                   .place = key.place == ReadingPlace::none ? ReadingPlace::none : ReadingPlace::edges,
                   .aspect = aspect,
                   .statistic = Statistic::median};
    const auto there = value_of(played, row);
    row.place = ReadingPlace::none;
    return there ? there : value_of(played, row);
}

std::optional<double> positive(double step) { return step > 0.0 ? std::optional(step) : std::nullopt; }

/// The grid's error on that line and the distance between drawing and double precision.
std::optional<double> of_grid_and_drawing(const ReadingsOfCell& played, const ReadingKey& key) {
    auto grid = about_lane(played, key.quantity, key, Aspect::grid_error);
    grid = grid ? grid : about_lane(played, Quantity::reach, key, Aspect::grid_error);
    const auto twin = about_lane(played, Quantity::reach, key, Aspect::twin_difference);
    return grid && twin ? std::optional(*grid + *twin) : std::nullopt;
}

std::optional<double> of_drawing(const ReadingsOfCell& played, const Reading& reading) {
    ReadingKey key = reading.key;
    key.aspect = Aspect::twin;
    const auto twin = reading.key.aspect == Aspect::value && key.statistic == Statistic::median ? value_of(played, key) : std::nullopt;
    return twin ? std::optional(std::abs(*twin - *reading.value.figure())) : std::nullopt;
}

/// To either side, in the reading's unit; nullopt when nothing tells.
std::optional<double> numerical_uncertainty(const ReadingsOfCell& played, const Reading& reading) {
    if (!reading.value.measured())
        return std::nullopt;
    if (ReadingKey key = reading.key; key.aspect == Aspect::value) {
        key.aspect = Aspect::standard_error;
        if (const auto stated = value_of(played, key))
            return stated;
    }
    switch (row_of(reading.key.quantity).exactness) {
    case Exactness::double_precision:
        return double_precision * std::abs(*reading.value.figure());
    case Exactness::grid_and_drawing:
        return of_grid_and_drawing(played, reading.key);
    case Exactness::grid:
        return about_lane(played, reading.key.quantity, reading.key, Aspect::grid_error);
    case Exactness::grid_columns:
        return 2.0 * played.grid_cell_m / 4.0; // across a column is a quarter of a row
    case Exactness::drawing:
        return of_drawing(played, reading);
    case Exactness::between_moments:
        return positive(reading.key.quantity == Quantity::glare_time ? played.step_s : played.step_m);
    case Exactness::look_step:
        return positive(played.look_step_m);
    case Exactness::look_step_twice:
        return positive(2.0 * played.look_step_m);
    case Exactness::evenness_step_twice:
        return 2.0 * evenness_step_m;
    case Exactness::unknown:
        break;
    }
    return std::nullopt;
}

/// How far noise of the tables is followed: three standard deviations of one intensity. Light on the road is interpolated from several
/// intensities of two lamps, whose noise averages; what deviates evenly within +-a never goes beyond 1.73 of them.
constexpr double noise_deviations = 3.0;

constexpr double rating_by_light = 2.0 / 2.302585092994046; // de Boer: W = 5 - 2 lg (E ...), after ln E

/// The same figure at all thresholds that have it, by their values.
std::map<double, double> over_thresholds(const ReadingsOfCell& played, ReadingKey key) {
    std::map<double, double> by_threshold;
    for (const auto& [other, found] : played.readings) {
        key.threshold.value = other.threshold.value;
        if (key == other && found.value.number())
            by_threshold[other.threshold.value] = *found.value.number();
    }
    return by_threshold;
}

/// The steeper of the slopes to the thresholds next to this one, over the logarithm of the light.
std::optional<double> slope_over_limits(const ReadingsOfCell& played, const Reading& reading) {
    const double own_lx = reading.key.threshold.value;
    std::map<double, double> by_lx = over_thresholds(played, reading.key);
    std::erase_if(by_lx, [](const auto& at) { return !(at.first > 0.0); });
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
std::optional<double> slope_over_ratings(const ReadingsOfCell& played, const Reading& reading) {
    const std::map<double, double> by_rating = over_thresholds(played, reading.key);
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
std::optional<double> slope_over_distance(const ReadingsOfCell& played, const Reading& reading) {
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

/// What 100 % more light would move a reading by, going on as it begins: its derivative after the logarithm of the light. Illuminance and
/// luminance go with the light; reach has its sensitivity to flux; other extents take the steeper slope to the same extent at the next
/// limits, for twice the light reaches twice the limit. nullopt when nothing tells.
std::optional<double> light_sensitivity(const ReadingsOfCell& played, const Reading& reading) {
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
    const auto tenth =
        reading.key.quantity == Quantity::reach ? about_lane(played, Quantity::reach, reading.key, Aspect::per_tenth_flux) : std::nullopt;
    return tenth ? std::optional(std::max(slope.value_or(0.0), std::abs(*tenth) / 0.1)) : slope;
}

/// The spread between repeats on top of what calculation leaves open, where they differ.
std::optional<double> with_repeats(const ReadingsOfCell& cell, const Reading& reading) {
    std::optional<double> calculated = numerical_uncertainty(cell, reading);
    if (!calculated && reading.value.censored()) // as a bound it is exact
        calculated = 0.0;
    const auto spread = cell.by_repeats.find(reading.key);
    return spread == cell.by_repeats.end() ? calculated : std::hypot(calculated.value_or(0.0), spread->second);
}

std::optional<double> aim_effect(const ReadingsOfCell& a, const ReadingsOfCell& b, const ReadingKey& key) {
    const auto first = about_lane(a, Quantity::reach, key, Aspect::per_tenth_degree),
               second = about_lane(b, Quantity::reach, key, Aspect::per_tenth_degree);
    if (key.quantity != Quantity::reach || (!first && !second))
        return std::nullopt;
    return std::max(std::abs(first.value_or(0.0)), std::abs(second.value_or(0.0)));
}

std::optional<double> noise_effect(const ReadingsOfCell& a, const ReadingsOfCell& b, const ReadingKey& key, double lamp_noise) {
    if (lamp_noise == 0.0)
        return 0.0;
    const auto now = light_sensitivity(a, a.readings.at(key)), before = light_sensitivity(b, b.readings.at(key));
    if (!now && !before)
        return std::nullopt;
    return noise_deviations * lamp_noise * std::max(now.value_or(0.0), before.value_or(0.0));
}

void judge(ReadingChange& change, const std::optional<double>& tested, const std::optional<double>& against) {
    const Value found = change.change();
    if (!found.measured()) {
        change.reason_unknown = found.reason();
        return;
    }
    if (!tested || !against) {
        if (found.number() == 0.0) { // however exact, there is nothing to explain
            change.kind = ChangeKind::none;
            return;
        }
        change.reason_unknown = "nothing tells how exact this reading is";
        return;
    }
    change.uncertainty = std::hypot(*tested, *against);
    const double size = change.least(), unsure = change.total_uncertainty();
    if (size > unsure && !change.noise_effect) {
        change.reason_unknown = "nothing tells how noise of the lamp tables moves this reading";
        return;
    }
    change.kind = size <= unsure                                                        ? ChangeKind::none
                  : change.aim_effect && size <= std::hypot(*change.aim_effect, unsure) ? ChangeKind::within_aim
                                                                                        : ChangeKind::real;
    if (found.censored() && change.kind != ChangeKind::real) { // it may be much more
        change.kind = ChangeKind::unknown;
        change.reason_unknown = "one of both lies beyond what was looked at";
    }
}

} // namespace

const char* change_name(ChangeKind kind) {
    static constexpr const char* names[] = {"real", "within aim", "no difference", "not known"};
    return names[static_cast<std::size_t>(kind)];
}

double ReadingChange::least() const {
    const Value found = change();
    return found.number() ? std::abs(*found.number()) : found.censored() ? std::max({0.0, found.low(), -found.high()}) : 0.0;
}

std::optional<double> ReadingChange::relative() const {
    const auto now = new_value.number(), before = old_value.number();
    return now && before && *before != 0.0 ? std::optional((*now - *before) / std::abs(*before)) : std::nullopt;
}

double ReadingChange::size() const {
    const double largest = std::max(std::abs(new_value.figure().value_or(0.0)), std::abs(old_value.figure().value_or(0.0)));
    return largest > 0.0 ? least() / largest : 0.0;
}

ReadingChange change_of_reading(const ReadingKey& key, const ReadingsOfCell& now, const ReadingsOfCell& before, double lamp_noise) {
    const Reading &tested = now.readings.at(key), &against = before.readings.at(key);
    ReadingChange change{.reading = key,
                         .new_value = tested.value,
                         .old_value = against.value,
                         .aim_effect = aim_effect(now, before, key),
                         .noise_effect = noise_effect(now, before, key, lamp_noise)};
    judge(change, with_repeats(now, tested), with_repeats(before, against));
    return change;
}

} // namespace fernlicht
