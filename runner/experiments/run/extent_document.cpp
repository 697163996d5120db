#include "runner/experiments/run/run_document.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/findings/figures.h"
#include "runner/findings/summary.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
namespace {

constexpr const char* nothing = "\u2013";

Cell value_cell(const Value& value, int decimals) {
    return value.measured() ? Cell(with_bound(value, figure(*value.figure(), decimals)), *value.figure()) : Cell(nothing);
}

/// A measured figure of a lamp set, and where there are several, how far it is from the first one's: medians.
void add_compared(std::vector<Cell>& cells, const ComparedDrive& drive, const ExtentSummary& own, const ExtentSummary* first, int decimals,
                  Quantity quantity, const std::optional<double>& distance_m = {}) {
    const auto median = [&](const ExtentSummary& of) { return moments_of(of, quantity, Aspect::value, distance_m).quantile(0.5); };
    const Value now = median(own);
    cells.push_back(value_cell(now, decimals));
    if (drive.lamp_sets.size() < 2)
        return;
    const Value change = first ? difference(now, median(*first), "") : Value();
    cells.push_back(!first              ? Cell("")
                    : change.measured() ? Cell(with_bound(change, signed_figure(*change.figure(), decimals)), *change.figure())
                                        : Cell(nothing));
}

void add_heads(std::vector<Column>& columns, const ComparedDrive& drive, const std::string& what, const char* unit) {
    if (drive.lamp_sets.size() < 2) {
        columns.push_back({what, unit});
        return;
    }
    columns.push_back({"median", unit, what});
    columns.push_back({"difference", unit, what});
}

/// What all lamp sets of a drive have together: (plane, lane) in order of sight, limits and width distances ascending.
struct Axes {
    std::vector<std::pair<Surface, std::string>> places;
    std::set<double> thresholds_lx, widths_at_m;
};

Axes axes_of(const ComparedDrive& drive) {
    Axes axes;
    for (const PlayedCell* const played : drive.lamp_sets)
        for (const ExtentSummary& summary : played->extent_summaries) {
            const std::pair place(summary.key.surface, summary.key.lane);
            if (std::find(axes.places.begin(), axes.places.end(), place) == axes.places.end())
                axes.places.push_back(place);
            axes.thresholds_lx.insert(summary.key.threshold_lx);
            for (const auto& [key, moments] : summary.moments)
                if (key.distance_m)
                    axes.widths_at_m.insert(*key.distance_m);
        }
    const auto rank = [](const auto& place) { return std::tuple(place.second != "own", place.first); };
    std::stable_sort(axes.places.begin(), axes.places.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    return axes;
}

std::string lane_title(const std::string& lane) {
    return lane == "own" ? "Own lane" : lane == "all" ? "Whole width that was looked at" : "Lane \u201c" + short_text(lane, 60) + "\u201d";
}

std::vector<Column> extent_columns(const ComparedDrive& drive, const Axes& axes, bool own) {
    std::vector<Column> columns{{"threshold", "lx"}, {.head = "lamp", .words = true}};
    add_heads(columns, drive, "reach", "m");
    for (const double at_m : axes.widths_at_m)
        add_heads(columns, drive, fmt::format("width at {:g} m", at_m), "m");
    add_heads(columns, drive, "area", "m\u00b2");
    columns.push_back({"reach, min to max", "m"});
    if (own)
        columns.insert(columns.end(), {{"by 0.1° of aim", "m"}, {"by 10 % of flux", "m"}});
    columns.push_back({"twin off by ≤", "m"});
    if (own)
        columns.push_back({"grid error", "m"});
    return columns;
}

/// `first`: of the first lamp set; nullptr: it is that one.
std::vector<Cell> extent_cells(const ComparedDrive& drive, const ExtentSummary& summary, const ExtentSummary* first, const Axes& axes,
                               bool own) {
    std::vector<Cell> cells;
    const auto of_reach = [&](Aspect aspect, double share, int decimals) {
        return value_cell(moments_of(summary, Quantity::reach, aspect).quantile(share), decimals);
    };
    add_compared(cells, drive, summary, first, 1, Quantity::reach);
    for (const double at_m : axes.widths_at_m)
        add_compared(cells, drive, summary, first, 1, Quantity::width, at_m);
    add_compared(cells, drive, summary, first, 0, Quantity::area);
    cells.emplace_back(moments_of(summary, Quantity::reach).count() > 0
                           ? of_reach(Aspect::value, 0.0, 1).text + "\u2009\u2026\u2009" + of_reach(Aspect::value, 1.0, 1).text
                           : nothing);
    if (own)
        cells.insert(cells.end(), {value_cell(reach_moved_m(summary, by_aim), 1), value_cell(reach_moved_m(summary, by_flux), 1)});
    cells.push_back(of_reach(Aspect::twin_difference, 1.0, 2));
    if (own)
        cells.push_back(of_reach(Aspect::grid_error, 0.5, 2));
    return cells;
}

Table extent_table(const ComparedDrive& drive, const Axes& axes, Surface surface, const std::string& lane) {
    const bool own = lane == "own";
    Table table{fmt::format("{}-extent-{}-{}", drive.name, surface_name(surface), lane),
                lane_title(lane) +
                    (surface == Surface::road
                         ? ", on the road\u2019s surface"
                         : ", on a target (a plate that faces the lamps, 0.25 m above the road unless the drive says otherwise)"),
                extent_columns(drive, axes, own),
                {},
                !own};
    for (const double threshold_lx : axes.thresholds_lx) {
        std::vector<ExtentSummary> summaries;
        for (const PlayedCell* const played : drive.lamp_sets) {
            const auto found = std::ranges::find(played->extent_summaries, ExtentKey{surface, lane, threshold_lx}, &ExtentSummary::key);
            summaries.push_back(found == played->extent_summaries.end() ? ExtentSummary() : *found);
        }
        for (std::size_t i = 0; i < summaries.size(); ++i) {
            std::vector<Cell>& row = table.rows.emplace_back();
            row = {{fmt::format("{:g}", threshold_lx), threshold_lx}, lamp_cell(drive, i)};
            const std::vector<Cell> cells = extent_cells(drive, summaries[i], i > 0 ? &summaries.front() : nullptr, axes, own);
            row.insert(row.end(), cells.begin(), cells.end());
        }
    }
    return table;
}

} // namespace

void add_extents(const ComparedDrive& drive, Sections& sections) {
    const Axes axes = axes_of(drive);
    if (axes.places.empty())
        return;
    Section& section = sections.emplace_back(Section{"Reach and width", {}, 3});
    section.blocks.emplace_back(
        fmt::format("Medians over the drive, from the rendered lux image. Reach runs from the bumper along the "
                    "lane’s centre to the farthest place with at least that illuminance{}.",
                    drive.lamp_sets.size() > 1 ? "; differences are from " + drive.lamp_sets.front()->lamp_set : ""));
    for (const auto& [surface, lane] : axes.places)
        section.blocks.emplace_back(extent_table(drive, axes, surface, lane));
}

} // namespace fernlicht
