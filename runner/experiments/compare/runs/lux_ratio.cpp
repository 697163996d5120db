#include "runner/experiments/compare/runs/lux_ratio.h"

#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/files/picture_file.h"
#include "runner/write/plots/lux_map.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr double faintest_lx = 0.1;

bool is_of_one_size(const LuxMap& a, const LuxMap& b) { return a.lx.width() == b.lx.width() && a.lx.height() == b.lx.height(); }

/// Axes in metres, ahead to the right.
plots::Figure figure_of(const LuxMap& map, const std::string& title) {
    plots::Figure figure;
    figure.title = title;
    figure.x = {"ahead of the car's origin", "m", -map.behind_m, map.ahead_m};
    figure.y = {"to the left", "m", -map.right_m, map.left_m};
    figure.width_px = 1140.0;
    figure.height_px = std::clamp(130.0 + 990.0 * (map.left_m + map.right_m) / (map.ahead_m + map.behind_m), 300.0, 900.0);
    figure.equal_units = true;
    return figure;
}

/// The window of a map, without pixels, that has all of 1 lx and more of either, the car and some room; the whole one without such light.
LuxMap lit_part(const LuxMap& a, const LuxMap& b) {
    double ahead = -a.behind_m, behind = -a.ahead_m, left = -a.right_m, right = -a.left_m;
    const int rows = a.lx.height(), columns = a.lx.width();
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            if (std::max(a.lx.at(x, y), b.lx.at(x, y)) < 1.0F)
                continue;
            const double ahead_m = a.ahead_m - (a.ahead_m + a.behind_m) * (y + 0.5) / rows;
            const double left_m = a.left_m - (a.left_m + a.right_m) * (x + 0.5) / columns;
            ahead = std::max(ahead, ahead_m);
            behind = std::max(behind, -ahead_m);
            left = std::max(left, left_m);
            right = std::max(right, -left_m);
        }
    constexpr double room_m = 5.0;
    LuxMap part;
    part.ahead_m = std::min(a.ahead_m, std::max(ahead, 0.0) + room_m);
    part.behind_m = std::min(a.behind_m, std::max(behind, 0.0) + room_m);
    part.left_m = std::min(a.left_m, std::max(left, 0.0) + room_m);
    part.right_m = std::min(a.right_m, std::max(right, 0.0) + room_m);
    return ahead > -a.behind_m ? part : a;
}

/// The map's samples over the figure's axes; row 0 of a map lies farthest ahead.
plots::Grid grid_of(const LuxMap& map) {
    plots::Grid grid;
    const int ahead = map.lx.height(), across = map.lx.width();
    for (int i = 0; i < ahead; ++i)
        grid.x.push_back(-map.behind_m + (map.ahead_m + map.behind_m) * (i + 0.5) / ahead);
    for (int k = 0; k < across; ++k)
        grid.y.push_back(map.left_m - (map.left_m + map.right_m) * (k + 0.5) / across);
    for (int k = 0; k < across; ++k)
        for (int i = 0; i < ahead; ++i)
            grid.values.push_back(static_cast<double>(map.lx.at(k, ahead - 1 - i)));
    return grid;
}

} // namespace

std::optional<LuxMap> stored_lux_map(const std::filesystem::path& exr, const StoredFrame& frame, const View& view) {
    for (PictureChannel& channel : read_exr(exr))
        if (channel.name == "illuminance.lx")
            return LuxMap{std::move(channel.values),
                          view.map_ahead_m,
                          view.map_behind_m,
                          view.map_left_m,
                          view.map_right_m,
                          {},
                          frame.tick,
                          frame.time_s};
    return std::nullopt;
}

std::string lux_ratio_svg(const LuxMap& now, const LuxMap& before, const std::string& title) {
    if (!is_of_one_size(now, before))
        return {};
    Image<float> ratio(now.lx.height(), now.lx.width());
    for (int y = 0; y < now.lx.height(); ++y)
        for (int x = 0; x < now.lx.width(); ++x) {
            const double a = static_cast<double>(now.lx.at(x, y)), b = static_cast<double>(before.lx.at(x, y));
            const bool lit = std::max(a, b) >= faintest_lx;
            ratio.at(now.lx.height() - 1 - y, x) =
                lit ? static_cast<float>(std::max(a, 1e-6) / std::max(b, 1e-6)) : std::numeric_limits<float>::quiet_NaN();
        }
    const plots::Axis axis = ratio_axis(ratio);
    plots::Figure figure = figure_of(now, title);
    figure.subtitle =
        fmt::format("after {:.2f} s; blue is less, orange more light; grey: below {:g} lx with both", now.time_s, faintest_lx);
    figure.colour_bar = plots::ColourBar{axis, true};
    figure.rasters.push_back({plots::difference_map(ratio, axis, {225, 225, 225}), -now.behind_m, now.ahead_m, now.left_m, -now.right_m});
    plots::add_edges(figure, now, {90, 95, 105});
    return plots::svg_of(figure);
}

std::string lux_lines_svg(const LuxMap& now, const LuxMap& before, const std::string& title, const std::string& now_name,
                          const std::string& before_name) {
    if (!is_of_one_size(now, before))
        return {};
    plots::Figure figure = figure_of(lit_part(now, before), title);
    figure.subtitle = fmt::format("lux on the road after {:.2f} s; lines at 1, 3, 5, 10, 30 and 50 lx", now.time_s);
    const plots::Colour old_colour = plots::series_colour(0), new_colour = plots::series_colour(1);
    figure.series = {{.name = before_name, .colour = old_colour}, {.name = now_name, .colour = new_colour, .dash = "6 3"}};
    const plots::Grid old_grid = grid_of(before), new_grid = grid_of(now);
    for (const double level : {1.0, 3.0, 5.0, 10.0, 30.0, 50.0}) {
        figure.isolines.push_back({fmt::format("{:g}", level), plots::isolines(old_grid, level), old_colour, 1.4, ""});
        figure.isolines.push_back({fmt::format("{:g}", level), plots::isolines(new_grid, level), new_colour, 1.6, "6 3"});
    }
    figure.notes.push_back({0.0, 0.0, "car", {40, 40, 40}, true});
    return plots::svg_of(figure);
}

} // namespace fernlicht
