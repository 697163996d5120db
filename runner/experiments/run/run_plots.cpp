#include "runner/experiments/run/run_plots.h"

#include "runner/files/clean_text.h"
#include "runner/files/output_folder.h"
#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>

namespace fernlicht {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(); // what plots leave out

plots::Colour darker(plots::Colour colour) {
    const auto half = [](std::uint8_t channel) { return static_cast<std::uint8_t>(channel / 2); };
    return {half(colour.r), half(colour.g), half(colour.b)};
}

/// A car that stands still, if only for a while, has no use for distance as its axis: all of that while would fall on one point. Neither
/// has one on springs, whose beam swings in time.
bool by_distance(const ComparedDrive& drive) {
    constexpr double standing_m = 1e-3; // from one moment to the next
    double farthest_m = 0.0;
    for (const PlayedCell* const played : drive.lamp_sets) {
        if (!played->car.empty())
            return false;
        for (std::size_t i = 0; i < played->extents.size(); ++i) {
            farthest_m = std::max(farthest_m, played->extents[i].distance_m);
            if (i > 0 && played->extents[i].distance_m - played->extents[i - 1].distance_m < standing_m)
                return false;
        }
    }
    return farthest_m > 1.0;
}

plots::Polyline reach_line(const PlayedCell& played, std::vector<LaneExtent> ExtentRow::*source, const ExtentKey& key, bool distance) {
    plots::Polyline line;
    for (const ExtentRow& row : played.extents) {
        const LaneExtent* const extent = find_extent(row.*source, key);
        line.push_back({distance ? row.distance_m : row.time_s, extent ? extent->reach_centre_m : not_a_number});
    }
    return line;
}

plots::Band aim_band(const PlayedCell& played, const ExtentKey& key, const plots::Polyline& reach) {
    plots::Band band;
    for (std::size_t i = 0; i < reach.size(); ++i) {
        const NudgedExtents& twin = played.extents[i].nudged;
        const auto moved_m = [&](NudgeKind kind) {
            const LaneExtent *const as_is = find_extent(twin.as_is, key), *const nudged =
                                                                              find_extent(twin.nudged[static_cast<std::size_t>(kind)], key);
            return as_is && nudged && !as_is->reach_is_cut_off && !nudged->reach_is_cut_off ? nudged->reach_centre_m - as_is->reach_centre_m
                                                                                            : not_a_number;
        };
        if (twin.as_is.empty())
            continue; // not a moment that tells
        const double up_m = moved_m(NudgeKind::aim_up), down_m = moved_m(NudgeKind::aim_down);
        band.x.push_back(reach[i].x);
        band.low.push_back(std::max(0.0, reach[i].y + std::min(up_m, down_m)));
        band.high.push_back(reach[i].y + std::max(up_m, down_m));
    }
    return band;
}

bool has_value(const plots::Polyline& line) {
    return std::any_of(line.begin(), line.end(), [](const plots::Point& point) { return std::isfinite(point.y); });
}

void set_axes(plots::Figure& figure, const std::string& x_label, const std::string& x_unit, const std::string& y_label,
              const std::string& y_unit) {
    std::vector<double> x, y;
    for (const plots::Series& series : figure.series)
        for (const plots::Point& point : series.points) {
            x.push_back(point.x);
            y.push_back(point.y);
        }
    for (const plots::Band& band : figure.bands)
        y.insert(y.end(), band.high.begin(), band.high.end());
    figure.x = plots::axis_around(x_label, x_unit, x);
    figure.y = plots::axis_around(y_label, y_unit, y, plots::Scale::linear, true);
    // Zero to the last sample fills the plot; round ends would leave it half empty.
    if (const double last = *std::max_element(x.begin(), x.end()), first = *std::min_element(x.begin(), x.end()); last > first) {
        figure.x.from = first;
        figure.x.to = last;
    }
}

/// One quantity of the car over time. `value`: none where a lamp set has no such actuator.
std::optional<plots::Figure> car_figure(const ComparedDrive& drive, const char* title, const char* label, const char* unit,
                                        const std::function<std::optional<double>(const CarRow&)>& value) {
    plots::Figure figure;
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        plots::Series series{short_text(drive.lamp_sets[i]->lamp_set, 24), {}, plots::lamp_colour(i), 1.6, "", false};
        for (const CarRow& row : drive.lamp_sets[i]->car)
            if (const std::optional<double> found = value(row))
                series.points.push_back({row.time_s, *found});
        series.markers = series.points.size() == 1;
        if (!series.points.empty())
            figure.series.push_back(std::move(series));
    }
    if (figure.series.empty())
        return std::nullopt;
    const plots::Polyline& first = figure.series.front().points;
    const bool alike =
        figure.series.size() == drive.lamp_sets.size() && std::ranges::all_of(figure.series, [&](const plots::Series& series) {
            return std::ranges::equal(series.points, first,
                                      [](const plots::Point& a, const plots::Point& b) { return a.x == b.x && a.y == b.y; });
        });
    if (alike) {
        figure.series.resize(1);
        figure.series.front().name.clear();
        figure.series.front().colour = {60, 60, 60};
    }
    figure.title = title;
    figure.width_px = 640.0;
    figure.height_px = 240.0;
    set_axes(figure, "time", "s", label, unit);
    return figure;
}

/// Light from far away and light that is none look alike on a page: nothing below this share of the largest value is drawn.
constexpr double min_share = 1e-4;

plots::Polyline line_of(const SeeingSeries& series, const SeeingSeries::Column& column) {
    plots::Polyline line;
    double largest = 0.0;
    for (const Value& value : column.values)
        largest = std::max(largest, value.figure().value_or(0.0));
    for (std::size_t i = 0; i < series.at_m.size(); ++i) {
        const std::optional<double> value = column.values[i].figure();
        const bool shown = value && (!column.logarithmic || *value >= min_share * largest);
        line.push_back({series.at_m[i], shown ? *value : not_a_number});
    }
    return line;
}

std::optional<plots::Figure> figure_of(const ComparedDrive& drive, const SeeingSeries& subject, std::size_t column) {
    const SeeingSeries::Column& what = subject.columns[column];
    plots::Figure figure;
    std::vector<double> x, y;
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const auto series = std::ranges::find(drive.lamp_sets[i]->seeing, subject.subject, &SeeingSeries::subject);
        if (series == drive.lamp_sets[i]->seeing.end() || column >= series->columns.size())
            continue;
        plots::Polyline line = line_of(*series, series->columns[column]);
        for (const plots::Point& point : line)
            if (std::isfinite(point.y)) {
                x.push_back(point.x);
                y.push_back(point.y);
            }
        figure.series.push_back(
            {short_text(drive.lamp_sets[i]->lamp_set, 24), std::move(line), plots::lamp_colour(i), 2.0, "", series->at_m.size() == 1});
    }
    if (y.empty())
        return std::nullopt;
    figure.title = short_text(subject.title, 60) + ": " + short_text(what.label, 60);
    figure.width_px = 640.0;
    figure.height_px = 300.0;
    figure.x = plots::axis_around(subject.over, "m", x);
    const bool logarithmic = what.logarithmic && *std::ranges::max_element(y) > 0.0;
    figure.y = plots::axis_around(what.label, what.unit, y, logarithmic ? plots::Scale::logarithmic : plots::Scale::linear, !logarithmic);
    return figure;
}

std::vector<plots::Figure> figures_of(const ComparedDrive& drive, bool control) {
    std::vector<plots::Figure> figures;
    for (const SeeingSeries& subject : drive.lamp_sets.front()->seeing)
        for (std::size_t column = 0; (subject.subject == "control") == control && column < subject.columns.size(); ++column)
            if (subject.columns[column].drawn)
                if (std::optional<plots::Figure> figure = figure_of(drive, subject, column))
                    figures.push_back(std::move(*figure));
    return figures;
}

} // namespace

void add_plot(Section& section, const std::string& name, std::optional<plots::Figure> figure) {
    if (figure)
        section.blocks.emplace_back(Plot{.name = name, .figure = std::move(*figure), .beside = true});
}

void add_plots(Section& section, const std::string& name, std::vector<plots::Figure> figures) {
    for (std::size_t i = 0; i < figures.size(); ++i)
        add_plot(section, fmt::format("{}-{}", name, i + 1), std::move(figures[i]));
}

std::vector<double> plotted_thresholds_lx(const ComparedDrive& drive) {
    std::vector<double> limits;
    for (const PlayedCell* const played : drive.lamp_sets)
        for (const ExtentKey& key : extent_keys(*played))
            if (key.lane == "own")
                limits.push_back(key.threshold_lx);
    std::sort(limits.begin(), limits.end());
    limits.erase(std::unique(limits.begin(), limits.end()), limits.end());
    std::vector<double> usual;
    for (const double threshold_lx : {1.0, 5.0})
        if (std::binary_search(limits.begin(), limits.end(), threshold_lx))
            usual.push_back(threshold_lx);
    if (!usual.empty() || limits.size() < 2)
        return usual.empty() ? limits : usual;
    return {limits.front(), limits.back()};
}

std::optional<plots::Figure> reach_figure(const ComparedDrive& drive, Surface surface, double threshold_lx) {
    const ExtentKey key{surface, "own", threshold_lx};
    const bool distance = by_distance(drive);
    plots::Figure figure;
    bool measured = false;
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const PlayedCell& played = *drive.lamp_sets[i];
        const std::string name = short_text(played.lamp_set, 24);
        plots::Polyline rendered = reach_line(played, &ExtentRow::rendered, key, distance),
                        twin = reach_line(played, &ExtentRow::twin, key, distance);
        measured = measured || has_value(rendered) || has_value(twin);
        plots::Band band = aim_band(played, key, has_value(rendered) ? rendered : twin);
        band.colour = plots::lamp_colour(i);
        band.opacity = 0.16;
        figure.bands.push_back(std::move(band));
        const bool lone = played.extents.size() == 1;
        if (has_value(rendered))
            figure.series.push_back({name, std::move(rendered), plots::lamp_colour(i), 2.2, "", lone});
        if (has_value(twin))
            figure.series.push_back({name + ", twin", std::move(twin), darker(plots::lamp_colour(i)), 1.1, "2 4", lone});
    }
    if (!measured)
        return std::nullopt;
    figure.title = fmt::format("Reach at {:g} lx on {}", threshold_lx, surface == Surface::road ? "the road" : "a facing target");
    figure.width_px = 640.0;
    figure.height_px = 340.0;
    set_axes(figure, distance ? "distance along the route" : "time", distance ? "m" : "s", "reach, own lane", "m");
    return figure;
}

std::optional<plots::Figure> speed_figure(const ComparedDrive& drive) {
    plots::Figure figure;
    plots::Series speed;
    speed.colour = {60, 60, 60};
    for (const auto& [time_s, mps] : drive.lamp_sets.front()->speed_mps)
        speed.points.push_back({time_s, mps * 3.6});
    if (!has_value(speed.points))
        return std::nullopt;
    speed.markers = speed.points.size() == 1;
    figure.series.push_back(std::move(speed));
    figure.title = "Speed";
    figure.width_px = 640.0;
    figure.height_px = 240.0;
    set_axes(figure, "time", "s", "speed", "km/h");
    return figure;
}

std::vector<plots::Figure> car_figures(const ComparedDrive& drive) {
    std::vector<plots::Figure> figures;
    for (auto& figure :
         {car_figure(drive, "Pitch of the body against the road", "pitch, nose up", "deg", [](const CarRow& row) { return row.pitch_deg; }),
          car_figure(drive, "Roll of the body against the road", "roll, left side up", "deg",
                     [](const CarRow& row) { return row.roll_deg; }),
          car_figure(drive, "Lift of the body over the rear axle", "lift", "mm", [](const CarRow& row) { return row.rear_lift_mm; }),
          car_figure(drive, "Levelling", "lamps up", "deg", [](const CarRow& row) { return row.levelling_deg; }),
          car_figure(drive, "Swivel", "lamps to the left", "deg", [](const CarRow& row) { return row.swivel_deg; })})
        if (figure)
            figures.push_back(*figure);
    return figures;
}

std::optional<plots::Figure> timing_figure(const ComparedDrive& drive) {
    plots::Figure figure;
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i)
        for (const PassTime& pass : drive.lamp_sets[i]->passes) {
            if (pass.name != "frame" || pass.seconds.empty())
                continue;
            plots::Series series{
                short_text(drive.lamp_sets[i]->lamp_set, 24), {}, plots::lamp_colour(i), 1.3, "", pass.seconds.size() == 1};
            for (std::size_t k = 0; k < pass.seconds.size(); ++k)
                series.points.push_back({static_cast<double>(k + 1), 1e3 * pass.seconds[k]});
            figure.series.push_back(std::move(series));
            plots::Mark median;
            median.value = 1e3 * spread_of(pass.seconds)->median;
            median.colour = plots::lamp_colour(i);
            figure.marks.push_back(median);
        }
    if (figure.series.empty())
        return std::nullopt;
    figure.title = "Time per frame";
    figure.subtitle = "frames rendered with nothing beside them; broken lines: medians";
    figure.width_px = 640.0;
    figure.height_px = 340.0;
    set_axes(figure, "sample", "", "time", "ms");
    return figure;
}

std::optional<plots::Figure> error_figure(const ComparedDrive& drive) {
    plots::Figure figure;
    std::vector<double> times, errors;
    double floor = 0.0;
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        const PlayedCell& played = *drive.lamp_sets[i];
        const auto pass = std::ranges::find(played.passes, std::string("frame"), &PassTime::name);
        if (!played.error.road || played.error.road->pixels == 0 || pass == played.passes.end())
            continue;
        const auto time = spread_of(pass->seconds);
        const PixelErrors& road = *played.error.road;
        if (!time)
            continue;
        const auto [least, most] = std::ranges::minmax(played.error.road_p95);
        const double x = 1e3 * time->median, claimed = 100.0 * std::max(road.error.p95, road.floor.p95);
        floor = std::max(floor, 100.0 * road.floor.p95);
        const double low = std::min(claimed, 100.0 * std::max(least, road.floor.p95)), high = std::max(claimed, 100.0 * most);
        figure.series.push_back(
            {"", {{1e3 * time->minimum, claimed}, {1e3 * time->maximum, claimed}}, plots::lamp_colour(i), 1.2, "", false});
        figure.series.push_back({"", {{x, low}, {x, high}}, plots::lamp_colour(i), 1.2, "", false});
        figure.series.push_back({short_text(played.lamp_set, 24), {{x, claimed}}, plots::lamp_colour(i), 1.2, "", true});
        times.insert(times.end(), {1e3 * time->minimum, 1e3 * time->maximum});
        errors.insert(errors.end(), {low, high});
    }
    if (figure.series.empty() || *std::ranges::max_element(errors) <= 0.0)
        return std::nullopt;
    figure.title = fmt::format("Error against run time: {}", short_text(drive.lamp_sets.front()->technique, 24));
    figure.width_px = 640.0;
    figure.height_px = 300.0;
    figure.x = plots::axis_around("time a frame, driver's view alone", "ms", times, plots::Scale::logarithmic);
    if (floor > 0.0)
        errors.push_back(0.5 * floor);
    figure.y = plots::axis_around("lux error on the road, 95 %", "%", errors, plots::Scale::logarithmic);
    if (floor > 0.0)
        figure.bands.push_back({"below the reference's noise",
                                {figure.x.from, figure.x.to},
                                {figure.y.from, figure.y.from},
                                {floor, floor},
                                {150, 156, 163},
                                0.35});
    return figure;
}

std::string levels_name(const PlayedCell& played) { return "levels-" + file_name_of(played.drive + "-" + played.lamp_set); }

std::vector<Plot> level_plots(const PlayedCell& played) {
    std::vector<Plot> drawn;
    for (const PixelLevels& lamp : played.pixel_levels)
        if (std::optional<plots::Figure> figure = levels_figure(lamp, played.lamp_set))
            drawn.push_back({.name = levels_name(played) + "-" + file_name_of(lamp.lamp), .figure = std::move(*figure), .beside = true});
    return drawn;
}

std::vector<plots::Figure> seeing_figures(const ComparedDrive& drive) { return figures_of(drive, false); }
std::vector<plots::Figure> control_figures(const ComparedDrive& drive) { return figures_of(drive, true); }

} // namespace fernlicht
