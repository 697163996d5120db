#include "runner/study/study_result.h"
#include "runner/summary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
namespace {

bool is_trust(const std::string& name) { // says how exact another reading is; no reading of a lamp
    for (const char* part : {"_twin_difference", "_grid_error", "_per_tenth_", "_standard_error"})
        if (name.find(part) != std::string::npos)
            return true;
    return name.find("_twin_") != std::string::npos;
}

std::optional<double> value_of(const CellResult& cell, const std::string& name) {
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
std::optional<double> uncertainty_of(const CellResult& cell, const Reading& reading) {
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

std::optional<double> by_aim(const CellResult& a, const CellResult& b, const std::string& name) {
    if (!name.starts_with("reach_") || subject_of(name).empty())
        return std::nullopt;
    const std::string row = subject_of(name) + "_per_tenth_degree_m";
    const auto first = value_of(a, row), second = value_of(b, row);
    if (!first && !second)
        return std::nullopt;
    return std::max(std::abs(first.value_or(0.0)), std::abs(second.value_or(0.0)));
}

void judge(Change& change, const std::optional<double>& tested, const std::optional<double>& against) {
    if (!change.new_value || !change.old_value)
        return;
    if (!tested || !against) {
        change.why_not = "nothing tells how exact this reading is";
        return;
    }
    change.uncertainty = std::hypot(*tested, *against);
    const double size = std::abs(change.delta());
    change.kind = size <= *change.uncertainty                                                ? ChangeKind::none
                  : change.by_aim && size <= std::hypot(*change.by_aim, *change.uncertainty) ? ChangeKind::within_aim
                                                                                             : ChangeKind::real;
}

Change change_of(const StudyResult& result, std::size_t tested, std::size_t against, const std::string& name) {
    const CellResult &a = result.cells[tested], &b = result.cells[against];
    const Reading &now = a.readings.at(name), &before = b.readings.at(name);
    Change change;
    change.tested = tested;
    change.against = against;
    change.reading = name;
    change.unit = now.unit;
    change.new_value = now.value;
    change.old_value = before.value;
    change.why_not = now.value ? before.why_not : now.why_not;
    change.by_aim = by_aim(a, b, name);
    change.decides = std::ranges::find(result.study.readings, name) != result.study.readings.end();
    judge(change, uncertainty_of(a, now), uncertainty_of(b, before));
    return change;
}

/// Cells of everything but the lamp alike.
bool is_same_place(const StudyCell& a, const StudyCell& b) {
    return a.drive == b.drive && a.technique == b.technique && a.time_of_day == b.time_of_day && a.aim == b.aim && a.voltage == b.voltage;
}

void compare_pair(StudyResult& result, const StudyComparison& comparison) {
    const auto lamp_of = [&](const CellResult& cell) { return result.study.lamps[cell.cell.lamp].name; };
    for (std::size_t i = 0; i < result.cells.size(); ++i)
        for (std::size_t k = 0; k < result.cells.size(); ++k) {
            const CellResult &a = result.cells[i], &b = result.cells[k];
            if (lamp_of(a) != comparison.tested || lamp_of(b) != comparison.against || !is_same_place(a.cell, b.cell))
                continue;
            for (const auto& [name, reading] : a.readings)
                if (!is_trust(name) && !is_of_time(reading) && b.readings.contains(name))
                    result.changes.push_back(change_of(result, i, k, name));
        }
}

/// Of each deciding reading its largest real change, and of these the three largest.
void rank(StudyResult& result) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < result.changes.size(); ++i)
        if (result.changes[i].kind == ChangeKind::real && result.changes[i].decides)
            order.push_back(i);
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return result.changes[i].size(); });
    std::set<std::string> shown;
    for (const std::size_t i : order)
        if (result.largest.size() < 3 && shown.insert(result.changes[i].reading).second)
            result.largest.push_back(i);
}

Verdict verdict_on(const std::string& name, const std::optional<double>& value, const std::string& unit, const std::string& why_not,
                   const std::optional<double>& least, const std::optional<double>& most, const std::string& rerun) {
    if (!value)
        return {VerdictKind::not_measured, name, why_not, rerun};
    std::string limits = least ? fmt::format("at least {:g} {}", *least, unit) : "";
    if (most)
        limits += fmt::format("{}at most {:g} {}", limits.empty() ? "" : ", ", *most, unit);
    const bool kept = (!least || *value >= *least) && (!most || *value <= *most);
    return {kept ? VerdictKind::pass : VerdictKind::fail, name, fmt::format("{:.4g} {}, limit {}", *value, unit, limits), rerun};
}

void judge_values(StudyResult& result, const StudyLimit& limit) {
    for (const CellResult& cell : result.cells) {
        if (!limit.lamp.empty() && result.study.lamps[cell.cell.lamp].name != limit.lamp)
            continue;
        const auto found = cell.readings.find(limit.reading);
        const bool known = found != cell.readings.end();
        result.verdicts.push_back(verdict_on(cell.cell.name + ": " + limit.reading, known ? found->second.value : std::nullopt,
                                             known ? found->second.unit : "",
                                             known                 ? found->second.why_not
                                             : cell.failed.empty() ? "no reading of this name"
                                                                   : "the cell was not played: " + cell.failed,
                                             limit.at_least, limit.at_most, cell.command));
    }
}

void judge_changes(StudyResult& result, const StudyLimit& limit) {
    bool found = false;
    for (const Change& change : result.changes) {
        if (change.reading != limit.reading)
            continue;
        found = true;
        const CellResult& cell = result.cells[change.tested];
        const bool known = change.new_value && change.old_value;
        result.verdicts.push_back(verdict_on(cell.cell.name + ": change of " + limit.reading,
                                             known ? std::optional(change.delta()) : std::nullopt, change.unit, change.why_not,
                                             limit.change_at_least, limit.change_at_most, cell.command));
    }
    if (!found)
        result.verdicts.push_back(
            {VerdictKind::not_measured, "change of " + limit.reading, "no comparison has this reading", result.context.command});
}

} // namespace

const char* change_name(ChangeKind kind) {
    static constexpr const char* names[] = {"real", "within aim", "no difference", "not known"};
    return names[static_cast<std::size_t>(kind)];
}

double Change::size() const {
    const double largest = std::max(std::abs(new_value.value_or(0.0)), std::abs(old_value.value_or(0.0)));
    return largest > 0.0 ? std::abs(delta()) / largest : 0.0;
}

bool StudyResult::complete() const {
    return interrupted.empty() && std::ranges::all_of(cells, [](const CellResult& cell) { return cell.failed.empty(); });
}

VerdictKind overall(const StudyResult& result) {
    bool missing = !result.complete();
    const auto count = [&](const std::vector<Verdict>& verdicts) {
        bool failed = false;
        for (const Verdict& verdict : verdicts) {
            failed = failed || verdict.kind == VerdictKind::fail;
            missing = missing || verdict.kind == VerdictKind::not_measured;
        }
        return failed;
    };
    bool failed = count(result.verdicts);
    for (const CellResult& cell : result.cells)
        failed = count(cell.verdicts) || failed;
    return failed ? VerdictKind::fail : missing ? VerdictKind::not_measured : VerdictKind::pass;
}

void compare_cells(StudyResult& result) {
    for (const StudyComparison& comparison : result.study.comparisons)
        compare_pair(result, comparison);
    rank(result);
    for (const StudyLimit& limit : result.study.limits)
        limit.change_at_least || limit.change_at_most ? judge_changes(result, limit) : judge_values(result, limit);
}

} // namespace fernlicht
