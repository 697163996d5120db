#include "runner/findings/plots/dot_plot.h"

#include "runner/findings/plots/axes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace fernlicht::plots {
namespace {

constexpr Colour dot_ink{34, 40, 46}, dot_quiet{86, 97, 108}, dot_rule{222, 225, 230}, gain_colour{10, 87, 148}, loss_colour{168, 72, 0};
constexpr double dot_line_px = 14.0, dot_letters_px = 12.0, dot_names_px = 290.0;

std::vector<std::string> lines_of(const std::string& name) {
    std::vector<std::string> lines;
    std::istringstream words(name);
    for (std::string word; words >> word;)
        if (lines.empty() || text_width(lines.back() + " " + word, dot_letters_px) > dot_names_px)
            lines.push_back(word);
        else
            lines.back() += " " + word;
    return lines;
}

/// Half of the axis: a round number that holds every line, `most` at the latest.
double end_of(const DotPlot& plot) {
    double largest = 1.0;
    for (const DotRow& row : plot.rows)
        if (row.value) {
            for (const double x : row.others)
                largest = std::max(largest, std::abs(x));
            largest = std::max({largest, std::abs(*row.value), std::abs(row.low), std::abs(row.high)});
        }
    if (largest >= plot.most)
        return plot.most;
    const double step = std::pow(10.0, std::floor(std::log10(largest)));
    return std::min(plot.most, std::ceil(largest / step) * step);
}

} // namespace

Drawing drawing_of(const DotPlot& plot) {
    double names = 0.0, figures = 0.0, rows_px = 0.0;
    std::vector<std::vector<std::string>> lines;
    for (const DotRow& row : plot.rows) {
        lines.push_back(lines_of(row.name));
        for (const std::string& line : lines.back())
            names = std::max(names, text_width(line, dot_letters_px));
        figures = std::max(figures, 1.12 * text_width(row.figure, dot_letters_px)); // bold
        rows_px += dot_line_px * static_cast<double>(lines.back().size()) + 7.0;
    }
    const double top = plot.title.empty() ? 8.0 : plot.subtitle.empty() ? 30.0 : 48.0, bottom = top + rows_px;
    const double left = names + 16.0, right = std::max(left + 120.0, plot.width_px - figures - 22.0), middle = 0.5 * (left + right);
    const double end = end_of(plot);
    Drawing drawing{right + figures + 22.0, bottom + 46.0, plot.title};
    const auto place = [&](double x) { return middle + 0.5 * (right - left) * std::clamp(x / end, -1.0, 1.0); };
    drawing.rectangle(0.0, 0.0, drawing.width, drawing.height, {.fill = "#ffffff"});
    drawing.text(4.0, 20.0, plot.title, {.size_px = 15.0, .colour = dot_ink, .bold = true});
    drawing.text(4.0, 38.0, plot.subtitle, {.size_px = 12.0, .colour = dot_quiet});
    for (const Tick& tick : ticks_of({"", "", -end, end, Scale::linear, {}}, std::max(2, static_cast<int>((right - left) / 60.0)))) {
        const double x = place(tick.value);
        drawing.line({{x, top}, {x, bottom}},
                     {.colour = tick.value == 0.0 ? dot_ink : dot_rule, .width_px = tick.value == 0.0 ? 1.4 : 1.0});
        drawing.text(x, bottom + 16.0,
                     (tick.value > 0.0   ? "+"
                      : tick.value < 0.0 ? "\u2212"
                                         : "") +
                         number(std::abs(tick.value)),
                     {.size_px = 12.0, .colour = dot_ink, .anchor = "middle"});
    }
    drawing.text(middle - 8.0, bottom + 35.0, "\u25c0 " + plot.left + ", " + plot.unit,
                 {.size_px = 12.0, .colour = loss_colour, .anchor = "end"});
    drawing.text(middle + 8.0, bottom + 35.0, plot.right + ", " + plot.unit + " \u25b6", {.size_px = 12.0, .colour = gain_colour});
    double edge = top;
    for (std::size_t i = 0; i < plot.rows.size(); ++i) {
        const DotRow& row = plot.rows[i];
        const double high = dot_line_px * static_cast<double>(lines[i].size()) + 7.0, y = edge + 0.5 * high;
        for (std::size_t k = 0; k < lines[i].size(); ++k)
            drawing.text(left - 10.0, edge + 3.5 + dot_line_px * (static_cast<double>(k) + 0.8), lines[i][k],
                         {.size_px = dot_letters_px, .colour = row.sure ? dot_ink : dot_quiet, .anchor = "end"});
        edge += high;
        drawing.text(right + 14.0, y + 4.0, row.figure,
                     {.size_px = dot_letters_px, .colour = row.sure ? dot_ink : dot_quiet, .bold = row.sure});
        if (!row.value)
            continue;
        const Colour colour = !row.sure ? dot_quiet : *row.value > 0.0 ? gain_colour : loss_colour;
        const double x = place(*row.value);
        for (const double other : row.others)
            drawing.line({{place(other), y - 5.0}, {place(other), y + 5.0}}, {.colour = colour, .width_px = 1.2, .opacity = 0.55});
        drawing.line({{place(row.low), y}, {place(row.high), y}}, {.colour = colour, .width_px = 2.0});
        if (std::abs(*row.value) > end) { // beyond the axis
            const double tip = *row.value > 0.0 ? 7.0 : -7.0;
            drawing.area({{x + tip, y}, {x - tip, y - 6.0}, {x - tip, y + 6.0}}, {.fill = css(colour)});
        } else if (row.sure && *row.value < 0.0) {
            drawing.area({{x, y - 7.0}, {x + 7.0, y}, {x, y + 7.0}, {x - 7.0, y}}, {.fill = css(colour)});
        } else {
            drawing.dot({x, y}, 5.5, colour);
            if (!row.sure)
                drawing.dot({x, y}, 3.6, {255, 255, 255});
        }
    }
    return drawing;
}

} // namespace fernlicht::plots
