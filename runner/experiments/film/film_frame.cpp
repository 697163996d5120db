#include "runner/experiments/film/film_frame.h"

#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/findings/lux_figure.h"
#include "runner/findings/plots/sheets.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <optional>

namespace fernlicht {
namespace {

using plots::Colour;
using plots::Drawing;
using plots::Point;
using plots::Polyline;

constexpr Colour background{14, 16, 20}, bright{236, 239, 243}, dim{176, 182, 190};
constexpr double baseline = 0.36; ///< of a letter's size, below the line's middle
constexpr int grid_px = 2;        ///< between samples of isolux lines
constexpr double least_line_px = 24.0;

/// As lux maps have it everywhere, so that any two compare.
const plots::Axis& lux_scale() {
    static const plots::Axis scale{"illuminance on the road", "lx", 0.1, 100.0, plots::Scale::logarithmic, {0.1, 1.0, 10.0, 100.0}};
    return scale;
}

PixelBox scale_bar(const FilmLayout& layout) {
    const int width = std::min(layout.width_px / 3, static_cast<int>(18.0 * layout.letter_px));
    const int pad = static_cast<int>(2.6 * layout.letter_px);
    return {layout.footer.x + layout.footer.width - width - pad, layout.footer.y + static_cast<int>(0.45 * layout.letter_px), width,
            std::max(2, static_cast<int>(0.6 * layout.letter_px))};
}

void put(Image<Colour>& film, const Image<Colour>& part, const PixelBox& at, int from_x = 0) {
    for (int y = 0; y < at.height; ++y)
        std::copy_n(&part.at(from_x, y), at.width, &film.at(at.x, at.y + y));
}

/// Ahead to the right.
Image<float> turned(const Image<float>& map) {
    Image<float> out(map.height(), map.width());
    for (int y = 0; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x)
            out.at(map.height() - 1 - y, x) = map.at(x, y);
    return out;
}

bool has_maps(const FilmMoment& moment) { return !moment.panels.empty() && !moment.panels.front().map.lx.empty(); }

double length_of(const Polyline& line) {
    double length = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    return length;
}

plots::Grid samples_of(const Image<float>& lx) {
    plots::Grid grid;
    for (int x = 0; x < lx.width(); x += grid_px)
        grid.x.push_back(x + 0.5);
    for (int y = 0; y < lx.height(); y += grid_px) {
        grid.y.push_back(y + 0.5);
        for (int x = 0; x < lx.width(); x += grid_px)
            grid.values.push_back(static_cast<double>(lx.at(x, y)));
    }
    return grid;
}

/// Lines of the driver's view, each with its lux where it begins on the left: there it covers no road ahead.
void add_isolux(Drawing& drawing, const FilmLayout& layout, const FilmPanelBoxes& boxes, const Image<float>& ground_lx) {
    const PixelBox& shown = boxes.shown;
    const double left = shown.x - boxes.picture.x, size = 0.65 * layout.letter_px;
    drawing.begin_window(shown.x, shown.y, shown.width, shown.height);
    const plots::Grid grid = samples_of(ground_lx);
    std::vector<Point> labels;
    std::vector<std::pair<Point, std::string>> words;
    for (const double level : isolux_lines_lx) {
        std::optional<Point> leftmost; // of the longest line
        double longest = least_line_px;
        for (Polyline& line : plots::isolines(grid, level)) {
            const double length = length_of(line);
            if (length < least_line_px)
                continue;
            for (Point& point : line)
                point.x -= left;
            if (length >= longest) {
                longest = length;
                leftmost = *std::ranges::min_element(line, {}, &Point::x);
            }
            drawing.line(line, {{0, 0, 0}, 3.0, {}, 0.55});
            drawing.line(std::move(line), {{255, 255, 255}, 1.2, {}, 0.9});
        }
        if (!leftmost)
            continue;
        const Point at{std::clamp(leftmost->x + 0.3 * size, 2.0, shown.width - 2.0 * size),
                       std::clamp(leftmost->y, size, shown.height - 2.0)};
        if (std::ranges::none_of(labels, [&](const Point& other) {
                return std::abs(other.x - at.x) < 2.0 * size && std::abs(other.y - at.y) < 1.1 * size;
            })) {
            labels.push_back(at);
            words.emplace_back(at, fmt::format("{:g}", level));
        }
    }
    for (const auto& [at, text] : words)
        drawing.text(at.x, at.y, text, {.size_px = size, .colour = bright, .halo = "#101216"});
    drawing.end_window();
}

void add_map_lines(Drawing& drawing, const FilmLayout& layout, const PixelBox& box, const LuxMap& map) {
    const double px_m = box.width / (map.ahead_m + map.behind_m);
    const auto place = [&](double ahead_m, double left_m) { return Point{(ahead_m + map.behind_m) * px_m, (map.left_m - left_m) * px_m}; };
    drawing.begin_window(box.x, box.y, box.width, box.height);
    const plots::Grid grid = grid_of(map);
    for (const double level : isolux_lines_lx) {
        const bool dark = plots::luminance(plots::sequential(plots::position(lux_scale(), level))) < 0.35;
        for (Polyline& line : plots::isolines(grid, level)) {
            for (Point& point : line)
                point = place(point.x, point.y);
            if (length_of(line) >= 0.5 * least_line_px)
                drawing.line(std::move(line), {dark ? Colour{255, 255, 255} : Colour{24, 24, 32}, 1.0, {}, 0.9});
        }
    }
    for (const LuxMap::Polyline& edge : map.edges) {
        Polyline line;
        for (const auto& [ahead_m, left_m] : edge.ahead_left_m)
            line.push_back(place(ahead_m, left_m));
        drawing.line(std::move(line), {{205, 210, 218}, edge.kind == "car" ? 1.6 : 0.8, edge.kind == "lane edge" ? "7 5" : "", 1.0});
    }
    const double size = 0.6 * layout.letter_px;
    for (const double ahead_m : {50.0, 100.0}) {
        const double x = place(ahead_m, 0.0).x;
        drawing.line({{x, box.height - 0.5 * size}, {x, static_cast<double>(box.height)}}, {dim, 1.0, {}, 1.0});
        drawing.text(x, box.height - 0.7 * size, fmt::format("{:g} m", ahead_m),
                     {.size_px = size, .colour = bright, .anchor = "middle", .halo = "#101216"});
    }
    drawing.end_window();
}

void add_title(Drawing& drawing, double letter, const PixelBox& box, const FilmPanelMoment& panel) {
    const double pad = 0.5 * letter, line = 0.85 * letter + baseline * letter;
    const double room = box.width - 2.0 * pad - (panel.speed.empty() ? 0.0 : plots::text_width(panel.speed, letter) + letter);
    drawing.text(box.x + pad, box.y + line,
                 short_text(panel.title, std::max<std::size_t>(4, static_cast<std::size_t>(std::max(0.0, room) / (0.62 * letter)))),
                 {.size_px = letter, .colour = bright, .bold = true});
    drawing.text(box.x + box.width - pad, box.y + line, panel.speed, {.size_px = letter, .colour = bright, .anchor = "end"});
    drawing.text(box.x + pad, box.y + line + 1.25 * letter, panel.readings, {.size_px = 0.8 * letter, .colour = dim});
}

void add_footer(Drawing& drawing, const FilmLayout& layout, const FilmMoment& moment) {
    const double letter = layout.letter_px, pad = 0.5 * letter;
    const double middle = layout.footer.y + 0.5 * layout.footer.height + baseline * letter;
    double right = layout.width_px - pad;
    if (has_maps(moment)) {
        const PixelBox bar = scale_bar(layout);
        const double below = bar.y + bar.height + 0.95 * letter;
        for (const plots::Tick& tick : plots::ticks_of(lux_scale(), 4)) {
            const double x = bar.x + bar.width * plots::position(lux_scale(), tick.value);
            drawing.line({{x, bar.y + 0.0}, {x, bar.y + bar.height + 3.0}}, {bright, 1.0, {}, 1.0});
            drawing.text(x, below, tick.label, {.size_px = 0.75 * letter, .colour = bright, .anchor = "middle"});
        }
        drawing.text(bar.x + bar.width + 0.5 * letter, bar.y + bar.height, "lx", {.size_px = 0.75 * letter, .colour = bright});
        right = bar.x - letter;
    }
    const std::string time = figure(moment.time_s, 2) + " s";
    drawing.text(pad, middle, time, {.size_px = letter, .colour = bright, .bold = true});
    double left = pad + std::max(7.0 * letter, plots::text_width(time, letter) + letter);
    const bool isolux = std::ranges::any_of(moment.panels, [](const FilmPanelMoment& panel) { return !panel.ground_lx.empty(); });
    const double size = 0.8 * letter;
    const std::string lines = isolux || has_maps(moment) ? fmt::format("lines at {:g} lx", fmt::join(isolux_lines_lx, ", ")) : "";
    for (const std::string& text : {moment.caption, lines}) { // what has no room is left out
        const double width = plots::text_width(text, size);
        if (text.empty() || left + width > right)
            continue;
        drawing.text(left, middle, text, {.size_px = size, .colour = dim});
        left += width + 1.5 * letter;
    }
}

} // namespace

Image<Colour> film_pixels(const FilmLayout& layout, const FilmMoment& moment) {
    Image<Colour> film(layout.width_px, layout.height_px, background);
    for (std::size_t i = 0; i < moment.panels.size(); ++i) {
        const FilmPanelBoxes& boxes = layout.panels[i];
        const FilmPanelMoment& panel = moment.panels[i];
        put(film, pixels_of(panel.picture), boxes.shown, boxes.shown.x - boxes.picture.x);
        if (!panel.map.lx.empty())
            put(film, plots::heat_map(turned(panel.map.lx), lux_scale()), boxes.map);
    }
    if (has_maps(moment)) {
        const PixelBox bar = scale_bar(layout);
        for (int x = 0; x < bar.width; ++x)
            for (int y = 0; y < bar.height; ++y)
                film.at(bar.x + x, bar.y + y) = plots::sequential((x + 0.5) / bar.width);
    }
    return film;
}

Drawing film_marks(const FilmLayout& layout, const FilmMoment& moment) {
    Drawing drawing;
    drawing.width = layout.width_px;
    drawing.height = layout.height_px;
    for (std::size_t i = 0; i < moment.panels.size(); ++i) {
        const FilmPanelBoxes& boxes = layout.panels[i];
        const FilmPanelMoment& panel = moment.panels[i];
        add_title(drawing, layout.letter_px, boxes.title, panel);
        if (!panel.ground_lx.empty())
            add_isolux(drawing, layout, boxes, panel.ground_lx);
        if (!panel.map.lx.empty())
            add_map_lines(drawing, layout, boxes.map, panel.map);
    }
    if (layout.wipe) {
        const PixelBox& right = layout.panels.back().shown;
        drawing.line({{right.x + 0.0, right.y + 0.0}, {right.x + 0.0, right.y + right.height + 0.0}}, {bright, 2.0, {}, 0.7});
    }
    add_footer(drawing, layout, moment);
    return drawing;
}

} // namespace fernlicht
