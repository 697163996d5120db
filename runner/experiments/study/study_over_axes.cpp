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

constexpr std::size_t most_readings = 6;

/// Of two in the middle the smaller.
double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// One reading over one axis.
struct OverAxis {
    std::map<std::size_t, std::map<double, std::vector<double>>> values; ///< by lamp, then by value of the axis: one a cell
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

OverAxis over(const StudyResult& result, const StudyAxis& axis, const ReadingKey& key) {
    OverAxis found;
    for (std::size_t i = 0; i < result.cells.size(); ++i) {
        const CellResult& cell = result.cells[i];
        const auto at = std::ranges::find(cell.cell.axes, axis.name, &AxisValue::axis);
        const auto reading = cell.readings.find(key);
        if (at == cell.cell.axes.end() || reading == cell.readings.end() || !reading->second.value.measured())
            continue;
        if (const std::optional<double> x = to_number(at->value)) {
            found.values[cell.cell.lamp][*x].push_back(*reading->second.value.figure());
            found.cells.push_back(i);
            found.bounds = found.bounds || reading->second.value.censored();
        }
    }
    return found;
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

/// Drive and condition of a cell but for the axis.
std::string place_off_axis(const CellResult& cell, const StudyAxis& axis) {
    std::string text = cell.title + "; " + cell.cell.condition;
    for (const AxisValue& value : cell.cell.axes)
        if (const std::string told = fmt::format(", {} {}", axis.name, value.value);
            value.axis == axis.name && text.find(told) < text.size())
            text.erase(text.find(told), told.size());
    return text;
}

std::string words_over(const StudyResult& result, const StudyAxis& axis, const ReadingKey& key, const OverAxis& found) {
    std::vector<std::string> lamps;
    for (const auto& [lamp, line] : found.values)
        if (line.size() > 1)
            lamps.push_back(fmt::format("{} from {:.4g} to {:.4g}{}", result.study.lamps[lamp].name, median_of(line.begin()->second),
                                        median_of(line.rbegin()->second), unit_suffix(unit_of(key))));
    const auto& line = std::ranges::max_element(found.values, {}, [](const auto& one) { return one.second.size(); })->second;
    return fmt::format("{}, {} from {:g} to {:g}: {}", capitalised(reading_label(key)), axis.name, line.begin()->first,
                       line.rbegin()->first, fmt::join(lamps, ", "));
}

} // namespace

void add_over_axes(const StudyResult& result, std::vector<StudyFigure>& figures) {
    for (const StudyAxis& axis : result.study.axes)
        for (auto& [key, found] : readings_over(result, axis)) {
            const std::size_t most = found.most_a_point();
            plots::Figure figure;
            figure.title = capitalised(reading_label(key));
            figure.subtitle = most == 1 ? place_off_axis(result.cells[found.cells.front()], axis)
                                        : fmt::format("median of up to {} cells a point, the smaller of the middle two", most);
            figure.width_px = 420.0;
            figure.height_px = 230.0;
            if (found.bounds)
                figure.subtitle += "; bounds as if they were numbers";
            std::vector<double> xs, ys;
            for (const auto& [lamp, line] : found.values) {
                // Each cell of a sample of all axes at once has a value of its own: no line leads from one to the next.
                const bool is_sample = result.study.sample.kind == SampleKind::low_discrepancy;
                plots::Series series{short_text(result.study.lamps[lamp].name, 24), {}, plots::lamp_colour(lamp), 1.6, "", !is_sample};
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
            figure.y = plots::axis_around("reading", unit_label(unit_of(key)), ys);
            const std::string name = file_name_of(fmt::format("axis_{}_{}", axis.name, name_of(key))),
                              title = words_over(result, axis, key, found);
            figures.push_back({{.name = "figures/" + name, .figure = std::move(figure), .scale = 2.0, .beside = true}, title, found.cells});
        }
}

} // namespace fernlicht
