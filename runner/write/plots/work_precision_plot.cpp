#include "metrics/statistics/statistics.h"
#include "runner/findings/figures.h"
#include "runner/write/plots/svg.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using plots::Drawing;
using plots::Point;

constexpr plots::Colour ink{51, 51, 51}, faint{110, 110, 110}, grid{222, 224, 228}, band{198, 203, 209};
constexpr double left_px = 76.0, plot_width_px = 560.0, list_px = left_px + plot_width_px + 28.0, top_px = 66.0, line_px = 17.0,
                 letter_px = 11.5, min_height_px = 430.0, bottom_px = 60.0, title_px = 24.0, radius_px = 4.5;

struct Box {
    double left, top, right, bottom;
    bool meets(const Box& o) const { return left < o.right && o.left < right && top < o.bottom && o.top < bottom; }
};

/// The plot's ground and where values fall on it; what lies beyond an edge is drawn on it.
struct PlotGround {
    plots::Axis time, error;
    double height = 0.0;
    double bottom() const { return top_px + height; }
    double x(double seconds) const {
        const double at = plots::position(time, seconds);
        return left_px + plot_width_px * (std::isfinite(at) ? std::clamp(at, 0.0, 1.0) : 0.0);
    }
    double y(double value) const {
        const double at = plots::position(error, value);
        return bottom() - height * (std::isfinite(at) ? std::clamp(at, 0.0, 1.0) : 0.0);
    }
};

/// What the band of the floor reaches up to: the median of the rows'.
double typical_floor(const WorkPrecision& diagram) {
    std::vector<double> floors;
    for (const WorkPrecisionRow& row : diagram.rows)
        if (row.measured())
            floors.push_back(row.floor);
    const auto spread = spread_of(floors);
    return spread ? spread->median : 0.0;
}

/// Logarithmic, from two thirds of the least value above 0 to one and a half of the greatest, at least a factor of ten.
plots::Axis tight_axis(const std::string& label, const std::string& unit, const std::vector<double>& values) {
    plots::Axis axis = plots::axis_around(label, unit, values, plots::Scale::logarithmic);
    double least = 0.0, most = 0.0;
    for (const double value : values)
        if (value > 0.0) {
            least = least == 0.0 ? value : std::min(least, value);
            most = std::max(most, value);
        }
    if (least > 0.0) {
        const double widen = std::max(1.5, std::sqrt(10.0 * least / most));
        axis.from = least / widen;
        axis.to = most * widen;
    }
    return axis;
}

PlotGround ground_for(const WorkPrecision& diagram, double height) {
    std::vector<double> times, errors;
    for (const WorkPrecisionRow& row : diagram.rows)
        if (row.measured()) {
            times.insert(times.end(), {1e3 * row.seconds->low, 1e3 * row.seconds->high});
            errors.insert(errors.end(), {row.claimed_error(), row.error->high});
        }
    errors.push_back(typical_floor(diagram));
    PlotGround ground;
    ground.time = tight_axis(diagram.time_name, "ms", times);
    ground.error = tight_axis(diagram.error_name, diagram.error_unit, errors);
    ground.error.from *= 0.6; // room below the lowest point for its arrow
    ground.height = height;
    return ground;
}

void draw_ground(Drawing& canvas, const PlotGround& ground, const WorkPrecision& diagram) {
    const double right = left_px + plot_width_px, floor = typical_floor(diagram);
    if (floor > 0.0) {
        canvas.rectangle(left_px, ground.y(floor), plot_width_px, ground.bottom() - ground.y(floor), {.fill = css(band), .opacity = 0.45});
        canvas.text(right - 6.0, ground.bottom() - 7.0, "below: " + diagram.floor_name,
                    {.size_px = letter_px, .colour = faint, .anchor = "end"});
    }
    for (const plots::Tick& tick : plots::ticks_of(ground.time, 8)) {
        const double x = ground.x(tick.value);
        canvas.line({{x, top_px}, {x, ground.bottom()}}, {.colour = grid, .width_px = tick.label.empty() ? 0.5 : 1.0});
        canvas.text(x, ground.bottom() + 17.0, tick.label, {.size_px = 12.0, .colour = ink, .anchor = "middle"});
    }
    for (const plots::Tick& tick : plots::ticks_of(ground.error, 8)) {
        const double y = ground.y(tick.value);
        canvas.line({{left_px, y}, {right, y}}, {.colour = grid, .width_px = tick.label.empty() ? 0.5 : 1.0});
        canvas.text(left_px - 7.0, y + 4.0, tick.label, {.size_px = 12.0, .colour = ink, .anchor = "end"});
    }
    canvas.line({{left_px, top_px}, {left_px, ground.bottom()}, {right, ground.bottom()}}, {.colour = ink});
    const auto title = [](const plots::Axis& axis) { return axis.label + " [" + axis.unit + "]"; };
    canvas.text(left_px + 0.5 * plot_width_px, ground.bottom() + 40.0, title(ground.time),
                {.size_px = 12.5, .colour = ink, .anchor = "middle"});
    canvas.text(20.0, top_px + 0.5 * ground.height, title(ground.error),
                {.size_px = 12.5, .colour = ink, .anchor = "middle", .turn_deg = -90.0});
}

/// Steps down from point to point of the front: what can be had for at most so much time.
void draw_front(Drawing& canvas, const PlotGround& ground, const WorkPrecision& diagram, const std::vector<Standing>& standing) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < diagram.rows.size(); ++i)
        if (standing[i].on_front)
            points.emplace_back(1e3 * diagram.rows[i].seconds->value, diagram.rows[i].claimed_error());
    std::ranges::sort(points);
    plots::Polyline line;
    for (const auto& [time, error] : points) {
        if (!line.empty())
            line.push_back({ground.x(time), line.back().y});
        line.push_back({ground.x(time), ground.y(error)});
    }
    if (!line.empty())
        line.push_back({left_px + plot_width_px, line.back().y});
    canvas.line(line, {.colour = plots::series_colour(0), .width_px = 1.6, .opacity = 0.8});
}

void draw_row(Drawing& canvas, const PlotGround& ground, const WorkPrecisionRow& row, bool on_front) {
    const plots::Colour colour = on_front ? plots::series_colour(0) : faint;
    const double x = ground.x(1e3 * row.seconds->value), y = ground.y(row.claimed_error());
    const auto bar = [&](const plots::Polyline& line) { canvas.line(line, {.colour = colour, .width_px = 1.1, .opacity = 0.8}); };
    bar({{ground.x(1e3 * row.seconds->low), y}, {ground.x(1e3 * row.seconds->high), y}});
    bar({{x, ground.y(std::max(row.error->low, row.floor))}, {x, ground.y(std::max(row.error->high, row.claimed_error()))}});
    if (row.below_floor() || row.claimed_error() == 0.0) // somewhere below
        bar({{x, y}, {x, y + 15.0}, {x - 3.5, y + 10.0}, {x, y + 15.0}, {x + 3.5, y + 10.0}});
    canvas.dot({x, y}, radius_px, colour);
    if (!on_front)
        canvas.dot({x, y}, radius_px - 1.4, {255, 255, 255});
}

/// Points that touch, and the numbers of their rows.
struct Heap {
    double x, y; ///< of the first
    std::vector<std::size_t> numbers;
};

/// Each row's point is in the first heap whose first point it touches, from the left.
std::vector<Heap> heaps_of(const PlotGround& ground, const WorkPrecision& diagram) {
    std::vector<Heap> points;
    for (std::size_t i = 0; i < diagram.rows.size(); ++i)
        if (const WorkPrecisionRow& row = diagram.rows[i]; row.measured())
            points.push_back({ground.x(1e3 * row.seconds->value), ground.y(row.claimed_error()), {i + 1}});
    std::ranges::stable_sort(points, {}, &Heap::x);
    std::vector<Heap> heaps;
    for (const Heap& point : points) {
        const auto touched =
            std::ranges::find_if(heaps, [&](const Heap& heap) { return std::hypot(heap.x - point.x, heap.y - point.y) < 2.0 * radius_px; });
        if (touched == heaps.end())
            heaps.push_back(point);
        else
            touched->numbers.push_back(point.numbers.front());
    }
    return heaps;
}

/// "2-4, 9".
std::string ranges_text(std::vector<std::size_t> numbers) {
    std::ranges::sort(numbers);
    std::string text;
    for (std::size_t i = 0, last = 0; i < numbers.size(); i = last + 1) {
        for (last = i; last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1;)
            ++last;
        text += (text.empty() ? "" : ", ") + fmt::format("{}", numbers[i]);
        if (last > i)
            text += fmt::format("{}{}", last == i + 1 ? ", " : "-", numbers[last]);
    }
    return text;
}

/// The rows' numbers beside their points, one label for points that touch, where it hides no point and no other label as long as such a
/// place is found.
void draw_numbers(Drawing& canvas, const PlotGround& ground, const WorkPrecision& diagram) {
    std::vector<Box> taken;
    for (const WorkPrecisionRow& row : diagram.rows)
        if (row.measured()) {
            const double x = ground.x(1e3 * row.seconds->value), y = ground.y(row.claimed_error());
            taken.push_back({x - radius_px, y - radius_px, x + radius_px, y + radius_px});
        }
    for (const Heap& heap : heaps_of(ground, diagram)) {
        const std::string number = ranges_text(heap.numbers);
        const double x = heap.x, y = heap.y, width = plots::text_width(number, letter_px), height = 9.0;
        Box chosen{};
        bool found = false;
        for (double away = 9.0; away < 48.0 && !found; away += 5.0)
            for (int k = 0; k < 16 && !found; ++k) {
                const double angle = 0.7 + 0.3926990817 * k, cx = x + (away + 0.5 * width - 4.0) * std::cos(angle),
                             cy = y - away * std::sin(angle);
                chosen = {cx - 0.5 * width - 1.0, cy - 0.5 * height - 1.0, cx + 0.5 * width + 1.0, cy + 0.5 * height + 1.0};
                found = chosen.left > left_px && chosen.bottom < ground.bottom() &&
                        std::ranges::none_of(taken, [&](const Box& box) { return box.meets(chosen); });
            }
        taken.push_back(chosen);
        const double cx = 0.5 * (chosen.left + chosen.right), cy = 0.5 * (chosen.top + chosen.bottom);
        if (std::hypot(std::max(0.0, std::abs(cx - x) - 0.5 * width), cy - y) > 15.0)
            canvas.line({{x, y}, {cx, cy}}, {.colour = faint, .width_px = 0.5});
        canvas.text(cx, cy + 4.0, number, {.size_px = letter_px, .colour = ink, .anchor = "middle", .halo = "#ffffff"});
    }
}

double draw_list(Drawing& canvas, const WorkPrecision& diagram, const std::vector<Standing>& standing) {
    const plots::Lettering heading{.size_px = letter_px, .colour = faint};
    const auto right_aligned = [&](double x, const std::string& text) {
        canvas.text(list_px + x, top_px - 6.0, text, {.size_px = heading.size_px, .colour = heading.colour, .anchor = "end"});
    };
    right_aligned(330.0, fmt::format("error [{}]", diagram.error_unit));
    right_aligned(398.0, "time");
    double y = top_px + 12.0;
    for (std::size_t i = 0; i < diagram.rows.size(); ++i, y += line_px) {
        const WorkPrecisionRow& row = diagram.rows[i];
        const plots::Lettering letters{
            .size_px = letter_px, .colour = standing[i].on_front ? plots::series_colour(0) : ink, .bold = standing[i].on_front};
        canvas.text(list_px + 20.0, y, fmt::format("{}", i + 1),
                    {.size_px = letter_px, .colour = letters.colour, .bold = letters.bold, .anchor = "end"});
        canvas.text(list_px + 28.0, y, row.label + (row.note.empty() ? "" : " (" + row.note + ")"), letters);
        canvas.text(list_px + 330.0, y, claimed_text(row, diagram.error_unit.size() <= 3 ? diagram.error_unit : ""),
                    {.size_px = letter_px, .colour = ink, .anchor = "end"});
        canvas.text(list_px + 398.0, y, row.seconds ? time_text(row.seconds->value) : "-",
                    {.size_px = letter_px, .colour = ink, .anchor = "end"});
        canvas.text(list_px + 410.0, y, standing_text(standing[i]), {.size_px = letter_px, .colour = faint});
    }
    return y;
}

} // namespace

std::string plots::svg_of(const WorkPrecision& diagram, int zlib) {
    const std::vector<Standing> standing = standings(diagram.rows);
    const double list_bottom = top_px + line_px * static_cast<double>(diagram.rows.size()) + 8.0,
                 height = std::max(min_height_px, list_bottom - top_px), total_width = list_px + 500.0,
                 total_height = top_px + height + bottom_px;
    const PlotGround ground = ground_for(diagram, height);
    Drawing canvas{total_width, total_height, diagram.title};
    canvas.rectangle(0.0, 0.0, total_width, total_height, {.fill = "#ffffff"});
    canvas.text(16.0, title_px, diagram.title, {.size_px = 16.0, .colour = ink, .bold = true});
    canvas.text(16.0, title_px + 18.0,
                "filled, on the line: no other is better in both; hollow: another is, as the list says; arrow: somewhere below",
                {.size_px = 12.0, .colour = faint});
    draw_ground(canvas, ground, diagram);
    draw_front(canvas, ground, diagram, standing);
    for (const bool front : {false, true})
        for (std::size_t i = 0; i < diagram.rows.size(); ++i)
            if (diagram.rows[i].measured() && standing[i].on_front == front)
                draw_row(canvas, ground, diagram.rows[i], front);
    draw_numbers(canvas, ground, diagram);
    draw_list(canvas, diagram, standing);
    return svg_of(canvas, zlib);
}

} // namespace fernlicht
