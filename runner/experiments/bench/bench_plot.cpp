#include "runner/experiments/bench/bench_result.h"
#include "runner/findings/plots/axes.h"
#include "runner/write/plots/canvas.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using plots::Canvas;

constexpr plots::Colour ink{51, 51, 51}, faint{110, 110, 110}, grid{222, 224, 228};
constexpr double width_px = 900.0, bar_px = 16.0, step_px = 24.0, top_px = 74.0, bottom_px = 46.0, gap_px = 12.0;

plots::Colour colour_of(const BenchRow& row) {
    if (row.benched->row.name == reference_technique)
        return plots::series_colour(2);
    return plots::series_colour(row.benched->row.thesis_row > 0 ? 0 : 1);
}

std::string label_of(const BenchRow& row) {
    const Technique& technique = row.benched->row;
    return technique.thesis_row > 0 ? fmt::format("{}. {}", technique.thesis_row, technique.name) : std::string(technique.name);
}

std::string value_of(const BenchRow& row) {
    const std::string ms = fmt::format("{:.2f} ms", 1e3 * row.frame.median);
    if (!row.ratio)
        return ms;
    const bool open = row.ratio->difference == Difference::not_distinguishable && row.benched->row.name != reference_technique;
    return fmt::format("{}, x {:.2f}{}", ms, row.ratio->median, open ? " (not distinguishable)" : "");
}

double widest(const std::vector<BenchRow>& rows, std::string (*text)(const BenchRow&)) {
    double width = 0.0;
    for (const BenchRow& row : rows)
        width = std::max(width, plots::text_width(text(row), 12.0));
    return width;
}

/// Where the bars lie: from `left` over `width` pixels, for 0 .. axis.to.
struct PlotGround {
    double left = 0.0, width = 0.0;
    plots::Axis axis;
    double x(double value) const { return left + width * plots::position(axis, value); }
};

void draw_bar(Canvas& canvas, const BenchRow& row, const PlotGround& ground, double y) {
    const double middle = y + 0.5 * bar_px, end = ground.x(1e3 * row.frame.median);
    const double low = ground.x(1e3 * row.frame.p05), high = ground.x(1e3 * row.frame.p95);
    canvas.text(ground.left - 8.0, middle + 4.0, label_of(row), {.size_px = 12.0, .colour = ink, .anchor = "end"});
    canvas.rectangle(ground.left, y, end - ground.left, bar_px, {.fill = css(colour_of(row)), .opacity = 0.75});
    canvas.line({{low, middle}, {high, middle}}, {.colour = ink, .width_px = 1.4});
    for (const double x : {low, high})
        canvas.line({{x, middle - 4.0}, {x, middle + 4.0}}, {.colour = ink, .width_px = 1.4});
    canvas.text(std::max(end, high) + 8.0, middle + 4.0, value_of(row), {.size_px = 12.0, .colour = faint});
}

void draw_axis(Canvas& canvas, const PlotGround& ground, double bottom) {
    for (const plots::Tick& tick : plots::ticks_of(ground.axis, 8)) {
        const double x = ground.x(tick.value);
        canvas.line({{x, top_px - 6.0}, {x, bottom}}, {.colour = grid});
        canvas.text(x, bottom + 16.0, tick.label, {.size_px = 12.0, .colour = ink, .anchor = "middle"});
    }
    canvas.text(ground.left + 0.5 * ground.width, bottom + 36.0, "time a frame, back to back, median and 5 to 95 % of the rounds [ms]",
                {.size_px = 12.0, .colour = ink, .anchor = "middle"});
}

} // namespace

std::string bench_svg(const BenchResult& result) {
    const std::vector<BenchRow> rows = summarise(result);
    std::vector<double> highest{0.0};
    for (const BenchRow& row : rows)
        highest.push_back(1e3 * row.frame.p95);
    PlotGround ground;
    ground.axis = plots::axis_around("time a frame", "ms", highest, plots::Scale::linear, true);
    ground.left = 16.0 + std::max(60.0, widest(rows, label_of));
    ground.width = std::max(100.0, width_px - ground.left - widest(rows, value_of) - 16.0);
    const bool split = std::ranges::any_of(rows, [](const BenchRow& row) { return row.benched->row.thesis_row > 0; }) &&
                       std::ranges::any_of(rows, [](const BenchRow& row) { return row.benched->row.thesis_row == 0; });
    const double bottom = top_px + step_px * static_cast<double>(rows.size()) + (split ? gap_px : 0.0);
    Canvas canvas(width_px, bottom + bottom_px, "Frame times by technique");
    canvas.rectangle(0.0, 0.0, width_px, bottom + bottom_px, {.fill = "#ffffff"});
    canvas.text(16.0, 24.0, "Frame times by technique", {.size_px = 16.0, .colour = ink, .bold = true});
    canvas.text(16.0, 42.0,
                fmt::format("{}, {}, {} x {}; {} moments x {} rounds; x: ratio to {}; numbers: rows of Table 6.1", result.drive,
                            result.variant, result.width_px, result.height_px, result.moments.size(), result.orders.size(),
                            reference_technique),
                {.size_px = 12.0, .colour = faint});
    canvas.text(16.0, 58.0, fmt::format("{}, {}", result.context.gl_renderer, result.context.cpu), {.size_px = 12.0, .colour = faint});
    draw_axis(canvas, ground, bottom);
    double y = top_px;
    for (std::size_t i = 0; i < rows.size(); ++i, y += step_px) {
        if (split && i > 0 && rows[i - 1].benched->row.thesis_row > 0 && rows[i].benched->row.thesis_row == 0)
            y += gap_px;
        draw_bar(canvas, rows[i], ground, y);
    }
    return canvas.finish();
}

} // namespace fernlicht
