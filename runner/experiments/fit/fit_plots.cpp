#include "runner/experiments/fit/fit_result.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fernlicht {
namespace {

/// Points as dots without a line; outliers in a series of their own.
template <class X, class Y> std::vector<plots::Series> dots_of(const FitResult& result, X x, Y y) {
    std::vector<plots::Series> all;
    const auto series_named = [&](const std::string& name) -> plots::Series& {
        const auto found = std::ranges::find(all, name, &plots::Series::name);
        if (found != all.end())
            return *found;
        plots::Series series;
        series.name = name;
        series.colour = plots::series_colour(all.size());
        series.markers = true;
        return all.emplace_back(std::move(series));
    };
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    for (const bool outliers : {false, true})
        for (const FitPoint& point : result.points)
            if (point.found.outlier == outliers) {
                plots::Series& series = series_named(outliers ? "outliers" : point.lamp);
                series.points.push_back({x(point), y(point)});
                series.points.push_back({gap, gap});
            }
    return all;
}

template <class Of> std::vector<double> values_of(const FitResult& result, Of of) {
    std::vector<double> values;
    for (const FitPoint& point : result.points)
        values.push_back(of(point));
    return values;
}

} // namespace

plots::Figure residual_plot(const FitResult& result) {
    const auto v = [](const FitPoint& point) { return point.found.v_deg; };
    // A gross error must not press all others onto the line.
    const double most = std::max(6.0, std::ceil(1.5 * result.outlier_from));
    const auto residual = [most](const FitPoint& point) { return std::clamp(point.found.residual, -0.97 * most, 0.97 * most); };
    plots::Figure figure;
    figure.title = "Residuals over the height in the beam";
    figure.subtitle = "read less calculated, in standard uncertainties, by the lamp that gives most; beyond the edge, at the edge";
    figure.x = plots::axis_around("V in the fitted beam", "°", values_of(result, v));
    figure.y = {"residual", "", -most, most};
    figure.series = dots_of(result, v, residual);
    figure.marks.push_back({plots::Mark::Across::at_y, 0.0, ""});
    for (const double threshold : {-result.outlier_from, result.outlier_from})
        if (result.outlier_from > 0.0)
            figure.marks.push_back({plots::Mark::Across::at_y, threshold, threshold > 0.0 ? "outliers beyond" : ""});
    if (result.cut_off_v_deg)
        figure.marks.push_back({plots::Mark::Across::at_x, *result.cut_off_v_deg, "cut-off, level part"});
    return figure;
}

plots::Figure agreement_plot(const FitResult& result) {
    const auto read = [](const FitPoint& point) { return point.read.lux; };
    const auto calculated = [](const FitPoint& point) { return point.found.calculated_lx; };
    std::vector<double> both = values_of(result, read);
    const std::vector<double> more = values_of(result, calculated);
    both.insert(both.end(), more.begin(), more.end());
    plots::Figure figure;
    figure.title = "Calculated over read";
    figure.subtitle = "with the lamps as fitted; the line: both the same";
    figure.width_px = figure.height_px = 560.0;
    figure.x = plots::axis_around("read", "lx", both, plots::Scale::logarithmic);
    figure.y = plots::axis_around("calculated", "lx", both, plots::Scale::logarithmic);
    plots::Series same;
    same.points = {{figure.x.from, figure.x.from}, {figure.x.to, figure.x.to}};
    same.colour = {120, 120, 120};
    same.width_px = 1.0;
    figure.series = dots_of(result, read, calculated);
    figure.series.insert(figure.series.begin(), same);
    return figure;
}

} // namespace fernlicht
