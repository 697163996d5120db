#include "runner/experiments/compare/runs/lux_ratio.h"

#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/files/picture_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr double faintest_lx = 0.1;

bool is_of_one_size(const LuxMap& a, const LuxMap& b) { return a.lx.width() == b.lx.width() && a.lx.height() == b.lx.height(); }

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

std::optional<plots::Figure> lux_ratio_figure(const LuxMap& now, const LuxMap& before, const std::string& title) {
    if (!is_of_one_size(now, before))
        return std::nullopt;
    Image<float> ratio(now.lx.height(), now.lx.width());
    for (int y = 0; y < now.lx.height(); ++y)
        for (int x = 0; x < now.lx.width(); ++x) {
            const double a = static_cast<double>(now.lx.at(x, y)), b = static_cast<double>(before.lx.at(x, y));
            const bool lit = std::max(a, b) >= faintest_lx;
            ratio.at(now.lx.height() - 1 - y, x) =
                lit ? static_cast<float>(std::max(a, 1e-6) / std::max(b, 1e-6)) : std::numeric_limits<float>::quiet_NaN();
        }
    const plots::Axis axis = ratio_axis(ratio);
    plots::Figure figure = figure_over(now, title);
    figure.subtitle =
        fmt::format("after {:.2f} s; blue is less, orange more light; grey: below {:g} lx with both", now.time_s, faintest_lx);
    figure.colour_bar = plots::ColourBar{axis, true};
    figure.rasters.push_back({plots::difference_map(ratio, axis, {225, 225, 225}), -now.behind_m, now.ahead_m, now.left_m, -now.right_m});
    add_edges(figure, now, {90, 95, 105});
    return figure;
}

std::optional<plots::Figure> lux_lines_figure(const LuxMap& now, const LuxMap& before, const std::string& title,
                                              const std::string& now_name, const std::string& before_name) {
    if (!is_of_one_size(now, before))
        return std::nullopt;
    plots::Figure figure = figure_over(lit_part(now, before), title);
    figure.subtitle = fmt::format("lux on the road after {:.2f} s; lines at 1, 3, 5, 10, 30 and 50 lx", now.time_s);
    const plots::Colour old_colour = plots::series_colour(0), new_colour = plots::series_colour(1);
    figure.series = {{.name = before_name, .colour = old_colour}, {.name = now_name, .colour = new_colour, .dash = "6 3"}};
    const plots::Grid old_grid = grid_of(before), new_grid = grid_of(now);
    for (const double level : isolux_lines_lx) {
        figure.isolines.push_back({fmt::format("{:g}", level), plots::isolines(old_grid, level), old_colour, 1.4, ""});
        figure.isolines.push_back({fmt::format("{:g}", level), plots::isolines(new_grid, level), new_colour, 1.6, "6 3"});
    }
    figure.notes.push_back({0.0, 0.0, "car", {40, 40, 40}, true});
    return figure;
}

} // namespace fernlicht
