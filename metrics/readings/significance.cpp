#include "metrics/readings/significance.h"

#include "metrics/readings/left_open.h"
#include "metrics/readings/moved_by_light.h"

#include <algorithm>

namespace fernlicht {
namespace {

/// The spread between repeats on top of what calculation leaves open, where they differ.
std::optional<double> with_repeats(const PlayedReadings& cell, const Reading& reading) {
    std::optional<double> calculated = left_open(cell, reading);
    if (!calculated && reading.value.censored()) // as a bound it is exact
        calculated = 0.0;
    const auto spread = cell.by_repeats.find(reading.key);
    return spread == cell.by_repeats.end() ? calculated : std::hypot(calculated.value_or(0.0), spread->second);
}

std::optional<double> by_aim(const PlayedReadings& a, const PlayedReadings& b, const ReadingKey& key) {
    const ReadingKey row = about_lane(Quantity::reach, key, Aspect::per_tenth_degree);
    const auto first = value_of(a, row), second = value_of(b, row);
    if (key.quantity != Quantity::reach || (!first && !second))
        return std::nullopt;
    return std::max(std::abs(first.value_or(0.0)), std::abs(second.value_or(0.0)));
}

std::optional<double> by_noise(const PlayedReadings& a, const PlayedReadings& b, const ReadingKey& key, double lamp_noise) {
    if (lamp_noise == 0.0)
        return 0.0;
    const auto now = moved_by_light(a, a.readings.at(key)), before = moved_by_light(b, b.readings.at(key));
    if (!now && !before)
        return std::nullopt;
    return noise_deviations * lamp_noise * std::max(now.value_or(0.0), before.value_or(0.0));
}

void judge(ReadingChange& change, const std::optional<double>& tested, const std::optional<double>& against) {
    const Value found = change.change();
    if (!found.measured()) {
        change.why_not = found.reason();
        return;
    }
    if (!tested || !against) {
        if (found.number() == 0.0) { // however exact, there is nothing to explain
            change.kind = ChangeKind::none;
            return;
        }
        change.why_not = "nothing tells how exact this reading is";
        return;
    }
    change.uncertainty = std::hypot(*tested, *against);
    const double size = change.least(), unsure = change.unsure();
    if (size > unsure && !change.by_noise) {
        change.why_not = "nothing tells how noise of the lamp tables moves this reading";
        return;
    }
    change.kind = size <= unsure                                                ? ChangeKind::none
                  : change.by_aim && size <= std::hypot(*change.by_aim, unsure) ? ChangeKind::within_aim
                                                                                : ChangeKind::real;
    if (found.censored() && change.kind != ChangeKind::real) { // it may be much more
        change.kind = ChangeKind::unknown;
        change.why_not = "one of both lies beyond what was looked at";
    }
}

} // namespace

std::optional<double> value_of(const PlayedReadings& played, const ReadingKey& key) {
    const auto found = played.readings.find(key);
    return found == played.readings.end() ? std::nullopt : found->second.value.number();
}

ReadingKey about_lane(Quantity quantity, const ReadingKey& key, Aspect aspect) {
    return {.quantity = quantity,
            .surface = key.surface,
            .lane = key.lane,
            .threshold = key.threshold,
            .aspect = aspect,
            .statistic = Statistic::median};
}

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

ReadingChange change_of_reading(const ReadingKey& key, const PlayedReadings& now, const PlayedReadings& before, double lamp_noise) {
    const Reading &tested = now.readings.at(key), &against = before.readings.at(key);
    ReadingChange change{.reading = key,
                         .new_value = tested.value,
                         .old_value = against.value,
                         .by_aim = by_aim(now, before, key),
                         .by_noise = by_noise(now, before, key, lamp_noise)};
    judge(change, with_repeats(now, tested), with_repeats(before, against));
    return change;
}

} // namespace fernlicht
