#include "runner/experiments/study/study_result.h"

#include "metrics/readings/reading_labels.h"
#include "runner/experiments/run/run_report.h"
#include "runner/findings/run_context.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <ranges>
#include <set>
#include <string_view>
#include <tuple>

namespace fernlicht {
namespace {

/// Of one intensity's difference between two lamps, relative: the larger of both sides.
double noise_between(const StudyResult& result, const std::string& tested, const std::string& against) {
    double noise = 0.0;
    for (const LampComparison& lamps : result.lamps)
        if (lamps.tested == tested && lamps.against == against)
            noise = std::max(noise, lamps.difference.noise_relative);
    return noise;
}

/// Hands over all changes, two cells' readings at a time in memory.
void compute_changes(const StudyResult& result, const std::function<void(Change)>& take) {
    std::size_t number = 0;
    for (const StudyComparison& comparison : result.study.comparisons) {
        const double noise = noise_between(result, comparison.tested, comparison.against);
        for (const auto& [tested, against] : result.pairs_of(comparison)) {
            const ReadingsOfCell now = all_readings(result, result.cells[tested]), before = all_readings(result, result.cells[against]);
            for (const auto& [key, reading] : now.readings)
                if (!is_uncertainty(key) && !is_time(key) && before.readings.contains(key))
                    take({change_of_reading(key, now, before, noise), fmt::format("c{}", number++), tested, against,
                          place_among(key, result.study.decide).has_value()});
        }
    }
}

/// Of each deciding reading its largest real change, and of these the three largest.
void rank(StudyResult& result) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < result.changes.size(); ++i)
        if (result.changes[i].kind == ChangeKind::real && result.changes[i].decides)
            order.push_back(i);
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return result.changes[i].size(); });
    std::set<ReadingKey> shown;
    for (const std::size_t i : order)
        if (result.largest.size() < 3 && shown.insert(result.changes[i].reading).second)
            result.largest.push_back(i);
}

Verdict verdict_on(const std::string& name, const Value& value, const std::string& unit, const std::optional<double>& least,
                   const std::optional<double>& most, const std::string& rerun) {
    if (!value.measured())
        return {VerdictKind::not_measured, name, value.reason(), rerun};
    std::string limits = least ? fmt::format("at least {:g}{}", *least, unit_suffix(unit)) : "";
    if (most)
        limits += fmt::format("{}at most {:g}{}", limits.empty() ? "" : ", ", *most, unit_suffix(unit));
    const std::optional<bool> kept = holds(value, least, most);
    return {!kept   ? VerdictKind::not_measured
            : *kept ? VerdictKind::pass
                    : VerdictKind::fail,
            name, fmt::format("{}{}, limit {}", with_bound(value, fmt::format("{:.4g}", *value.figure())), unit_suffix(unit), limits),
            rerun};
}

std::string no_such_reading(const std::string& name, const std::set<ReadingKey>& keys) {
    std::vector<std::string> names;
    for (const ReadingKey& key : keys)
        names.push_back(name_of(key));
    std::ranges::sort(names);
    const std::string nearest = nearest_name(name, names);
    return "there is no reading of this name" + (nearest.empty() ? "" : "; the nearest name is " + nearest);
}

/// What a drive is to measure for readings whose names begin so; "" where it is no affair of `measure:`.
std::string asked_for_by(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, const char*>, 19> rows{{
        {"glare_", "glare"},           {"mirror_", "glare"},          {"sensor_", "sensors"},
        {"detection_", "visibility"},  {"undetected_", "visibility"}, {"visibility_", "visibility"},
        {"background_", "visibility"}, {"mesopic_", "visibility"},    {"uniformity_", "homogeneity"},
        {"gradient_", "homogeneity"},  {"patch_", "homogeneity"},     {"foreground_", "homogeneity"},
        {"kerb_", "places"},           {"board_", "places"},          {"marking_", "places"},
        {"reach_", "extent"},          {"unlit_", "extent"},          {"width_", "extent"},
        {"area_", "extent"},
    }};
    const auto found = std::ranges::find_if(rows, [&](const auto& row) { return name.starts_with(row.first); });
    return found == rows.end() ? "" : found->second;
}

/// Where no cell has any reading that its beginning asks for: "; ask for `glare` in `measure:`".
std::string how_to_ask(const std::string& name, const std::set<ReadingKey>& keys) {
    const std::string measure = asked_for_by(name);
    const auto is_asked = [&](const ReadingKey& key) { return asked_for_by(name_of(key)) == measure; };
    return measure.empty() || std::ranges::any_of(keys, is_asked)
               ? ""
               : fmt::format(", as no drive measures {0}: ask for `{0}` in `measure:`", measure);
}

bool is_in(const std::set<ReadingKey>& keys, const std::optional<ReadingKey>& key) { return key && keys.contains(*key); }

/// The first cell's reason where no cell has a value of what fits; "" where one has.
template <class Fits> std::string why_unmeasured(const StudyResult& result, Fits fits) {
    std::string why;
    for (const CellResult& cell : result.cells)
        for (const auto& [key, reading] : cell.readings)
            if (fits(key)) {
                if (reading.value.measured())
                    return "";
                if (why.empty())
                    why = reading.value.reason();
            }
    return why;
}

/// A reading that the study names and that nothing has decides nothing, and must not look as if it had not changed. Of the usual ones a
/// drive need not have all.
void judge_deciding(StudyResult& result) {
    const std::set<ReadingKey>& keys = result.keys;
    if (result.study.decide == decides_by_default() || keys.empty()) // cells that were not played say so themselves
        return;
    for (const std::string& name : result.study.decide) {
        const auto missing = [&](const std::string& why) {
            result.verdicts.push_back({VerdictKind::not_measured, "deciding reading " + name, why, repeat_command(result.call)});
        };
        const auto fits = [&](const ReadingKey& key) { return place_among(key, {name}).has_value(); };
        if (std::ranges::none_of(keys, fits))
            missing((name.find_first_of("*?") == std::string::npos ? no_such_reading(name, keys) : "no reading's name fits") +
                    how_to_ask(name, keys));
        else if (const std::string why = why_unmeasured(result, fits); !why.empty())
            missing("no cell measured it: " + why);
        else if (result.changes.size() + result.changes_elsewhere > 0 &&
                 std::ranges::none_of(result.changes, fits, &ReadingChange::reading))
            missing("no two cells were compared by it: it is a time, says how exact another is, or one lamp alone has it");
    }
}

void judge_values(StudyResult& result, const StudyLimit& limit) {
    const auto key = key_of(limit.reading);
    for (const CellResult& cell : result.cells) {
        if (!limit.lamp.empty() && result.study.lamps[cell.cell.lamp].name != limit.lamp)
            continue;
        const auto found = key ? cell.readings.find(*key) : cell.readings.end();
        const bool known = found != cell.readings.end();
        const Value value = known ? found->second.value
                                  : Value::not_measured(cell.failed.empty() ? no_such_reading(limit.reading, result.keys)
                                                                            : "the cell was not played: " + cell.failed);
        result.verdicts.push_back(verdict_on(cell.cell.name + ": " + limit.reading, value, known ? unit_of(*key) : "", limit.at_least,
                                             limit.at_most, repeat_command(result.call, {"--only", cell.cell.name})));
    }
}

void judge_changes(StudyResult& result, const StudyLimit& limit) {
    const auto key = key_of(limit.reading);
    bool found = false;
    for (const Change& change : result.changes) {
        if (change.reading != key)
            continue;
        found = true;
        const CellResult& cell = result.cells[change.tested];
        result.verdicts.push_back(verdict_on(
            cell.cell.name + ": change of " + limit.reading, change.change(), change.unit(), limit.change_at_least, limit.change_at_most,
            repeat_command(result.call, {"--only", cell.cell.name + "," + result.cells[change.against].cell.name})));
    }
    const std::set<ReadingKey>& keys = result.keys;
    if (!found)
        result.verdicts.push_back(
            {VerdictKind::not_measured, "change of " + limit.reading,
             keys.empty() || is_in(keys, key) ? "no comparison has this reading" : no_such_reading(limit.reading, keys),
             repeat_command(result.call)});
}

std::string hash_of_readings(const CellResult& cell) {
    if (!cell.has_all_readings)
        return cell.hash_of_readings;
    std::string text;
    for (const auto& [key, reading] : cell.readings)
        if (!is_time(key))
            text += fmt::format("{} {} {}\n", name_of(key), static_cast<int>(reading.value.kind()), reading.value.figure().value_or(0.0));
    return content_hash(text.data(), text.size());
}

/// "9", or "9 to 30" where cells differ.
std::string range_over(const std::vector<CellResult>& cells, int CellResult::*count) {
    const auto [least, most] = std::ranges::minmax_element(cells, {}, count);
    return (*least).*count == (*most).*count ? fmt::format("{}", (*most).*count) : fmt::format("{} to {}", (*least).*count, (*most).*count);
}

std::string played_in_part(const StudyResult& result) {
    std::vector<std::string> parts;
    if (const std::size_t all = cells_of(result.study).size(); result.cells.size() < all)
        parts.push_back(fmt::format("Only {} of {} cells {} asked for (--only {})", result.cells.size(), all,
                                    result.cells.size() == 1 ? "was" : "were", result.only));
    if (std::ranges::any_of(result.cells, [](const CellResult& cell) { return cell.moments < cell.moments_of_drive; }))
        parts.push_back(fmt::format("{} of {} moments of each drive were played (--frames {})",
                                    range_over(result.cells, &CellResult::moments), range_over(result.cells, &CellResult::moments_of_drive),
                                    result.frames));
    return fmt::format("{}", fmt::join(parts, "; "));
}

} // namespace

bool is_same_place(const StudyCell& a, const StudyCell& b) {
    return a.drive == b.drive && a.technique == b.technique && a.time_of_day == b.time_of_day && a.aim == b.aim && a.voltage == b.voltage &&
           a.mirror == b.mirror && a.point == b.point;
}

std::vector<std::pair<std::size_t, std::size_t>> StudyResult::pairs_of(const StudyComparison& comparison) const {
    const auto place = [&](std::size_t i) {
        const StudyCell& c = cells[i].cell;
        return std::tuple(c.drive, c.technique, c.time_of_day, c.aim, c.voltage, c.mirror, c.point);
    };
    std::multimap<decltype(place(0)), std::size_t> against; // in the order of cells where a place has several
    for (std::size_t k = 0; k < cells.size(); ++k)
        if (lamp_of(k) == comparison.against)
            against.emplace(place(k), k);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (lamp_of(i) == comparison.tested)
            for (auto [found, end] = against.equal_range(place(i)); found != end; ++found)
                pairs.emplace_back(i, found->second);
    return pairs;
}

ReadingsOfCell all_readings(const StudyResult& result, const CellResult& cell) {
    if (cell.has_all_readings || !result.tells_all)
        return cell;
    ReadingsOfCell all = whole_drive_readings(read_report(result.folder / "cells" / cell.cell.name).played.front());
    static_cast<Steps&>(all) = cell;
    return all;
}

void each_change(const StudyResult& result, const std::function<void(const Change&)>& take) {
    if (result.changes_elsewhere > 0)
        compute_changes(result, take);
    else
        std::ranges::for_each(result.changes, take);
}

void keep_told_readings(StudyResult& result, CellResult& cell) {
    std::ranges::copy(std::views::keys(cell.readings), std::inserter(result.keys, result.keys.end()));
    cell.hash_of_readings = hash_of_readings(cell);
    const auto is_told = [&](const ReadingKey& key) {
        return place_among(key, result.study.decide) ||
               std::ranges::any_of(result.study.limits, [&](const StudyLimit& limit) { return limit.reading == name_of(key); });
    };
    const auto what_of = [](const ReadingKey& key) { return std::tuple(key.quantity, key.subject, key.surface, key.lane, key.threshold); };
    std::set<decltype(what_of(ReadingKey()))> told;
    for (const ReadingKey& key : std::views::keys(cell.readings))
        if (!result.tells_all && is_told(key)) // else changes are computed out of the reports
            told.insert(what_of(key));
    cell.has_all_readings = std::erase_if(cell.readings, [&](const auto& reading) {
                                return !is_told(reading.first) && !(is_uncertainty(reading.first) && told.contains(what_of(reading.first)));
                            }) == 0;
}

bool StudyResult::complete() const {
    return interrupted.empty() && std::ranges::all_of(cells, [](const CellResult& cell) { return cell.failed.empty(); });
}

void add_axis_warnings(StudyResult& result) {
    for (const StudyAxis& axis : result.study.axes) {
        std::map<std::string, std::map<std::string, std::string>> read; // by value, then by all else
        for (const CellResult& cell : result.cells) {
            const StudyCell& at = cell.cell;
            std::string value,
                rest = fmt::format("{} {} {} {} {} {} {}", at.drive, at.lamp, at.technique, at.time_of_day, at.aim, at.voltage, at.mirror);
            for (const AxisValue& one : at.axes)
                (one.axis == axis.name ? value : rest += "\n") += one.value;
            read[value.empty() ? "the drives' own" : value][rest] = cell.failed.empty() ? hash_of_readings(cell) : cell.cell.name;
        }
        std::map<std::map<std::string, std::string>, std::vector<std::string>> alike;
        for (const auto& [value, of_value] : read)
            alike[of_value].push_back(value);
        for (const auto& [cells, values] : alike)
            if (values.size() > 1)
                result.warnings.push_back(fmt::format("axis {}: {} read the same in every cell, to the last bit: nothing that was "
                                                      "measured depends on it",
                                                      axis.name, fmt::join(values, " and ")));
    }
}

void compare_cells(StudyResult& result) {
    result.played_in_part = played_in_part(result);
    for (const CellResult& cell : result.cells)
        std::ranges::copy(std::views::keys(cell.readings), std::inserter(result.keys, result.keys.end()));
    compute_changes(result, [&](Change change) {
        if (result.cells[change.tested].readings.contains(change.reading) && result.cells[change.against].readings.contains(change.reading))
            result.changes.push_back(std::move(change));
        else
            ++result.changes_elsewhere;
    });
    rank(result);
    judge_deciding(result);
    for (const StudyLimit& limit : result.study.limits) {
        const auto others = static_cast<std::ptrdiff_t>(result.verdicts.size());
        limit.change_at_least || limit.change_at_most ? judge_changes(result, limit) : judge_values(result, limit);
        std::for_each(result.verdicts.begin() + others, result.verdicts.end(), [&](Verdict& verdict) { verdict.line = limit.line; });
    }
}

} // namespace fernlicht
