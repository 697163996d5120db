#include "runner/experiments/study/study_document.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// What tells the aims of one cell from those of another: drives carry lamps at heights of their own.
bool is_same_aim(const StudyResult& result, const CellResult& a, const CellResult& b) {
    const auto aim_of = [&](const CellResult& cell) { return result.study.conditions.aim_percent[cell.cell.aim]; };
    return a.cell.lamp == b.cell.lamp && a.cell.mirror == b.cell.mirror && aim_of(a) == aim_of(b) && a.aims == b.aims;
}

/// The first of all cells that have the same aims.
std::vector<const CellResult*> cells_of_aims(const StudyResult& result) {
    std::vector<const CellResult*> cells;
    for (const CellResult& cell : result.cells)
        if (!cell.aims.empty() && std::ranges::none_of(cells, [&](const CellResult* known) { return is_same_aim(result, *known, cell); }))
            cells.push_back(&cell);
    return cells;
}

} // namespace

Section aims_section(const StudyResult& result) {
    Table table{"aim", "", aim_columns("of<|asked for: aim [%]"), {}};
    for (const CellResult* const cell : cells_of_aims(result)) {
        const double asked = result.study.conditions.aim_percent[cell->cell.aim];
        const bool mirrored = result.study.conditions.mirror[cell->cell.mirror];
        add_aim_rows(table,
                     {result.study.lamps[cell->cell.lamp].name + (mirrored ? ", mirrored" : ""), {fmt::format("{:g}", asked), asked}},
                     cell->aims);
    }
    if (table.rows.empty())
        return {"Aim of the lamps", {}};
    return {"Aim of the lamps", {aim_legend(), std::move(table)}};
}

void add_aim_warnings(StudyResult& result) {
    for (const CellResult* const cell : cells_of_aims(result))
        for (const std::string& warning : aim_warnings(result.study.lamps[cell->cell.lamp].name, cell->aims))
            if (std::ranges::find(result.warnings, warning) == result.warnings.end())
                result.warnings.push_back(warning);
}

void add_gaze_warnings(StudyResult& result) {
    Gazes all;
    for (const CellResult& cell : result.cells)
        for (const auto& [eye, theta_deg] : cell.gazes) {
            double& nearest = all.try_emplace(eye, theta_deg).first->second;
            nearest = std::min(nearest, theta_deg);
        }
    std::ranges::copy(gaze_warnings(all), std::back_inserter(result.warnings));
}

} // namespace fernlicht
