#include "metrics/readings/reading_words.h"
#include "runner/experiments/compare/lamps/lamp_against.h"
#include "runner/experiments/compare/runs/lux_ratio.h"
#include "runner/experiments/study/study_maps.h"
#include "runner/experiments/study/study_words.h"
#include "runner/experiments/study/study_writers.h"
#include "runner/files/clean_text.h"
#include "runner/files/output_folder.h"
#include "runner/findings/extent_keys.h"
#include "runner/write/plots/lux_map.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace fernlicht {
namespace {

/// Cells that differ in nothing but the lamp.
bool is_beside(const StudyCell& a, const StudyCell& b) {
    return a.drive == b.drive && a.technique == b.technique && a.time_of_day == b.time_of_day && a.aim == b.aim && a.voltage == b.voltage &&
           a.mirror == b.mirror;
}

/// Groups of such cells, in order; cells that were not played are left out, and groups without any.
std::vector<std::vector<std::size_t>> groups_of(const StudyResult& result) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < result.cells.size(); ++i) {
        if (!result.cells[i].failed.empty())
            continue;
        if (groups.empty() || !is_beside(result.cells[groups.back().front()].cell, result.cells[i].cell))
            groups.emplace_back();
        groups.back().push_back(i);
    }
    return groups;
}

plots::Colour colour_of(const StudyResult& result, std::size_t cell) { return plots::series_colour(result.cells[cell].cell.lamp); }

/// "straight_twilight": the group's cells' common name.
std::string group_name(const StudyResult& result, const std::vector<std::size_t>& group) {
    std::string name = result.cells[group.front()].cell.name;
    if (const std::size_t at = name.find("_" + lamp_of(result, group.front())); at != std::string::npos)
        name.erase(at, 1 + lamp_of(result, group.front()).size());
    return name;
}

std::string place_of(const StudyResult& result, const std::vector<std::size_t>& group) {
    const CellResult& cell = result.cells[group.front()];
    return short_text(cell.title, 60) + "; " + cell.cell.condition;
}

/// The reach plotted of what the deciding readings ask for: on a target and on the road, at the limits that they name.
std::set<std::pair<ExtentPlane, double>> plotted_reaches(const StudyResult& result) {
    std::set<std::pair<ExtentPlane, double>> keys;
    for (const CellResult& cell : result.cells)
        for (const ReachOverDrive& reach : cell.reaches) {
            if (is_named(reach.key(), result.study.readings))
                keys.emplace(reach.plane, reach.limit_lx);
        }
    return keys;
}

void add_reach(const StudyResult& result, const std::vector<std::size_t>& group, ExtentPlane plane, double limit_lx,
               std::vector<StudyFigure>& figures) {
    plots::Figure figure;
    figure.title = fmt::format("Reach at {:g} lx {}, own lane", limit_lx, plane == ExtentPlane::road ? "on the road" : "on a target");
    figure.subtitle = place_of(result, group);
    figure.width_px = 560.0;
    figure.height_px = 300.0;
    std::vector<double> xs, ys;
    for (const std::size_t cell : group)
        for (const ReachOverDrive& reach : result.cells[cell].reaches) {
            if (reach.plane != plane || reach.limit_lx != limit_lx)
                continue;
            plots::Series line{short_text(lamp_of(result, cell), 24), {}, colour_of(result, cell), 1.6, "", reach.reach_m.size() == 1};
            for (std::size_t i = 0; i < reach.reach_m.size(); ++i)
                line.points.push_back({reach.distance_m[i], reach.reach_m[i]});
            xs.insert(xs.end(), reach.distance_m.begin(), reach.distance_m.end());
            ys.insert(ys.end(), reach.reach_m.begin(), reach.reach_m.end());
            figure.series.push_back(std::move(line));
        }
    if (figure.series.empty())
        return;
    figure.x = plots::axis_around("along the route", "m", xs);
    figure.y = plots::axis_around("reach", "m", ys, plots::Scale::linear, true);
    figures.push_back({fmt::format("reach-{:g}lx-{}_{}", limit_lx, plane_name(plane), group_name(result, group)),
                       figure.title + ": " + figure.subtitle, plots::svg_of(figure), group});
}

/// A line a lamp for each eye that the drive has.
void add_glares(const StudyResult& result, const std::vector<std::size_t>& group, std::vector<StudyFigure>& figures) {
    for (const GlareOverDrive& first : result.cells[group.front()].glares) {
        plots::Figure figure;
        figure.title = "Glare: " + short_text(eyes_in_words(first.eye), 50);
        figure.subtitle = place_of(result, group);
        figure.width_px = 560.0;
        figure.height_px = 300.0;
        std::vector<double> xs, ys;
        for (const std::size_t cell : group)
            for (const GlareOverDrive& glare : result.cells[cell].glares) {
                if (glare.eye != first.eye)
                    continue;
                plots::Series line{short_text(lamp_of(result, cell), 24), {}, colour_of(result, cell), 1.6, "", glare.at_m.size() == 1};
                for (std::size_t i = 0; i < glare.at_m.size(); ++i)
                    line.points.push_back({glare.at_m[i], glare.facing_lx[i]});
                xs.insert(xs.end(), glare.at_m.begin(), glare.at_m.end());
                ys.insert(ys.end(), glare.facing_lx.begin(), glare.facing_lx.end());
                figure.series.push_back(std::move(line));
            }
        figure.x = plots::axis_around(first.over, "m", xs);
        figure.y = plots::axis_around("illuminance facing the lamps", "lx", ys, plots::Scale::logarithmic);
        figures.push_back({fmt::format("glare-{}_{}", file_name_of(eye_name(first.eye)), group_name(result, group)),
                           figure.title + ": " + figure.subtitle, plots::svg_of(figure), group});
    }
}

void add_maps(const StudyResult& result, const std::vector<std::size_t>& group, const std::filesystem::path& folder,
              std::vector<StudyFigure>& figures) {
    std::vector<std::optional<LuxMap>> maps;
    for (const std::size_t cell : group) {
        maps.push_back(map_of(result.cells[cell], folder));
        if (maps.back())
            figures.push_back({fmt::format("lux_{}", result.cells[cell].cell.name),
                               fmt::format("{}: {}", lamp_of(result, cell), place_of(result, group)),
                               plots::lux_map_svg(*maps.back(), lamp_of(result, cell) + ", " + place_of(result, group)),
                               {cell}});
    }
    for (const StudyComparison& pair : result.study.comparisons)
        for (std::size_t a = 0; a < group.size(); ++a)
            for (std::size_t b = 0; b < group.size(); ++b) {
                if (lamp_of(result, group[a]) != pair.tested || lamp_of(result, group[b]) != pair.against || !maps[a] || !maps[b])
                    continue;
                const std::string title = fmt::format("{} over {}, {}", pair.tested, pair.against, place_of(result, group));
                if (std::string svg = lux_ratio_svg(*maps[a], *maps[b], title); !svg.empty())
                    figures.push_back({fmt::format("lux-difference_{}_{}-{}", group_name(result, group), pair.tested, pair.against),
                                       title,
                                       std::move(svg),
                                       {group[a], group[b]}});
            }
}

/// Error against the reference over the time of a driver's view, one point a cell.
void add_work_precision(const StudyResult& result, std::vector<StudyFigure>& figures) {
    plots::Figure figure;
    figure.title = "Error against run time";
    figure.subtitle = "95 % of the road's illuminance lies within, against the reference";
    figure.width_px = 560.0;
    figure.height_px = 360.0;
    std::vector<double> xs, ys;
    std::vector<std::size_t> cells;
    for (std::size_t technique = 0; technique < result.study.techniques.size(); ++technique) {
        plots::Series series{result.study.techniques[technique], {}, plots::series_colour(technique), 0.0, "", true};
        for (std::size_t i = 0; i < result.cells.size(); ++i) {
            const CellResult& cell = result.cells[i];
            if (cell.cell.technique != technique || !cell.error_share || !cell.frame_s)
                continue;
            series.points.push_back({1e3 * *cell.frame_s, 100.0 * *cell.error_share});
            xs.push_back(series.points.back().x);
            ys.push_back(series.points.back().y);
            cells.push_back(i);
        }
        // Points of their own, not a line from cell to cell.
        for (const plots::Point& point : series.points)
            figure.series.push_back({figure.series.empty() || figure.series.back().colour != series.colour ? series.name : "",
                                     {point},
                                     series.colour,
                                     1.0,
                                     "",
                                     true});
    }
    if (cells.empty())
        return;
    figure.x = plots::axis_around("time a frame", "ms", xs, plots::Scale::logarithmic);
    figure.y = plots::axis_around("error", "%", ys, plots::Scale::logarithmic);
    figures.push_back({"work-precision", figure.title, plots::svg_of(figure), cells});
}

void add_lamp_differences(const StudyResult& result, std::vector<StudyFigure>& figures) {
    for (const LampComparison& lamps : result.lamps) {
        plots::Figure figure = difference_figure(read_lamp(lamps.file), read_lamp(lamps.other_file), lamps.difference);
        figure.title = fmt::format("{} over {} ({})", lamps.tested, lamps.against, lamps.side);
        figures.push_back({fmt::format("lamps_{}-{}{}", lamps.tested, lamps.against, lamps.side == "right" ? "_right" : ""),
                           figure.title,
                           plots::svg_of(figure),
                           {}});
    }
}

} // namespace

std::vector<StudyFigure> study_figures(const StudyResult& result, const std::filesystem::path& folder) {
    std::vector<StudyFigure> figures;
    add_lamp_differences(result, figures);
    const std::vector<std::vector<std::size_t>> groups = groups_of(result);
    for (const auto& [plane, limit_lx] : plotted_reaches(result))
        for (const std::vector<std::size_t>& group : groups)
            add_reach(result, group, plane, limit_lx, figures);
    for (const std::vector<std::size_t>& group : groups)
        add_glares(result, group, figures);
    for (const std::vector<std::size_t>& group : groups)
        add_maps(result, group, folder, figures);
    add_work_precision(result, figures);
    return figures;
}

} // namespace fernlicht
