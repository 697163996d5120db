#include "runner/experiments/run/run_plots.h"
#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN(); // what plots leave out
constexpr const char* state_words[] = {"fresh", "stale", "missing", "out of range", "contradictory"};
constexpr plots::Colour state_colours[] = {{}, {230, 159, 0}, {120, 120, 120}, {213, 94, 0}, {148, 60, 160}};

const BusReport& bus_of(const ComparedDrive& drive) { return drive.lamp_sets.front()->bus; }

plots::Polyline bus_line(const BusReport& bus, const std::vector<std::optional<double>>& values) {
    plots::Polyline line;
    for (std::size_t i = 0; i < values.size(); ++i)
        line.push_back({bus.time_s[i], values[i].value_or(no_value)});
    return line;
}

/// The time axis that all figures of the section share.
plots::Axis time_axis(const BusReport& bus) {
    plots::Axis axis{"time", "s"};
    axis.from = bus.time_s.front();
    axis.to = std::max(bus.time_s.back(), axis.from + 1.0e-3);
    return axis;
}

/// Where the signal was not fresh, over the whole height; each state is named once.
void add_state_bands(plots::Figure& figure, const BusSignalReport& signal, double end_s) {
    bool named[5] = {};
    for (std::size_t i = 0; i < signal.states.size(); ++i) {
        const std::size_t state = signal.states[i].second;
        const double from = std::max(signal.states[i].first, figure.x.from),
                     to = std::min(i + 1 < signal.states.size() ? signal.states[i + 1].first : end_s, figure.x.to);
        if (state == 0 || from >= to)
            continue;
        figure.bands.push_back({named[state] ? "" : state_words[state],
                                {from, to},
                                {figure.y.from, figure.y.from},
                                {figure.y.to, figure.y.to},
                                state_colours[state],
                                0.3});
        named[state] = true;
    }
}

std::vector<double> numbers(const std::vector<std::optional<double>>& values) {
    std::vector<double> all;
    for (const std::optional<double>& value : values)
        if (value)
            all.push_back(*value);
    return all;
}

/// What was received may be anything: beyond the axis of what was used it is left out, and the band says why.
plots::Polyline inside(const plots::Axis& axis, plots::Polyline line) {
    for (plots::Point& point : line)
        if (!(point.y >= axis.from && point.y <= axis.to))
            point.y = no_value;
    return line;
}

plots::Figure signal_figure(const BusReport& bus, const BusSignalReport& signal) {
    plots::Figure figure;
    figure.title = short_text(signal.name, 60);
    figure.subtitle = short_text(signal.source + (signal.also.empty() ? "" : ", also " + signal.also), 80);
    figure.width_px = 640.0;
    figure.height_px = 260.0;
    figure.x = time_axis(bus);
    figure.y = plots::axis_around("value", signal.unit, numbers(numbers(signal.value).empty() ? signal.received : signal.value),
                                  plots::Scale::linear, true);
    add_state_bands(figure, signal, bus.end_s);
    const bool lone = bus.time_s.size() == 1, differs = signal.value != signal.received;
    if (differs && !numbers(signal.received).empty())
        figure.series.push_back({"as received", inside(figure.y, bus_line(bus, signal.received)), {150, 150, 150}, 1.2, "3 3", lone});
    if (!numbers(signal.value).empty())
        figure.series.push_back({differs ? "as used" : "", bus_line(bus, signal.value), {30, 90, 150}, 2.0, "", lone});
    return figure;
}

/// A line for each lamp set over time. `value`: time and value of a lamp set.
std::optional<plots::Figure> figure_over_time(const ComparedDrive& drive, const std::string& title, const std::string& label,
                                              const std::string& unit, const std::function<plots::Polyline(const PlayedCell&)>& line_of) {
    plots::Figure figure;
    std::vector<double> all;
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i) {
        plots::Polyline line = line_of(*drive.lamp_sets[i]);
        bool any = false;
        for (const plots::Point& point : line)
            if (std::isfinite(point.y)) {
                all.push_back(point.y);
                any = true;
            }
        const bool lone = line.size() == 1;
        if (any)
            figure.series.push_back({short_text(drive.lamp_sets[i]->lamp_set, 24), std::move(line), plots::lamp_colour(i), 2.0, "", lone});
    }
    if (figure.series.empty())
        return std::nullopt;
    figure.title = title;
    figure.width_px = 640.0;
    figure.height_px = 260.0;
    figure.x = time_axis(bus_of(drive));
    figure.y = plots::axis_around(label, unit, all, plots::Scale::linear, true);
    return figure;
}

std::optional<plots::Figure> reach_over_time(const ComparedDrive& drive, double threshold_lx) {
    const ExtentKey key{Surface::target, "own", threshold_lx};
    return figure_over_time(drive, fmt::format("Reach at {:g} lx on a facing target", threshold_lx), "reach, own lane", "m",
                            [&](const PlayedCell& played) {
                                plots::Polyline line;
                                for (const ExtentRow& row : played.extents) {
                                    const LaneExtent* extent = find_extent(row.rendered, key);
                                    extent = extent ? extent : find_extent(row.twin, key);
                                    line.push_back({row.time_s, extent ? extent->reach_centre_m : no_value});
                                }
                                return line;
                            });
}

std::optional<plots::Figure> glare_over_time(const ComparedDrive& drive) {
    const BusReport& bus = bus_of(drive);
    return figure_over_time(drive, "Light in oncoming eyes, 50 m ahead", "illuminance", "lx", [&](const PlayedCell& played) {
        plots::Polyline line;
        for (const SeeingSeries& series : played.seeing)
            for (const SeeingSeries::Column& column : series.columns)
                for (std::size_t i = 0; series.subject == "control" && column.name == "glare_at_50m_lx" && i < series.ticks.size(); ++i) {
                    const auto at = std::ranges::find(bus.frame, series.ticks[i]);
                    if (at != bus.frame.end())
                        line.push_back(
                            {bus.time_s[static_cast<std::size_t>(at - bus.frame.begin())], column.values[i].figure().value_or(no_value)});
                }
        return line;
    });
}

Table signals_table(const ComparedDrive& drive) {
    Table table{
        drive.name + "-signals",
        "",
        columns_of("signal<|source<|frames|age at most [s]|stale after [s]|last change [s]|state, of the ticks<|policies<|acted [ticks]"),
        {}};
    const auto seconds = [](const std::optional<double>& s, const char* none) { return s ? Cell(fmt::format("{:.3f}", *s), *s) : none; };
    for (const BusSignalReport& signal : bus_of(drive).signals) {
        std::uint64_t all = 0, acted = 0;
        for (std::size_t state = 0; state < 5; ++state) {
            all += signal.ticks[state];
            acted += signal.acted[state];
        }
        std::string shares, policies;
        for (std::size_t state = 0; state < 5; ++state) {
            if (signal.ticks[state] > 0)
                shares += fmt::format("{}{} {:.3g} %", shares.empty() ? "" : ", ", state_words[state],
                                      100.0 * static_cast<double>(signal.ticks[state]) / static_cast<double>(all));
            if (!signal.policies[state].empty())
                policies += fmt::format("{}{}: {}", policies.empty() ? "" : ", ", state_words[state], signal.policies[state]);
        }
        const std::string also =
            signal.also.empty() ? "" : fmt::format("; also {}, within {:.3g} {}", signal.also, signal.tolerance, signal.unit);
        table.rows.push_back(
            {short_text(signal.name, 80), short_text(signal.source, 140) + short_text(also, 200), fmt::format("{}", signal.frames),
             seconds(signal.frames > 0 ? std::optional(signal.oldest_s) : std::nullopt, "–"), seconds(signal.stale_after_s, "never"),
             seconds(signal.changed_s, "–"), shares, policies, fmt::format("{}", acted)});
    }
    return table;
}

} // namespace

void add_signals(const ComparedDrive& drive, std::vector<Section>& sections) {
    const BusReport& bus = bus_of(drive);
    if (bus.signals.empty() || bus.time_s.empty())
        return;
    std::vector<plots::Figure> figures;
    for (const double threshold_lx : plotted_thresholds_lx(drive))
        if (auto reach = reach_over_time(drive, threshold_lx))
            figures.push_back(std::move(*reach));
    if (auto glare = glare_over_time(drive))
        figures.push_back(std::move(*glare));
    Section& section = sections.emplace_back(Section{"Signals", {}, 3});
    section.blocks.emplace_back(fmt::format(
        "What a CAN bus said over the drive{}. {} frames of {} came until the drive’s end, and inputs read {} of them; {} were sent. Bands "
        "show where a signal was not fresh; a gap in the line is a lost signal.",
        figures.empty() ? "" : ", and reach and glare over the same time", bus.frames, bus.log.empty() ? "the bus" : bus.log, bus.read,
        bus.sent));
    section.blocks.emplace_back(signals_table(drive));
    for (const BusSignalReport& signal : bus.signals)
        add_plot(section, fmt::format("{}-signal-{}", drive.name, signal.name), signal_figure(bus, signal));
    add_plots(section, drive.name + "-signals", std::move(figures));
}

} // namespace fernlicht
