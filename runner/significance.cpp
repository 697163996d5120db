#include "runner/significance.h"

#include "runner/moved_by_light.h"
#include "runner/summary.h"

#include <algorithm>

namespace fernlicht {
namespace {

std::optional<double> value_of(const PlayedReadings& cell, const std::string& name) {
    const auto found = cell.readings.find(name);
    return found == cell.readings.end() ? std::nullopt : found->second.value;
}

/// "reach_5lx_road_own" of "reach_5lx_road_own_left_edge_p05_m": the subject that trust rows are named by.
std::string subject_of(const std::string& name) {
    for (const char* lane : {"_own", "_all"})
        if (const std::size_t at = name.find(lane); at != std::string::npos)
            return name.substr(0, at + std::string(lane).size());
    return {};
}

/// Without its unit: "probe_kerb" of "probe_kerb_lx".
std::string without_unit(const Reading& reading) {
    const std::string end = "_" + name_part(reading.unit);
    return reading.name.ends_with(end) ? reading.name.substr(0, reading.name.size() - end.size()) : reading.name;
}

/// What calculation leaves open of one reading; nullopt when nothing tells. docs/studies.md explains each.
std::optional<double> uncertainty_of(const PlayedReadings& cell, const Reading& reading) {
    const std::string& name = reading.name;
    if (const auto stated = value_of(cell, without_unit(reading) + "_standard_error_" + name_part(reading.unit)))
        return stated;
    if (name.starts_with("reach_") || name.starts_with("unlit_before_reach_")) {
        const std::string subject = subject_of(name.starts_with("unlit_before_") ? name.substr(std::string("unlit_before_").size()) : name);
        const auto grid = value_of(cell, subject + "_grid_error_m"), twin = value_of(cell, subject + "_twin_difference_m");
        return grid && twin ? std::optional(*grid + *twin) : std::nullopt;
    }
    if (name.starts_with("area_")) {
        const auto grid = value_of(cell, subject_of(name) + "_grid_error_m2");
        return grid;
    }
    if (name.starts_with("width_"))
        return 2.0 * cell.grid_cell_m / 4.0; // either edge to a column of the grid
    if (name.starts_with("probe_"))
        if (const auto twin = value_of(cell, without_unit(reading) + "_twin_lx"); twin && reading.value)
            return std::abs(*twin - *reading.value);
    for (const char* stem :
         {"glare_", "sensor_", "mirror_"}) // from the tables in double precision; of lengths and times the moments' distance decides
        if (name.starts_with(stem) && reading.unit != "m" && reading.unit != "s" && reading.value)
            return 1e-6 * std::abs(*reading.value);
    return std::nullopt;
}

/// The spread between repeats on top of it, where they differ.
std::optional<double> with_repeats(const PlayedReadings& cell, const Reading& reading) {
    const std::optional<double> calculated = uncertainty_of(cell, reading);
    const auto spread = cell.by_repeats.find(reading.name);
    return spread == cell.by_repeats.end() ? calculated : std::hypot(calculated.value_or(0.0), spread->second);
}

std::optional<double> by_aim(const PlayedReadings& a, const PlayedReadings& b, const std::string& name) {
    if (!name.starts_with("reach_") || subject_of(name).empty())
        return std::nullopt;
    const std::string row = subject_of(name) + "_per_tenth_degree_m";
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
    if (!change.new_value || !change.old_value)
        return;
    if (!tested || !against) {
        if (change.delta() == 0.0) { // however exact, there is nothing to explain
            change.kind = ChangeKind::none;
            return;
        }
        change.why_not = "nothing tells how exact this reading is";
        return;
    }
    change.uncertainty = std::hypot(*tested, *against);
    const double size = std::abs(change.delta()), unsure = change.unsure();
    if (size > unsure && !change.by_noise) {
        change.why_not = "nothing tells how noise of the lamp tables moves this reading";
        return;
    }
    change.kind = size <= unsure                                                ? ChangeKind::none
                  : change.by_aim && size <= std::hypot(*change.by_aim, unsure) ? ChangeKind::within_aim
                                                                                : ChangeKind::real;
}

} // namespace

const char* change_name(ChangeKind kind) {
    static constexpr const char* names[] = {"real", "within aim", "no difference", "not known"};
    return names[static_cast<std::size_t>(kind)];
}

double ReadingChange::size() const {
    const double largest = std::max(std::abs(new_value.value_or(0.0)), std::abs(old_value.value_or(0.0)));
    return largest > 0.0 ? std::abs(delta()) / largest : 0.0;
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
    change.why_not = tested.value ? against.why_not : tested.why_not;
    change.by_aim = by_aim(now, before, name);
    change.by_noise = by_noise(now, before, name, lamp_noise);
    judge(change, with_repeats(now, tested), with_repeats(before, against));
    return change;
}

} // namespace fernlicht
