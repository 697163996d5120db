#include "runner/experiments/history/history_document.h"

#include "metrics/readings/reading_labels.h"
#include "runner/files/clean_text.h"
#include "runner/files/output_folder.h"
#include "runner/findings/figures.h"
#include "runner/findings/plots/drawing.h"
#include "scenarios/values/glob.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_nights = 120, most_routes = 40, longest_name = 100;
constexpr double least_names_px = 310.0, lamp_px = 250.0, line_px = 130.0, row_px = 34.0, head_px = 52.0;
constexpr plots::Colour dark{40, 40, 40}, faint{150, 150, 150};

const plots::Colour& change_colour() {
    static const plots::Colour colour = plots::series_colour(4);
    return colour;
}

/// What stands in one row: all but the lamp.
std::string route_of(const NightCell& cell) {
    return fmt::format("{}{}{}", cell.drive, cell.condition.empty() ? "" : ", ", cell.condition);
}

template <class List> void add_once(std::vector<std::string>& all, const List& more) {
    for (const std::string& one : more)
        if (std::ranges::find(all, one) == all.end())
            all.push_back(one);
}

/// Times of another CPU are of another line.
bool is_shown(const HistoryFindings& findings, std::size_t night, const std::string& reading) {
    return reading != timed_frame || machine_in(findings.nights[night], "CPU") == machine_in(findings.tonight(), "CPU");
}

std::optional<double> figure_of(const NightCell& cell, const std::string& reading) {
    if (reading == timed_frame)
        return cell.frame_s;
    const auto found = cell.readings->find(reading);
    return found == cell.readings->end() ? std::nullopt : found->second.figure();
}

/// What moved most, one reading of each change, then what decides.
std::vector<std::string> readings_to_show(const HistoryFindings& findings, std::size_t most) {
    std::vector<std::string> names;
    for (const HistoryEvent& event : findings.events)
        if (!event.moved.empty())
            add_once(names, std::vector{event.moved.front().reading});
    for (const HistoryDrift& drift : findings.drifts)
        add_once(names, std::vector{drift.moved.front().reading});
    for (const std::string& pattern : findings.tonight().decide)
        for (const NightCell& cell : findings.tonight().cells)
            for (const auto& [name, value] : *cell.readings)
                if (matches(pattern, name) && value.measured()) {
                    add_once(names, std::vector{name});
                    break;
                }
    if (names.empty() && !findings.tonight().cells.empty())
        for (const auto& [name, value] : *findings.tonight().cells.front().readings)
            add_once(names, std::vector{name});
    names.resize(std::min(most, names.size()));
    return names;
}

/// One small line: a dot where the reading changed, a ring's place for the accepted night, the last figure beside it.
void draw_line(plots::Drawing& drawing, const HistoryFindings& findings, const std::string& cell, const std::string& reading, double left,
               double top) {
    const std::size_t first = findings.nights.size() > most_nights ? findings.nights.size() - most_nights : 0;
    plots::Polyline line;
    for (std::size_t i = first; i < findings.nights.size(); ++i)
        if (const NightCell* one = findings.nights[i].cell(cell); one && one->failed.empty() && is_shown(findings, i, reading))
            if (const std::optional<double> figure = figure_of(*one, reading))
                line.push_back({static_cast<double>(i), *figure});
    if (line.empty()) {
        drawing.text(left, top + 20.0, "not measured", {.size_px = 11.0, .colour = faint});
        return;
    }
    const auto [least, most] = std::ranges::minmax_element(line, {}, &plots::Point::y);
    const double low = least->y, span = most->y - least->y, nights = std::max(1.0, static_cast<double>(findings.nights.size() - 1 - first));
    const auto place = [&](const plots::Point& point) {
        return plots::Point{left + line_px * (point.x - static_cast<double>(first)) / nights,
                            top + row_px - 10.0 - (span > 0.0 ? (row_px - 16.0) * (point.y - low) / span : 0.5 * (row_px - 16.0))};
    };
    plots::Polyline placed;
    for (const plots::Point& point : line)
        placed.push_back(place(point));
    drawing.line(placed, {.colour = dark, .width_px = 1.2});
    const std::optional<double> accepted = [&]() -> std::optional<double> {
        const NightCell* const one = findings.before().cell(cell);
        return one && is_shown(findings, findings.base, reading) ? figure_of(*one, reading) : std::nullopt;
    }();
    if (accepted && findings.base >= first)
        drawing.dot(place({static_cast<double>(findings.base), *accepted}), 2.6, faint);
    for (std::size_t i = 1; reading != timed_frame && i < line.size(); ++i)
        if (line[i].y != line[i - 1].y) {
            const Night &earlier = findings.nights[static_cast<std::size_t>(line[i - 1].x)],
                        &later = findings.nights[static_cast<std::size_t>(line[i].x)];
            if (is_beyond(line[i - 1].y, line[i].y, 0.0, changes_between(earlier, *earlier.cell(cell), later, *later.cell(cell))))
                drawing.dot(placed[i], 2.2, change_colour());
        }
    const std::string share = accepted ? told_share(MovedReading{"", "", Value(*accepted), Value(line.back().y)}.share()) : "";
    const Value last(reading == timed_frame ? 1e3 * line.back().y : line.back().y);
    drawing.text(left + line_px + 8.0, top + 16.0, reading == timed_frame ? four_digits(*last.figure()) + " ms" : told_value(reading, last),
                 {.size_px = 11.0, .colour = dark});
    const char* const as_base = findings.is_accepted() ? "as accepted" : "as in the first night";
    drawing.text(left + line_px + 8.0, top + 28.0, accepted && *accepted == line.back().y ? as_base : share,
                 {.size_px = 9.5, .colour = faint});
}

std::optional<Plot> sparkline_plot(const HistoryFindings& findings, const std::string& reading) {
    std::vector<std::string> lamps, routes;
    for (const NightCell& cell : findings.tonight().cells)
        if (figure_of(cell, reading)) {
            add_once(lamps, std::vector{cell.lamp});
            add_once(routes, std::vector{route_of(cell) + (cell.technique.empty() ? "" : "; " + cell.technique)});
        }
    if (routes.empty())
        return std::nullopt;
    const std::size_t shown = std::min(most_routes, routes.size());
    double names_px = least_names_px; // as wide as the longest name
    for (std::size_t row = 0; row < shown; ++row)
        names_px = std::max(names_px, plots::text_width(short_text(routes[row], longest_name), 11.0) + 24.0);
    plots::Drawing drawing;
    drawing.width = names_px + lamp_px * static_cast<double>(lamps.size());
    drawing.height = head_px + row_px * static_cast<double>(shown) + 4.0;
    drawing.title = label_of_reading(reading);
    drawing.rectangle(0.0, 0.0, drawing.width, drawing.height, {.fill = "white"});
    drawing.text(8.0, 20.0, label_of_reading(reading), {.size_px = 13.0, .colour = dark, .bold = true});
    for (std::size_t i = 0; i < lamps.size(); ++i)
        drawing.text(names_px + lamp_px * static_cast<double>(i), 42.0, short_text(lamps[i], 34), {.size_px = 12.0, .colour = dark});
    for (std::size_t row = 0; row < shown; ++row)
        drawing.text(8.0, head_px + row_px * static_cast<double>(row) + 20.0, short_text(routes[row], longest_name),
                     {.size_px = 11.0, .colour = dark});
    for (const NightCell& cell : findings.tonight().cells) {
        const auto route = static_cast<std::size_t>(
            std::ranges::find(routes, route_of(cell) + (cell.technique.empty() ? "" : "; " + cell.technique)) - routes.begin());
        const auto lamp = static_cast<std::size_t>(std::ranges::find(lamps, cell.lamp) - lamps.begin());
        if (route < shown && lamp < lamps.size())
            draw_line(drawing, findings, cell.name, reading, names_px + lamp_px * static_cast<double>(lamp),
                      head_px + row_px * static_cast<double>(route));
    }
    std::vector<std::string> captions{fmt::format("each line has its own scale, over {}; grey: {}; coloured: nights in which it changed",
                                                  counted(std::min(most_nights, findings.nights.size()), "night"),
                                                  findings.when(findings.base))};
    if (shown < routes.size())
        captions.push_back(fmt::format("{} of {} routes", shown, routes.size()));
    return Plot{.name = "history-" + file_name_of(reading), .figure = std::move(drawing), .captions = std::move(captions)};
}

} // namespace

std::vector<Plot> sparklines(const HistoryFindings& findings, std::size_t most) {
    std::vector<Plot> plots;
    std::vector<std::string> readings = readings_to_show(findings, most);
    readings.emplace_back(timed_frame);
    for (const std::string& reading : readings)
        if (std::optional<Plot> plot = sparkline_plot(findings, reading))
            plots.push_back(std::move(*plot));
    return plots;
}

} // namespace fernlicht
