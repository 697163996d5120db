#include "metrics/readings/reading_labels.h"
#include "runner/experiments/compare/runs/lux_ratio.h"
#include "runner/experiments/compare/runs/run_pairs.h"
#include "runner/files/clean_text.h"
#include "runner/files/output_folder.h"
#include "runner/findings/extent_keys.h"
#include "scenarios/studies/study.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
namespace {

/// A line each for old and new over the way; nothing where neither has a point.
void add_lines(DriveComparison& drive, const std::string& name, const std::string& title, const plots::Polyline& old_line,
               const plots::Polyline& new_line, const std::string& along, const std::string& what, const std::string& unit,
               plots::Scale scale) {
    std::vector<double> xs, ys;
    for (const plots::Polyline* line : {&old_line, &new_line})
        for (const plots::Point& p : *line) {
            xs.push_back(p.x);
            ys.push_back(p.y);
        }
    if (xs.empty())
        return;
    plots::Figure figure;
    figure.title = title;
    figure.subtitle = short_text(drive.now.title, 80);
    figure.width_px = 560.0;
    figure.height_px = 300.0;
    figure.series = {{short_text(drive.old_label(), 40), old_line, plots::series_colour(0), 2.2, "", old_line.size() == 1},
                     {short_text(drive.new_label(), 40), new_line, plots::series_colour(1), 1.6, "6 3", new_line.size() == 1}};
    figure.x = plots::axis_around(along, "m", xs);
    figure.y = plots::axis_around(what, unit, ys, scale, scale == plots::Scale::linear);
    drive.figures.push_back({fmt::format("{}_{}", name, drive.name), title + ": " + figure.subtitle, figure});
}

plots::Polyline line_of(const std::vector<double>& x, const std::vector<double>& y) {
    plots::Polyline line;
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
        line.push_back({x[i], y[i]});
    return line;
}

void add_reaches(DriveComparison& drive) {
    for (const ReachOverDrive& now : drive.now.reaches) {
        const auto old = std::ranges::find(drive.before.reaches, now.key, &ReachOverDrive::key);
        if (old != drive.before.reaches.end())
            add_lines(drive, name_of(now.key), capitalised(reading_label(now.key)), line_of(old->distance_m, old->reach_m),
                      line_of(now.distance_m, now.reach_m), "along the route", "reach", "m", plots::Scale::linear);
    }
}

void add_glares(DriveComparison& drive) {
    for (const GlareOverDrive& now : drive.now.glares) {
        const auto old = std::ranges::find(drive.before.glares, now.eye, &GlareOverDrive::eye);
        const std::string eye = eye_name(now.eye);
        if (old != drive.before.glares.end())
            add_lines(drive, "glare-" + file_name_of(eye), "Facing illuminance, " + short_text(eye, 40), line_of(old->at_m, old->facing_lx),
                      line_of(now.at_m, now.facing_lx), now.over, "illuminance", "lx", plots::Scale::logarithmic);
    }
}

void add_maps(DriveComparison& drive, const RunComparison& runs, const FramePair& frame) {
    const auto before = stored_lux_map(runs.before.folder / frame.old_frame.exr, frame.old_frame, frame.view);
    const auto now = stored_lux_map(runs.now.folder / frame.new_frame.exr, frame.new_frame, frame.view);
    if (!before || !now)
        return;
    const std::string name = fmt::format("{}_{}-{:06}", drive.name, file_name_of(frame.new_frame.view), frame.new_frame.tick);
    const std::string old_label = short_text(drive.old_label(), 40), new_label = short_text(drive.new_label(), 40);
    const std::string place = short_text(drive.now.title, 60);
    const std::string lines = "Isolux lines from above: " + place, ratio = new_label + " over " + old_label + ": " + place;
    if (auto figure = lux_lines_figure(*now, *before, lines, new_label, old_label))
        drive.figures.push_back({"lux-lines_" + name, lines, std::move(*figure)});
    if (auto figure = lux_ratio_figure(*now, *before, ratio))
        drive.figures.push_back({"lux-ratio_" + name, ratio, std::move(*figure)});
}

/// The moments of a view to be drawn: `pictured` of those that differ, evenly spread, and the one that differs most.
std::set<int> drawn_moments(const DriveComparison& drive, const std::string& view, std::size_t pictured) {
    std::vector<int> ticks;
    double worst = 0.0;
    int worst_tick = -1;
    for (const FramePair& frame : drive.frames) {
        if (frame.new_frame.view != view || frame.is_equal())
            continue;
        if (ticks.empty() || ticks.back() != frame.new_frame.tick)
            ticks.push_back(frame.new_frame.tick);
        for (const LayerComparison& layer : frame.comparison.layers)
            if (const double rmse = value_in(layer, "rmse").value_or(0.0); layer.name == "illuminance.lx" && rmse > worst) {
                worst = rmse;
                worst_tick = frame.new_frame.tick;
            }
    }
    std::set<int> drawn;
    if (pictured == 1 && !ticks.empty())
        drawn.insert(worst_tick >= 0 ? worst_tick : ticks.front());
    if (pictured > 1)
        for (const std::size_t i : spread_over(ticks.size(), pictured))
            drawn.insert(ticks[i]);
    if (worst_tick >= 0 && pictured > 0)
        drawn.insert(worst_tick);
    return drawn;
}

void draw_frames(DriveComparison& drive, const RunComparison& runs, const RunCompareOptions& options, std::size_t pictured,
                 const TakePlot& take) {
    std::map<std::string, std::set<int>> drawn;
    for (FramePair& frame : drive.frames) {
        const std::string& view = frame.new_frame.view;
        if (!drawn.contains(view))
            drawn[view] = drawn_moments(drive, view, pictured);
        if (!drawn[view].contains(frame.new_frame.tick) || frame.is_equal())
            continue;
        const PicturePair pair = frame_pictures(frame, runs);
        const PictureComparison comparison = compare_pictures(pair, frame_density(frame, options), options.strictness);
        const std::string folder = fmt::format("frames/{}/{}-{:06}/", drive.name, file_name_of(view), frame.new_frame.tick);
        frame.pictures = draw_difference(comparison, pair, [&](Plot plot) {
            plot.name = folder + plot.name;
            take(plot);
        });
        for (std::string& file : frame.pictures)
            file = folder + file;
        if (!frame.is_display && frame.view.projection == Projection::map)
            add_maps(drive, runs, frame);
    }
}

} // namespace

void draw_runs(RunComparison& runs, const RunCompareOptions& options, std::size_t pictured, const TakePlot& take) {
    for (DriveComparison& drive : runs.drives) {
        add_reaches(drive);
        add_glares(drive);
        draw_frames(drive, runs, options, pictured, take);
    }
}

} // namespace fernlicht
