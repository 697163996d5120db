#include "runner/findings/lux_figure.h"

#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/findings/lux_codes.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
namespace {

const plots::Axis lux_scale{"illuminance on the road", "lx", 0.1, 100.0, plots::Scale::logarithmic, {}};

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

Image<float> ahead_to_the_right(const Image<float>& lx) {
    Image<float> turned(lx.height(), lx.width());
    for (int y = 0; y < lx.height(); ++y)
        for (int x = 0; x < lx.width(); ++x)
            turned.at(lx.height() - 1 - y, x) = lx.at(x, y);
    return turned;
}

Image<plots::Colour> lux_picture(const Image<std::uint8_t>& codes) {
    Image<float> lx(codes.width(), codes.height());
    for (int y = 0; y < codes.height(); ++y)
        for (int x = 0; x < codes.width(); ++x)
            lx.at(x, y) = static_cast<float>(lux_of(codes.at(x, y)));
    return plots::heat_map(lx, lux_scale);
}

std::optional<plots::Figure> isolux_figure(const std::vector<const LuxMap*>& maps, const std::vector<std::string>& lamps) {
    const LuxMap& first = *maps.front();
    std::optional<plots::Figure> drawn = lux_map_figure(first, lamps.front());
    if (!drawn)
        return std::nullopt;
    drawn->title.clear();
    drawn->width_px = 600.0;
    drawn->height_px = std::clamp(82.0 + 530.0 * (first.left_m + first.right_m) / (first.ahead_m + first.behind_m), 190.0, 420.0);
    if (maps.size() == 1) {
        drawn->subtitle = "lux on the road, 0.1 to 100 lx";
        drawn->colour_bar.reset();
        return drawn;
    }
    drawn->subtitle = "lines of 1, 5 and 20 lx on the road";
    drawn->height_px += 20.0;
    drawn->colour_bar.reset();
    drawn->rasters.clear();
    drawn->isolines.clear();
    drawn->series.clear();
    drawn->background = {252, 252, 252};
    add_edges(*drawn, first, {150, 156, 163});
    for (plots::Series& edge : drawn->series)
        edge.name.clear();
    static constexpr const char* dashes[] = {"", "7 3", "2 2", "9 3 2 3"};
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const plots::Colour colour = plots::lamp_colour(i);
        const std::string dash = dashes[i % std::size(dashes)];
        drawn->series.push_back({lamps[i], {}, colour, 1.6, dash});
        const plots::Grid grid = grid_of(*maps[i]);
        for (const double level : {1.0, 5.0, 20.0})
            drawn->isolines.push_back({fmt::format("{:g}", level), plots::isolines(grid, level), colour, level == 5.0 ? 2.2 : 1.3, dash});
    }
    return drawn;
}

std::optional<plots::Figure> lux_map_figure(const LuxMap& map, const std::string& lamp) {
    if (map.lx.empty() || !(map.ahead_m > -map.behind_m) || !(map.left_m > -map.right_m))
        return std::nullopt;
    plots::Figure drawn = figure_over(map, short_text(lamp, 60));
    drawn.subtitle = fmt::format("lux on the road after {} s; lines at 1, 3, 5, 10, 30 and 50 lx", figure(map.time_s, 2));
    drawn.rasters.push_back({plots::heat_map(ahead_to_the_right(map.lx), lux_scale), -map.behind_m, map.ahead_m, map.left_m, -map.right_m});
    const plots::Grid grid = grid_of(map);
    for (const double level : isolux_lines_lx) {
        const bool dark = plots::luminance(plots::sequential(plots::position(lux_scale, level))) < 0.35;
        drawn.isolines.push_back({fmt::format("{:g}", level), plots::isolines(grid, level),
                                  dark ? plots::Colour{255, 255, 255} : plots::Colour{24, 24, 32}, 1.3});
    }
    add_edges(drawn, map, {205, 210, 218});
    drawn.colour_bar = plots::ColourBar{lux_scale};
    return drawn;
}

} // namespace fernlicht
