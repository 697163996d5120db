#include "runner/experiments/study/study_result.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
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
        parts.push_back(fmt::format("{} moments {} of each drive were played: {} of {}", parts.empty() ? "Only" : "only", result.frames,
                                    range_over(result.cells, &CellResult::moments),
                                    range_over(result.cells, &CellResult::moments_of_drive)));
    return fmt::format("{}", fmt::join(parts, "; "));
}

} // namespace

bool is_same_place(const StudyCell& a, const StudyCell& b) {
    return a.drive == b.drive && a.technique == b.technique && a.time_of_day == b.time_of_day && a.aim == b.aim && a.voltage == b.voltage &&
           a.mirror == b.mirror && a.point == b.point;
}

std::string StudyResult::place_of(std::size_t cell) const {
    const bool several =
        std::ranges::any_of(cells, [&](const CellResult& other) { return other.cell.condition != cells.front().cell.condition; });
    return cells[cell].drive + (several ? ", " + cells[cell].cell.condition : "");
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

void each_change(const StudyResult& result, const std::function<void(const Change&)>& take) {
    if (result.changes_elsewhere > 0)
        compute_changes(result, take);
    else
        std::ranges::for_each(result.changes, take);
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
        for (const auto& [cells, values] : alike) {
            constexpr std::size_t most = 5;
            const std::string named = values.size() > most
                                          ? fmt::format("{} values from {} to {}", values.size(), values.front(), values.back())
                                          : fmt::format("{}", fmt::join(values, " and "));
            if (values.size() > 1)
                result.warnings.push_back(fmt::format(
                    "axis {}: {} read the same in every cell, to the last bit: nothing that was measured depends on it", axis.name, named));
        }
    }
}

void compare_cells(StudyResult& result) {
    result.played_in_part = played_in_part(result);
    for (const CellResult& cell : result.cells)
        for (const auto& [key, reading] : cell.readings)
            result.keys.insert(key);
    compute_changes(result, [&](Change change) {
        if (result.cells[change.tested].readings.contains(change.reading) && result.cells[change.against].readings.contains(change.reading))
            result.changes.push_back(std::move(change));
        else
            ++result.changes_elsewhere;
    });
    rank(result);
    judge(result);
}

} // namespace fernlicht
