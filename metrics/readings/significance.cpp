#include "metrics/readings/significance.h"

#include <algorithm>
#include <fmt/format.h>
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
    if (!reading.value.measured() || is_of_cars(reading.key)) // of drawn cars: chance, too, which nothing here tells
        return std::nullopt;
    if (ReadingKey key = reading.key; key.aspect == Aspect::value) {
        key.aspect = Aspect::standard_error;
        if (const auto stated = value_of(played, key))
            return stated;
    }
    switch (row_of(reading.key.quantity).exactness) {
    case Exactness::double_precision:
        return double_precision * std::abs(*reading.value.figure()) + reading.between_moments.value_or(0.0);
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

/// What 100 % more light would move a reading by, going on as it begins: its derivative after the logarithm of the light. Illuminance and
/// luminance go with the light; what ends where a limit is reached has its sensitivity to flux. nullopt when nothing tells.
std::optional<double> light_sensitivity(const Reading& reading) {
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
    case WithLight::as_nudged:
        if (const auto tenth = by_flux(reading.sensitivity))
            return *tenth / 0.1;
        return std::nullopt;
    case WithLight::unknown:
        break;
    }
    return std::nullopt;
}

/// The spread between repeats on top of what calculation leaves open, where they differ.
std::optional<double> with_repeats(const ReadingsOfCell& cell, const Reading& reading) {
    std::optional<double> calculated = numerical_uncertainty(cell, reading);
    if (!calculated && reading.value.censored()) // as a bound it is exact
        calculated = 0.0;
    const auto spread = cell.by_repeats.find(reading.key);
    return spread == cell.by_repeats.end() ? calculated : std::hypot(calculated.value_or(0.0), spread->second);
}

std::optional<double> noise_effect(const Reading& a, const Reading& b, double lamp_noise) {
    if (lamp_noise == 0.0)
        return 0.0;
    const auto by_light = larger(light_sensitivity(a), light_sensitivity(b));
    return by_light ? std::optional(noise_deviations * lamp_noise * *by_light) : std::nullopt;
}

/// The key that looks farther, of what lies beyond.
std::string beyond(const ReadingKey& key) {
    const char* const which = key.quantity == Quantity::reach ? "ahead_m" : key.quantity == Quantity::width ? "beside_m" : "";
    return *which == '\0'
               ? ""
               : fmt::format(" (a larger `measure.extent.{}` of the drives looks farther; in a study it is one of `axes:`)", which);
}

/// `of_moments`: what both would leave open were there a moment everywhere.
void judge(ReadingChange& change, const std::optional<double>& tested, const std::optional<double>& against, double of_moments) {
    const Value found = change.change();
    if (!found.measured()) {
        change.reason_unknown = found.reason() + (change.new_value.censored() && change.old_value.censored() ? beyond(change.reading) : "");
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
    // Aim and what is not known of either are bounds: they add as such.
    const auto unknown_because = [&](const char* reason) { change.reason_unknown = reason; };
    if (size <= unsure && size > std::hypot(of_moments, change.noise_effect.value_or(0.0)))
        return unknown_because("too few moments were played to tell: a higher `rate_hz` or longer `--frames` plays more");
    if (size <= unsure)
        change.kind = ChangeKind::none;
    else if (!change.aim_effect)
        return unknown_because("nothing tells what 0.1 degrees of aim would do to this reading");
    else if (size <= *change.aim_effect + unsure)
        change.kind = ChangeKind::within_aim;
    else if (!change.noise_effect)
        return unknown_because("nothing tells how noise of the lamp tables moves this reading");
    else
        change.kind = ChangeKind::real;
    if (found.censored() && change.kind != ChangeKind::real) { // it may be much more
        change.kind = ChangeKind::unknown;
        change.reason_unknown = "one of both lies beyond what was looked at" + beyond(change.reading);
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
                         .aim_effect = larger(by_aim(tested.sensitivity), by_aim(against.sensitivity)),
                         .flux_effect = larger(by_flux(tested.sensitivity), by_flux(against.sensitivity)),
                         .height_effect = larger(by_height(tested.sensitivity), by_height(against.sensitivity)),
                         .load_effect = larger(by_load(tested.sensitivity), by_load(against.sensitivity)),
                         .noise_effect = noise_effect(tested, against, lamp_noise)};
    const auto everywhere = [](const ReadingsOfCell& cell, Reading reading) {
        reading.between_moments.reset();
        return with_repeats(cell, reading).value_or(0.0);
    };
    judge(change, with_repeats(now, tested), with_repeats(before, against),
          std::hypot(everywhere(now, tested), everywhere(before, against)));
    return change;
}

} // namespace fernlicht
