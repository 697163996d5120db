#include "metrics/readings/reading_labels.h"
#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/compare/runs/lux_ratio.h"
#include "runner/experiments/run/run_plots.h"
#include "runner/experiments/study/study_document.h"
#include "runner/files/clean_text.h"
#include "runner/files/output_folder.h"
#include "runner/findings/extent_keys.h"
#include "runner/play/lux_map.h"
#include "runner/play/stage.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace fernlicht {
namespace {

const View* view_of(const CellResult& cell, const StoredFrame& frame) {
    const auto found = std::ranges::find(cell.maps, frame.view, &View::name);
    return found == cell.maps.end() ? nullptr : &*found;
}

/// The middle one of those from above; nullptr where there is none.
const StoredFrame* map_frame(const CellResult& cell) {
    std::vector<const StoredFrame*> maps;
    for (const StoredFrame& frame : cell.frames)
        if (!frame.exr.empty() && view_of(cell, frame))
            maps.push_back(&frame);
    return maps.empty() ? nullptr : maps[maps.size() / 2];
}

/// Of one group, as StudyResult::pairs_of.
std::vector<std::pair<std::size_t, std::size_t>> pairs_within(const StudyResult& result, const std::vector<std::size_t>& group,
                                                              const StudyComparison& pair) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const std::size_t a : group)
        for (const std::size_t b : group)
            if (result.lamp_of(a) == pair.tested && result.lamp_of(b) == pair.against)
                pairs.emplace_back(a, b);
    return pairs;
}

/// "straight_twilight": the group's cells' common name.
std::string group_name(const StudyResult& result, const std::vector<std::size_t>& group) {
    std::string name = result.cells[group.front()].cell.name;
    if (const std::size_t at = name.find("_" + result.lamp_of(group.front())); at != std::string::npos)
        name.erase(at, 1 + result.lamp_of(group.front()).size());
    return name;
}

std::string place_of(const StudyResult& result, const std::vector<std::size_t>& group) {
    const CellResult& cell = result.cells[group.front()];
    return short_text(cell.title, 60) + "; " + cell.cell.condition;
}

StudyFigure with_files(const std::string& name, const std::string& title, decltype(Plot::figure) figure, std::vector<std::size_t> cells) {
    return {{.name = "figures/" + name, .figure = std::move(figure), .scale = 2.0}, title, std::move(cells)};
}

StudyFigure small_figure(const StudyResult& result, const std::string& name, plots::Figure figure, const std::vector<std::size_t>& cells) {
    const std::string title = figure.title + ": " + figure.subtitle;
    StudyFigure small = with_files(name, title, std::move(figure), cells);
    small.plot.beside = true;
    small.plot.places = {result.place_of(cells.front())};
    return small;
}

void widen(plots::Axis& axis, const plots::Axis& by) {
    axis.from = std::min(axis.from, by.from);
    axis.to = std::max(axis.to, by.to);
}

/// What stands beside each other is read in one scale. Along the route only where that leaves no plot half empty.
void share_axes(std::vector<StudyFigure>& figures) {
    constexpr double most_of_shortest = 2.0;
    std::map<std::string, std::vector<plots::Figure*>> alike;
    for (StudyFigure& drawn : figures)
        if (auto* const figure = std::get_if<plots::Figure>(&drawn.plot.figure); figure && !drawn.plot.places.empty())
            alike[figure->title].push_back(figure);
    for (auto& [title, group] : alike) {
        plots::Axis x = group.front()->x, y = group.front()->y;
        double shortest = x.to - x.from;
        for (const plots::Figure* const figure : group) {
            widen(x, figure->x);
            widen(y, figure->y);
            shortest = std::min(shortest, figure->x.to - figure->x.from);
        }
        for (plots::Figure* const figure : group) {
            figure->y = y;
            if (x.to - x.from <= most_of_shortest * shortest)
                figure->x = x;
        }
    }
}

/// A plot with a line a lamp of a group, and all values of its axes.
struct GroupLines {
    const StudyResult& result;
    plots::Figure figure;
    std::vector<double> xs = {}, ys = {};

    GroupLines(const StudyResult& of, const std::vector<std::size_t>& group, std::string title) : result(of) {
        figure.title = std::move(title);
        figure.subtitle = place_of(result, group);
        figure.width_px = 420.0;
        figure.height_px = 230.0;
    }
    void add(std::size_t cell, const std::vector<double>& x, const std::vector<double>& y) {
        plots::Series line{
            short_text(result.lamp_of(cell), 24), {}, plots::lamp_colour(result.cells[cell].cell.lamp), 1.6, "", y.size() == 1};
        for (std::size_t i = 0; i < y.size(); ++i)
            line.points.push_back({x[i], y[i]});
        xs.insert(xs.end(), x.begin(), x.end());
        ys.insert(ys.end(), y.begin(), y.end());
        figure.series.push_back(std::move(line));
    }
};

/// Those of the deciding readings, the most important first.
std::set<std::pair<std::size_t, ReadingKey>> plotted_reaches(const StudyResult& result) {
    std::set<std::pair<std::size_t, ReadingKey>> keys;
    for (const CellResult& cell : result.cells)
        for (const ReachOverDrive& reach : cell.reaches)
            keys.emplace(*place_among(reach.key, result.study.decide), reach.key);
    return keys;
}

/// A lamp's reach that is one figure all over the drive, as on a straight and level road: that figure; nullopt where it is not.
std::optional<double> flat_m(const plots::Series& line, double within_m) {
    const auto [least, most] = std::ranges::minmax_element(line.points, {}, &plots::Point::y);
    return least != line.points.end() && most->y - least->y <= within_m ? std::optional(0.5 * (most->y + least->y)) : std::nullopt;
}

/// Whether both show the same flat lines.
bool is_same_flat(const plots::Figure& a, const plots::Figure& b, double within_m) {
    return a.title == b.title && std::ranges::equal(a.series, b.series, [&](const plots::Series& one, const plots::Series& other) {
               const auto first = flat_m(one, within_m), second = flat_m(other, within_m);
               return one.name == other.name && first && second && std::abs(*first - *second) <= within_m;
           });
}

/// Places that draw one and the same flat line have it once.
void add_reach(const StudyResult& result, const std::vector<std::size_t>& group, const ReadingKey& key, std::vector<StudyFigure>& figures) {
    GroupLines lines(result, group, capitalised(reading_label(key)));
    for (const std::size_t cell : group)
        for (const ReachOverDrive& reach : result.cells[cell].reaches)
            if (reach.key == key)
                lines.add(cell, reach.distance_m, reach.reach_m);
    if (lines.figure.series.empty())
        return;
    const double within_m = result.cells[group.front()].grid_cell_m;
    for (StudyFigure& drawn : figures)
        if (auto* const same = std::get_if<plots::Figure>(&drawn.plot.figure); same && is_same_flat(*same, lines.figure, within_m)) {
            const std::string also =
                fmt::format("{} {}", drawn.plot.places.size() > 1 ? "," : "; the same on", result.place_of(group.front()));
            drawn.plot.places.push_back(result.place_of(group.front()));
            same->subtitle += also;
            drawn.title += also;
            drawn.cells.insert(drawn.cells.end(), group.begin(), group.end());
            return;
        }
    lines.figure.x = plots::axis_around("along the route", "m", lines.xs);
    lines.figure.y = plots::axis_around("reach", "m", lines.ys, plots::Scale::linear, true);
    figures.push_back(small_figure(result, name_of(key) + "_" + group_name(result, group), std::move(lines.figure), group));
}

/// A line a lamp for each eye that the drive has.
void add_glares(const StudyResult& result, const std::vector<std::size_t>& group, std::vector<StudyFigure>& figures) {
    for (const GlareOverDrive& first : result.cells[group.front()].glares) {
        GroupLines lines(result, group, "Glare: " + short_text(eye_label(first.eye), 50));
        for (const std::size_t cell : group)
            for (const GlareOverDrive& glare : result.cells[cell].glares)
                if (glare.eye == first.eye)
                    lines.add(cell, glare.at_m, glare.facing_lx);
        lines.figure.x = plots::axis_around(first.over, "m", lines.xs);
        lines.figure.y = plots::axis_around("facing illuminance", "lx", lines.ys, plots::Scale::logarithmic);
        figures.push_back(small_figure(result, fmt::format("glare-{}_{}", file_name_of(eye_name(first.eye)), group_name(result, group)),
                                       std::move(lines.figure), group));
    }
}

/// Its lux with the cell's `map_edges`. nullopt where there is no such frame, or no lux in it.
std::optional<LuxMap> map_of(const CellResult& cell, const std::filesystem::path& folder) {
    const StoredFrame* frame = map_frame(cell);
    if (!frame)
        return std::nullopt;
    std::optional<LuxMap> map = stored_lux_map(folder / frame->exr, *frame, *view_of(cell, *frame));
    if (map)
        map->edges = cell.map_edges;
    return map;
}

void add_maps(const StudyResult& result, const std::vector<std::size_t>& group, const std::filesystem::path& folder,
              std::vector<StudyFigure>& figures) {
    std::map<std::size_t, LuxMap> maps; // by cell
    for (const std::size_t cell : group)
        if (std::optional<LuxMap> map = map_of(result.cells[cell], folder)) {
            const std::string place = place_of(result, group), &lamp = result.lamp_of(cell);
            if (auto figure = lux_map_figure(*map, lamp + ", " + place))
                figures.push_back(with_files("lux_" + result.cells[cell].cell.name, lamp + ": " + place, std::move(*figure), {cell}));
            maps.emplace(cell, std::move(*map));
        }
    for (const StudyComparison& pair : result.study.comparisons)
        for (const auto& [a, b] : pairs_within(result, group, pair)) {
            if (!maps.contains(a) || !maps.contains(b))
                continue;
            const std::string title = fmt::format("{} over {}, {}", pair.tested, pair.against, place_of(result, group));
            if (auto figure = lux_ratio_figure(maps.at(a), maps.at(b), title))
                figures.push_back(with_files(fmt::format("lux-difference_{}_{}-{}", group_name(result, group), pair.tested, pair.against),
                                             title, std::move(*figure), {a, b}));
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
    figures.push_back(with_files("work-precision", figure.title, figure, cells));
    figures.back().plot.beside = true;
}

void add_lamp_differences(const StudyResult& result, std::vector<StudyFigure>& figures) {
    for (const LampComparison& lamps : result.lamps) {
        plots::Figure figure = difference_figure(read_lamp(lamps.file, {.recipe = lamps.recipe}),
                                                 read_lamp(lamps.other_file, {.recipe = lamps.other_recipe}), lamps.difference);
        figure.title = fmt::format("{} over {} ({})", lamps.tested, lamps.against, lamps.side);
        const std::string title = figure.title;
        figures.push_back(with_files(fmt::format("lamps_{}-{}{}", lamps.tested, lamps.against, lamps.side == "right" ? "_right" : ""),
                                     title, std::move(figure), {}));
    }
}

} // namespace

std::vector<std::vector<std::size_t>> groups_of(const StudyResult& result) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < result.cells.size(); ++i) {
        if (!result.cells[i].failed.empty())
            continue;
        if (groups.empty() || !is_same_place(result.cells[groups.back().front()].cell, result.cells[i].cell))
            groups.emplace_back();
        groups.back().push_back(i);
    }
    return groups;
}

std::vector<StudyFigure> study_figures(const StudyResult& result, const std::filesystem::path& folder) {
    std::vector<StudyFigure> figures;
    add_over_axes(result, figures);
    add_lamp_differences(result, figures);
    std::vector<std::vector<std::size_t>> groups = groups_of(result);
    groups.resize(std::min(groups.size(), max_pictured_places));
    for (const auto& [place, key] : plotted_reaches(result))
        for (const std::vector<std::size_t>& group : groups)
            add_reach(result, group, key, figures);
    for (const std::vector<std::size_t>& group : groups)
        add_glares(result, group, figures);
    share_axes(figures);
    if (const std::optional<ReadingKey> first = first_deciding(result))
        for (StudyFigure& drawn : figures)
            if (!drawn.plot.places.empty())
                drawn.plot.rank = gain_among(result, drawn.cells, *first);
    for (const std::vector<std::size_t>& group : groups)
        add_maps(result, group, folder, figures);
    add_work_precision(result, figures);
    return figures;
}

void add_map_edges(const Drive& drive, std::vector<CellResult*> cells) {
    std::erase_if(cells, [](const CellResult* cell) { return map_frame(*cell) == nullptr; });
    if (cells.empty())
        return;
    const Stage stage(drive);
    for (CellResult* cell : cells) {
        const StoredFrame& frame = *map_frame(*cell);
        const std::vector<Moment> moments = moments_at({frame.tick}, stage, stage.drive.lamp_sets.front());
        cell->map_edges = edges_on_map(moments.front(), *view_of(*cell, frame), stage.route);
        cell->map_edges.push_back(car_outline(stage.drive.bumper_m));
    }
}

} // namespace fernlicht
