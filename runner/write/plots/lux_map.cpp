#include "runner/write/plots/lux_map.h"

#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace fernlicht::plots {
namespace {

constexpr double lux_map_width_px = 1140.0;
constexpr Colour on_dark{255, 255, 255}, on_light{24, 24, 32};

/// Maps lie with row 0 farthest ahead; the figure has "ahead" to the right.
Image<float> turned(const Image<float>& lx) {
    Image<float> out(lx.height(), lx.width());
    for (int y = 0; y < lx.height(); ++y)
        for (int x = 0; x < lx.width(); ++x)
            out.at(lx.height() - 1 - y, x) = lx.at(x, y);
    return out;
}

std::vector<double> centres(double from, double to, int count) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i)
        out.push_back(from + (to - from) * (i + 0.5) / count);
    return out;
}

Grid grid_of(const LuxMap& map, const Image<float>& lx) {
    Grid grid{centres(-map.behind_m, map.ahead_m, lx.width()), centres(map.left_m, -map.right_m, lx.height()), {}};
    grid.values.assign(lx.pixels().begin(), lx.pixels().end());
    return grid;
}

} // namespace

void add_edges(Figure& figure, const LuxMap& map, Colour colour) {
    std::set<std::string> named;
    for (const LuxMap::Polyline& edge : map.edges) {
        const bool car = edge.kind == "car";
        Series line;
        line.name = !car && named.insert(edge.kind).second ? short_text(edge.kind, 30) : "";
        for (const auto& [ahead_m, left_m] : edge.ahead_left_m)
            line.points.push_back({ahead_m, left_m});
        line.colour = colour;
        line.width_px = car ? 1.6 : edge.kind == "road edge" ? 1.1 : 0.8;
        line.dash = edge.kind == "lane edge" ? "7 5" : "";
        figure.series.push_back(std::move(line));
    }
}

std::string lux_map_svg(const LuxMap& map, const std::string& lamp) {
    if (map.lx.empty() || !(map.ahead_m > -map.behind_m) || !(map.left_m > -map.right_m))
        return {};
    const Axis scale{"illuminance on the road", "lx", 0.1, 100.0, Scale::logarithmic, {}};
    Figure figure;
    figure.title = short_text(lamp, 60);
    figure.subtitle = fmt::format("lux on the road after {} s; lines at 1, 3, 5, 10, 30 and 50 lx", fernlicht::figure(map.time_s, 2));
    figure.x = {"ahead of the car's origin", "m", -map.behind_m, map.ahead_m, Scale::linear, {}};
    figure.y = {"to the left", "m", -map.right_m, map.left_m, Scale::linear, {}};
    figure.width_px = lux_map_width_px;
    // About 150 px go to the axis and the colour bar beside the picture, 130 to headings and axis above and below it.
    figure.height_px =
        std::clamp(130.0 + (lux_map_width_px - 150.0) * (map.left_m + map.right_m) / (map.ahead_m + map.behind_m), 300.0, 900.0);
    figure.equal_units = true;
    const Image<float> lx = turned(map.lx);
    figure.rasters.push_back({heat_map(lx, scale), -map.behind_m, map.ahead_m, map.left_m, -map.right_m});
    const Grid grid = grid_of(map, lx);
    for (const double level : {1.0, 3.0, 5.0, 10.0, 30.0, 50.0}) {
        const bool dark = luminance(sequential(position(scale, level))) < 0.35;
        figure.isolines.push_back({fmt::format("{:g}", level), isolines(grid, level), dark ? on_dark : on_light, 1.3});
    }
    add_edges(figure, map, {205, 210, 218});
    figure.colour_bar = ColourBar{scale};
    return svg_of(figure);
}

} // namespace fernlicht::plots
