#include "runner/findings/lux_figure.h"

#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
namespace {

std::vector<double> centres(double from, double to, int count) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i)
        out.push_back(from + (to - from) * (i + 0.5) / count);
    return out;
}

} // namespace

plots::Figure figure_over(const LuxMap& map, const std::string& title) {
    plots::Figure figure;
    figure.title = title;
    figure.x = {"ahead of the car's origin", "m", -map.behind_m, map.ahead_m};
    figure.y = {"to the left", "m", -map.right_m, map.left_m};
    figure.width_px = 1140.0;
    // About 150 px go to the axis and a colour bar beside the picture, 130 to headings and axis above and below it.
    figure.height_px = std::clamp(130.0 + 990.0 * (map.left_m + map.right_m) / (map.ahead_m + map.behind_m), 300.0, 900.0);
    figure.equal_units = true;
    return figure;
}

plots::Grid grid_of(const LuxMap& map) {
    const int ahead = map.lx.height(), across = map.lx.width();
    plots::Grid grid{centres(-map.behind_m, map.ahead_m, ahead), centres(map.left_m, -map.right_m, across), {}};
    for (int k = 0; k < across; ++k)
        for (int i = 0; i < ahead; ++i)
            grid.values.push_back(static_cast<double>(map.lx.at(k, ahead - 1 - i)));
    return grid;
}

void add_edges(plots::Figure& figure, const LuxMap& map, plots::Colour colour) {
    std::set<std::string> named;
    for (const LuxMap::Polyline& edge : map.edges) {
        const bool car = edge.kind == "car";
        plots::Series line;
        line.name = !car && named.insert(edge.kind).second ? short_text(edge.kind, 30) : "";
        for (const auto& [ahead_m, left_m] : edge.ahead_left_m)
            line.points.push_back({ahead_m, left_m});
        line.colour = colour;
        line.width_px = car ? 1.6 : edge.kind == "road edge" ? 1.1 : 0.8;
        line.dash = edge.kind == "lane edge" ? "7 5" : "";
        figure.series.push_back(std::move(line));
    }
}

std::optional<plots::Figure> lux_map_figure(const LuxMap& map, const std::string& lamp) {
    if (map.lx.empty() || !(map.ahead_m > -map.behind_m) || !(map.left_m > -map.right_m))
        return std::nullopt;
    const plots::Axis scale{"illuminance on the road", "lx", 0.1, 100.0, plots::Scale::logarithmic, {}};
    plots::Figure drawn = figure_over(map, short_text(lamp, 60));
    drawn.subtitle = fmt::format("lux on the road after {} s; lines at 1, 3, 5, 10, 30 and 50 lx", figure(map.time_s, 2));
    Image<float> lx(map.lx.height(), map.lx.width()); // ahead to the right
    for (int y = 0; y < map.lx.height(); ++y)
        for (int x = 0; x < map.lx.width(); ++x)
            lx.at(map.lx.height() - 1 - y, x) = map.lx.at(x, y);
    drawn.rasters.push_back({plots::heat_map(lx, scale), -map.behind_m, map.ahead_m, map.left_m, -map.right_m});
    const plots::Grid grid = grid_of(map);
    for (const double level : isolux_lines_lx) {
        const bool dark = plots::luminance(plots::sequential(plots::position(scale, level))) < 0.35;
        drawn.isolines.push_back({fmt::format("{:g}", level), plots::isolines(grid, level),
                                  dark ? plots::Colour{255, 255, 255} : plots::Colour{24, 24, 32}, 1.3});
    }
    add_edges(drawn, map, {205, 210, 218});
    drawn.colour_bar = plots::ColourBar{scale};
    return drawn;
}

} // namespace fernlicht
