#include "runner/experiments/compare/lamps/lamp_comparison.h"
#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/files/clean_text.h"
#include "runner/findings/plots/isocandela.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

using plots::AngleWindow;
using plots::Figure;

std::string old_label(const LampPairComparison& lamps) { return "A: " + short_text(distinct_label(lamps.before.file, lamps.now.file), 60); }
std::string new_label(const LampPairComparison& lamps) { return "B: " + short_text(distinct_label(lamps.now.file, lamps.before.file), 60); }

AngleWindow common_window(const LampPairComparison& lamps) {
    const AngleWindow a = plots::beam_window(lamps.before.file.table), b = plots::beam_window(lamps.now.file.table);
    return {std::min(a.left_deg, b.left_deg), std::max(a.right_deg, b.right_deg), std::min(a.bottom_deg, b.bottom_deg),
            std::max(a.top_deg, b.top_deg)};
}

double common_peak_cd(const LampPairComparison& lamps) { return std::max(lamps.before.description.peak.cd, lamps.now.description.peak.cd); }

ComparedFigure side_by_side(const LampPairComparison& lamps) {
    const AngleWindow window = common_window(lamps);
    const double peak_cd = common_peak_cd(lamps);
    Figure a = plots::isocandela_diagram(lamps.before.file.table, old_label(lamps), window, peak_cd);
    Figure b = plots::isocandela_diagram(lamps.now.file.table, new_label(lamps), window, peak_cd);
    for (Figure* figure : {&a, &b}) {
        figure->width_px = 760.0;
        plots::fit_height(*figure, window);
    }
    return {"isocandela-side-by-side", "Isocandela diagrams, in one scale", FiguresBeside(a, b)};
}

Figure over_window(const AngleWindow& window, const std::string& title) {
    Figure figure;
    figure.title = title;
    figure.width_px = 1040.0;
    figure.x = {"H, right positive", "°", window.left_deg, window.right_deg};
    figure.y = {"V, up positive", "°", window.bottom_deg, window.top_deg};
    plots::fit_height(figure, window);
    return figure;
}

void add_axes(Figure& figure) {
    figure.marks.push_back({plots::Mark::Across::at_x, 0.0, "V-V"});
    figure.marks.push_back({plots::Mark::Across::at_y, 0.0, "H-H"});
}

ComparedFigure overlay(const LampPairComparison& lamps) {
    const AngleWindow window = common_window(lamps);
    Figure figure = over_window(window, "Isocandela lines of both");
    figure.subtitle = "lux at 25 m on a target facing the lamp (1 lx = 625 cd); crosses: peaks";
    const plots::Colour old_colour = plots::series_colour(0), new_colour = plots::series_colour(1);
    figure.series = {{.name = old_label(lamps), .colour = old_colour}, {.name = new_label(lamps), .colour = new_colour, .dash = "6 3"}};
    const plots::Grid a = plots::lux_over(lamps.before.file.table, window), b = plots::lux_over(lamps.now.file.table, window);
    for (const double level : plots::isocandela_levels_lx(common_peak_cd(lamps))) {
        figure.isolines.push_back({plots::number(level) + " lx", plots::isolines(a, level), old_colour, 1.3, ""});
        figure.isolines.push_back({plots::number(level) + " lx", plots::isolines(b, level), new_colour, 1.5, "6 3"});
    }
    add_axes(figure);
    const Peak &peak_a = lamps.before.description.peak, &peak_b = lamps.now.description.peak;
    figure.notes.push_back({peak_a.h_deg, peak_a.v_deg, "", old_colour, true});
    figure.notes.push_back({peak_b.h_deg, peak_b.v_deg, "", new_colour, true});
    return {"isocandela-overlay", figure.title, figure};
}

ComparedFigure difference(const LampPairComparison& lamps) {
    const AngleWindow window = common_window(lamps);
    const CandelaTable &a = lamps.before.file.table, &b = lamps.now.file.table;
    constexpr int columns = 480, rows = 240;
    Image<float> values(columns, rows);
    double largest = 0.0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const double h = window.left_deg + (window.right_deg - window.left_deg) * (x + 0.5) / columns;
            const double v = window.top_deg - (window.top_deg - window.bottom_deg) * (y + 0.5) / rows;
            const bool known = has_data(a, h, v) && has_data(b, h, v);
            const double cd = known ? intensity_cd(b, h, v) - intensity_cd(a, h, v) : std::numeric_limits<double>::quiet_NaN();
            values.at(x, y) = static_cast<float>(cd);
            largest = std::max(largest, known ? std::abs(cd) : 0.0);
        }
    const double top = rounded_up(largest);
    Figure figure = over_window(window, "Difference, B - A");
    figure.subtitle =
        fmt::format("{} less {}; orange: B is brighter, blue: A is brighter, grey: outside a table", new_label(lamps), old_label(lamps));
    figure.colour_bar = plots::ColourBar{{"B - A", "cd", -top, top, plots::Scale::signed_logarithmic}, true};
    figure.rasters.push_back({plots::difference_map(values, figure.colour_bar->axis, {200, 200, 200}), window.left_deg, window.right_deg,
                              window.top_deg, window.bottom_deg});
    add_axes(figure);
    return {"difference", figure.title, figure};
}

ComparedFigure ratio(const LampPairComparison& lamps) {
    Figure figure = difference_figure(lamps.now.file, lamps.before.file, lamps.difference);
    figure.title = "Ratio, B over A";
    figure.x.label = "H, right positive";
    figure.y.label = "V, up positive";
    figure.x.unit = figure.y.unit = "°";
    add_axes(figure);
    return {"ratio", figure.title, figure};
}

/// Where vertical scans find the edge.
plots::Polyline cut_off_line(const ComparedLamp& lamp) {
    constexpr double widest_deg = 10.0, step_deg = 0.25;
    plots::Polyline line;
    for (int i = 0; i <= static_cast<int>(2.0 * widest_deg / step_deg); ++i) {
        const double h_deg = -widest_deg + step_deg * i;
        const CutOffScan scan = vertical_scan({&lamp.file.table, {}}, h_deg, -3.0, 4.0);
        line.push_back({h_deg, scan.inflection_deg.value_or(std::numeric_limits<double>::quiet_NaN())});
    }
    return line;
}

std::optional<ComparedFigure> cut_offs(const LampPairComparison& lamps) {
    Figure figure;
    figure.title = "Cut-off lines";
    figure.subtitle = "the steepest fall of log E in vertical scans, detector of 30 mm at 25 m; missing where there is no edge";
    figure.width_px = 1040.0;
    figure.height_px = 380.0;
    figure.series = {{old_label(lamps), cut_off_line(lamps.before), plots::series_colour(0), 2.4, ""},
                     {new_label(lamps), cut_off_line(lamps.now), plots::series_colour(1), 1.8, "6 3"}};
    std::vector<double> ys;
    for (const plots::Series& series : figure.series)
        for (const plots::Point& point : series.points)
            if (std::isfinite(point.y))
                ys.push_back(point.y);
    if (ys.empty())
        return std::nullopt;
    figure.x = {"H, right positive", "°", -10.0, 10.0};
    figure.y = plots::axis_around("V, up positive", "°", ys);
    add_axes(figure);
    return ComparedFigure{"cut-off", figure.title, figure};
}

} // namespace

std::vector<ComparedFigure> lamp_figures(const LampPairComparison& lamps) {
    std::vector<ComparedFigure> figures{side_by_side(lamps), overlay(lamps), difference(lamps), ratio(lamps)};
    if (std::optional<ComparedFigure> lines = cut_offs(lamps))
        figures.push_back(std::move(*lines));
    return figures;
}

} // namespace fernlicht
