#include "metrics/readings/significance.h"

#include "metrics/readings/left_open.h"
#include "metrics/readings/moved_by_light.h"

#include <algorithm>

namespace fernlicht {
namespace {

/// The spread between repeats on top of what calculation leaves open, where they differ.
std::optional<double> with_repeats(const PlayedReadings& cell, const Reading& reading) {
    const std::optional<double> calculated = left_open(cell, reading);
    const auto spread = cell.by_repeats.find(reading.name);
    return spread == cell.by_repeats.end() ? calculated : std::hypot(calculated.value_or(0.0), spread->second);
}

std::optional<double> by_aim(const PlayedReadings& a, const PlayedReadings& b, const std::string& name) {
    if (!name.starts_with("reach_") || extent_subject(name).empty())
        return std::nullopt;
    const std::string row = extent_subject(name) + "_per_tenth_degree_m";
    const auto first = value_of(a, row), second = value_of(b, row);
    if (!first && !second)
        return std::nullopt;
    return std::max(std::abs(first.value_or(0.0)), std::abs(second.value_or(0.0)));
}

std::optional<double> by_noise(const PlayedReadings& a, const PlayedReadings& b, const std::string& name, double lamp_noise) {
    if (lamp_noise == 0.0)
        return 0.0;
    const auto now = moved_by_light(a, a.readings.at(name)), before = moved_by_light(b, b.readings.at(name));
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

std::optional<double> value_of(const PlayedReadings& played, const std::string& name) {
    const auto found = played.readings.find(name);
    return found == played.readings.end() ? std::nullopt : found->second.value.number();
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

bool says_how_exact(const std::string& name) {
    for (const char* part : {"_twin_difference", "_grid_error", "_per_tenth_", "_standard_error"})
        if (name.find(part) != std::string::npos)
            return true;
    return name.find("_twin_") != std::string::npos;
}

ReadingChange change_of_reading(const std::string& name, const PlayedReadings& now, const PlayedReadings& before, double lamp_noise) {
    const Reading &tested = now.readings.at(name), &against = before.readings.at(name);
    ReadingChange change;
    change.reading = name;
    change.unit = tested.unit;
    change.new_value = tested.value;
    change.old_value = against.value;
    change.by_aim = by_aim(now, before, name);
    change.by_noise = by_noise(now, before, name, lamp_noise);
    judge(change, with_repeats(now, tested), with_repeats(before, against));
    return change;
}

} // namespace fernlicht
