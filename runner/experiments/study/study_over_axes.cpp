#include "metrics/readings/reading_labels.h"
#include "runner/experiments/study/study_document.h"
#include "runner/files/clean_text.h"
#include "runner/files/output_folder.h"
#include "scenarios/values/xml_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace fernlicht {
namespace {

constexpr std::size_t most_readings = 6, most_lines = 6; ///< figures of one axis; lines of one figure that are still told apart

/// A line for each lamp, on each drive where they are few, else through the medians over all.
struct LineKey {
    std::size_t lamp = 0;
    std::string drive; ///< "": all

    auto operator<=>(const LineKey&) const = default;
};

/// Of two in the middle the smaller.
double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// One reading over one axis.
struct OverAxis {
    std::map<LineKey, std::map<double, std::vector<double>>> values; ///< by value of the axis: one a cell
    std::vector<std::size_t> cells;
    bool bounds = false; ///< some are bounds

    bool is_line() const {
        return std::ranges::any_of(values, [](const auto& line) { return line.second.size() > 1; });
    }
    /// By more than a thousandth.
    bool varies() const {
        return std::ranges::any_of(values, [](const auto& line) {
            std::vector<double> medians;
            for (const auto& [x, ys] : line.second)
                medians.push_back(median_of(ys));
            const auto [least, most] = std::ranges::minmax(medians);
            return most - least > 1e-3 * std::max(std::abs(least), std::abs(most));
        });
    }
    std::size_t most_a_point() const {
        std::size_t most = 0;
        for (const auto& [lamp, line] : values)
            for (const auto& [x, ys] : line)
                most = std::max(most, ys.size());
        return most;
    }
};

OverAxis over(const StudyResult& result, const StudyAxis& axis, const ReadingKey& key, bool by_drive) {
    OverAxis found;
    for (std::size_t i = 0; i < result.cells.size(); ++i) {
        const CellResult& cell = result.cells[i];
        const auto at = std::ranges::find(cell.cell.axes, axis.name, &AxisValue::axis);
        const auto reading = cell.readings.find(key);
        if (at == cell.cell.axes.end() || reading == cell.readings.end() || !reading->second.value.measured())
            continue;
        if (const std::optional<double> x = to_number(at->value)) {
            found.values[{cell.cell.lamp, by_drive ? cell.drive : ""}][*x].push_back(*reading->second.value.figure());
            found.cells.push_back(i);
            found.bounds = found.bounds || reading->second.value.censored();
        }
    }
    return found;
}

OverAxis over(const StudyResult& result, const StudyAxis& axis, const ReadingKey& key) {
    OverAxis each = over(result, axis, key, true), all = over(result, axis, key, false);
    const bool few = each.values.size() > all.values.size() && each.values.size() <= most_lines;
    return few && each.is_line() && result.study.sample.kind != SampleKind::low_discrepancy ? each : all;
}

/// "led, country-1"
std::string line_name(const StudyResult& result, const LineKey& line) {
    return short_text(result.study.lamps[line.lamp].name, 24) + (line.drive.empty() ? "" : ", " + short_text(line.drive, 24));
}

/// Of what decides and runs over the axis: first one of each quantity, then more, the most important first.
std::vector<std::pair<ReadingKey, OverAxis>> readings_over(const StudyResult& result, const StudyAxis& axis) {
    std::set<std::pair<std::size_t, ReadingKey>> deciding;
    for (const ReadingKey& key : result.keys)
        if (const auto place = place_among(key, result.study.decide))
            deciding.emplace(*place, key);
    std::set<Quantity> quantities;
    std::vector<std::pair<ReadingKey, OverAxis>> all;
    for (const bool anew : {true, false})
        for (const auto& [place, key] : deciding) {
            if (all.size() == most_readings || std::ranges::count(all, key, [](const auto& one) { return one.first; }) > 0 ||
                (anew && quantities.contains(key.quantity)))
                continue;
            if (OverAxis found = over(result, axis, key); found.is_line() && found.varies()) {
                quantities.insert(key.quantity);
                all.emplace_back(key, std::move(found));
            }
        }
    return all;
}

/// Drive, where it is one, and condition of a cell but for the axis.
std::string place_off_axis(const CellResult& cell, const StudyAxis& axis, bool one_drive) {
    std::string text = (one_drive ? cell.title + "; " : "") + cell.cell.condition;
    for (const AxisValue& value : cell.cell.axes)
        if (const std::string told = fmt::format(", {} {}", axis.name, value.value);
            value.axis == axis.name && text.find(told) < text.size())
            text.erase(text.find(told), told.size());
    return text;
}

/// What is read, without where: "detection distance of pedestrian-light".
std::string axis_label(const ReadingKey& key) {
    const std::string label = reading_label(key);
    return short_text(label.substr(0, label.find(", ")), 60);
}

std::string words_over(const StudyResult& result, const StudyAxis& axis, const ReadingKey& key, const OverAxis& found) {
    std::vector<std::string> lines;
    for (const auto& [which, line] : found.values)
        if (line.size() > 1)
            lines.push_back(fmt::format("{} from {:.4g} to {:.4g}{}", line_name(result, which), median_of(line.begin()->second),
                                        median_of(line.rbegin()->second), unit_suffix(unit_of(key))));
    const auto& line = std::ranges::max_element(found.values, {}, [](const auto& one) { return one.second.size(); })->second;
    return fmt::format("{}, {} from {:g} to {:g}: {}", capitalised(reading_label(key)), axis.name, line.begin()->first,
                       line.rbegin()->first, fmt::join(lines, "; "));
}

} // namespace

void add_over_axes(const StudyResult& result, std::vector<StudyFigure>& figures) {
    for (const StudyAxis& axis : result.study.axes)
        for (auto& [key, found] : readings_over(result, axis)) {
            const std::size_t most = found.most_a_point();
            std::set<std::string> drives;
            for (const auto& [line, values] : found.values)
                drives.insert(line.drive);
            plots::Figure figure;
            figure.title = capitalised(reading_label(key));
            figure.subtitle = most == 1 ? place_off_axis(result.cells[found.cells.front()], axis, drives.size() == 1)
                                        : fmt::format("median of up to {} cells a point{}", most,
                                                      most % 2 == 0 ? ", of two in the middle the smaller" : "");
            figure.width_px = 420.0;
            figure.height_px = 240.0 + 20.0 * static_cast<double>(found.values.size());
            if (found.bounds)
                figure.subtitle += "; bounds as if they were numbers";
            std::vector<double> xs, ys;
            for (const auto& [which, line] : found.values) {
                // Each cell of a sample of all axes at once has a value of its own: no line leads from one to the next.
                const bool is_sample = result.study.sample.kind == SampleKind::low_discrepancy;
                static constexpr const char* dashes[] = {"", "6 3", "1.5 2.5", "9 3 2 3", "14 4", "9 3 2 3 2 3"};
                const auto nth = static_cast<std::size_t>(std::distance(drives.begin(), drives.find(which.drive)));
                plots::Series series{line_name(result, which),        {},        plots::lamp_colour(which.lamp), 1.6,
                                     dashes[nth % std::size(dashes)], !is_sample};
                for (const auto& [x, values] : line) {
                    xs.push_back(x);
                    ys.push_back(median_of(values));
                    if (is_sample)
                        figure.series.push_back(
                            {x == line.begin()->first ? series.name : "", {{x, ys.back()}}, series.colour, 1.0, "", true});
                    else
                        series.points.push_back({x, ys.back()});
                }
                if (!is_sample)
                    figure.series.push_back(std::move(series));
            }
            figure.x = plots::axis_around(short_text(axis.name, 40), "", xs);
            figure.y = plots::axis_around(axis_label(key), unit_label(unit_of(key)), ys);
            const std::string name = file_name_of(fmt::format("axis_{}_{}", axis.name, name_of(key))),
                              title = words_over(result, axis, key, found);
            figures.push_back({{.name = "figures/" + name, .figure = std::move(figure), .scale = 2.0, .beside = true}, title, found.cells});
        }
}

} // namespace fernlicht
