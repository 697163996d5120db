#include "runner/write/plots/svg.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using plots::Colour;
using plots::Drawing;

constexpr Colour sheet_ink{24, 24, 32}, sheet_faint{100, 100, 108};
constexpr double edge_px = 16.0, gap_px = 12.0, caption_px = 26.0, head_px = 54.0, key_px = 22.0, legend_px = 112.0;
/// Letters grow with wide panels: such sheets are shown smaller than they are.
constexpr double plain_letters_px = 560.0, largest_letters = 1.8;
constexpr int min_width_px = 320, max_width_px = 1024;

/// At the line's right end, of dashed ones at the left: of lines beside each other both can be read.
void draw_label(Drawing& canvas, const SheetLine& line, double scale, double width, double letters) {
    const bool left = !line.dash.empty();
    const auto [leftmost, rightmost] = std::ranges::minmax_element(line.points, {}, &plots::Point::x);
    const plots::Point& end = left ? *leftmost : *rightmost;
    const double room = 26.0 * letters;
    canvas.text(std::clamp(end.x * scale + (left ? -3.0 : 3.0), left ? room : 2.0, left ? width : width - room),
                end.y * scale + 4.0 * letters, line.label,
                {.size_px = 11.0 * letters, .colour = line.colour, .anchor = left ? "end" : "start", .halo = "#000000"});
}

void draw_panel(Drawing& canvas, const SheetPanel& panel, double left, double top, double scale, double letters) {
    const double width = panel.pixels.width() * scale, height = panel.pixels.height() * scale;
    canvas.picture(left, top, width, height, scale > 1.0 ? enlarged(panel.pixels, static_cast<int>(scale)) : panel.pixels);
    canvas.begin_window(left, top, width, height);
    for (const SheetLine& line : panel.lines) {
        plots::Polyline points = line.points;
        for (plots::Point& p : points)
            p = {p.x * scale, p.y * scale};
        canvas.line(points, {.colour = line.colour, .width_px = 1.3 * letters, .dash = line.dash});
    }
    for (const SheetLine& line : panel.lines)
        if (!line.label.empty() && !line.points.empty())
            draw_label(canvas, line, scale, width, letters);
    canvas.end_window();
    canvas.text(left, top + height + 17.0 * letters, panel.caption, {.size_px = 13.0 * letters, .colour = sheet_ink});
}

void draw_legend(Drawing& canvas, const SheetLegend& legend, double left, double top, double height, double letters) {
    constexpr int steps = 256;
    Image<Colour> bar(1, steps);
    for (int i = 0; i < steps; ++i) {
        const double t = 1.0 - (i + 0.5) / steps;
        bar.at(0, i) = legend.diverging ? plots::diverging(2.0 * t - 1.0) : plots::sequential(t);
    }
    canvas.picture(left, top, 14.0, height, bar);
    canvas.rectangle(left, top, 14.0, height, {.stroke = css(sheet_ink)});
    double widest = 0.0;
    for (const auto& [position, text] : legend.ticks) {
        const double y = top + height * (1.0 - position);
        canvas.line({{left + 14.0, y}, {left + (text.empty() ? 16.0 : 18.0), y}}, {.colour = sheet_ink});
        canvas.text(left + 21.0, y + 4.0 * letters, text, {.size_px = 11.0 * letters, .colour = sheet_ink});
        widest = std::max(widest, plots::text_width(text, 11.0 * letters));
    }
    canvas.text(left + 30.0 + 16.0 * letters + widest, top + 0.5 * height, legend.label,
                {.size_px = 12.0 * letters, .colour = sheet_ink, .anchor = "middle", .turn_deg = -90.0});
}

} // namespace

std::string plots::svg_of(const Sheet& sheet, int zlib) {
    const Image<Colour>& first = sheet.panels.at(0).pixels;
    const double scale = first.width() < min_width_px   ? std::ceil(static_cast<double>(min_width_px) / first.width())
                         : first.width() > max_width_px ? static_cast<double>(max_width_px) / first.width()
                                                        : 1.0;
    const double width = first.width() * scale, height = first.height() * scale;
    const double letters = std::clamp(0.5 * (width + std::max(width, height)) / plain_letters_px, 1.0, largest_letters);
    const double top = letters * (head_px + (sheet.key.empty() ? 0.0 : key_px));
    const double across = static_cast<double>(sheet.panels.size()) * (width + gap_px) - gap_px;
    const double heading = std::max(plots::text_width(sheet.title, 16.0 * letters), plots::text_width(sheet.subtitle, 12.0 * letters));
    Drawing canvas{2.0 * edge_px + std::max(across + (sheet.legend ? legend_px * letters : 0.0), heading),
                   top + height + letters * caption_px + 8.0, sheet.title};
    canvas.text(edge_px, 24.0 * letters, sheet.title, {.size_px = 16.0 * letters, .colour = sheet_ink, .bold = true});
    canvas.text(edge_px, 42.0 * letters, sheet.subtitle, {.size_px = 12.0 * letters, .colour = sheet_faint});
    double at = edge_px;
    for (const auto& [name, line] : sheet.key) {
        const double middle = letters * (head_px + 7.0), sample = 30.0 * letters;
        canvas.rectangle(at, middle - 6.0 * letters, sample, 12.0 * letters, {.fill = "#333333"});
        canvas.line({{at, middle}, {at + sample, middle}}, {.colour = line.colour, .width_px = 2.0 * letters, .dash = line.dash});
        canvas.text(at + sample + 6.0, middle + 5.0 * letters, name, {.size_px = 12.0 * letters, .colour = sheet_ink});
        at += sample + 24.0 + plots::text_width(name, 12.0 * letters);
    }
    for (std::size_t i = 0; i < sheet.panels.size(); ++i)
        draw_panel(canvas, sheet.panels[i], edge_px + static_cast<double>(i) * (width + gap_px), top, scale, letters);
    if (sheet.legend)
        draw_legend(canvas, *sheet.legend, edge_px + across + 14.0, top, height, letters);
    return svg_of(canvas, zlib);
}

} // namespace fernlicht
