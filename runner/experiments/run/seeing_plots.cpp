#include "runner/experiments/run/run_plots.h"
#include "runner/files/clean_text.h"
#include "runner/write/plots/svg.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fernlicht {
namespace {

/// Light from far away and light that is none look alike on a page: nothing below this share of the largest value is drawn.
constexpr double least_share = 1e-4;

const SeeingSeries* series_named(const PlayedVariant& played, const std::string& subject) {
    const auto found = std::ranges::find(played.seeing, subject, &SeeingSeries::subject);
    return found == played.seeing.end() ? nullptr : &*found;
}

plots::Polyline line_of(const SeeingSeries& series, const SeeingSeries::Column& column) {
    plots::Polyline line;
    double largest = 0.0;
    for (const Value& value : column.values)
        largest = std::max(largest, value.figure().value_or(0.0));
    for (std::size_t i = 0; i < series.at_m.size(); ++i) {
        const std::optional<double> value = column.values[i].figure();
        const bool shown = value && (!column.logarithmic || *value >= least_share * largest);
        line.push_back({series.at_m[i], shown ? *value : std::numeric_limits<double>::quiet_NaN()});
    }
    return line;
}

std::string figure_of(const ComparedDrive& drive, const SeeingSeries& subject, std::size_t column) {
    const SeeingSeries::Column& what = subject.columns[column];
    plots::Figure figure;
    std::vector<double> x, y;
    for (std::size_t i = 0; i < drive.variants.size(); ++i) {
        const SeeingSeries* const series = series_named(*drive.variants[i], subject.subject);
        if (!series || column >= series->columns.size())
            continue;
        plots::Polyline line = line_of(*series, series->columns[column]);
        for (const plots::Point& point : line)
            if (std::isfinite(point.y)) {
                x.push_back(point.x);
                y.push_back(point.y);
            }
        figure.series.push_back(
            {short_text(drive.variants[i]->variant, 24), std::move(line), plots::lamp_colour(i), 2.0, "", series->at_m.size() == 1});
    }
    if (y.empty())
        return {};
    figure.title = short_text(subject.title, 60) + ": " + short_text(what.label, 60);
    figure.width_px = 640.0;
    figure.height_px = 300.0;
    figure.x = plots::axis_around(subject.over, "m", x);
    const bool logarithmic = what.logarithmic && *std::ranges::max_element(y) > 0.0;
    figure.y = plots::axis_around(what.label, what.unit, y, logarithmic ? plots::Scale::logarithmic : plots::Scale::linear, !logarithmic);
    return plots::svg_of(figure);
}

bool is_of_control(const SeeingSeries& series) { return series.subject == "control"; }

std::vector<std::string> figures_of(const ComparedDrive& drive, bool control) {
    std::vector<std::string> figures;
    for (const SeeingSeries& subject : drive.variants.front()->seeing)
        for (std::size_t column = 0; is_of_control(subject) == control && column < subject.columns.size(); ++column)
            if (subject.columns[column].drawn)
                if (std::string svg = figure_of(drive, subject, column); !svg.empty())
                    figures.push_back(std::move(svg));
    return figures;
}

} // namespace

std::vector<std::string> seeing_svgs(const ComparedDrive& drive) { return figures_of(drive, false); }
std::vector<std::string> control_svgs(const ComparedDrive& drive) { return figures_of(drive, true); }

} // namespace fernlicht
