#include "runner/experiments/run/run_document.h"

#include "runner/experiments/run/run_plots.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/play/live/live_figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace fernlicht {
namespace {

constexpr double shortest_s = 1e-6; ///< what is less late is drawn as this
constexpr int bins_a_decade = 10;
constexpr plots::Colour ink{0, 114, 178}, outage_ink{213, 94, 0};

/// Stairs, each bin as wide as it is on the axis.
plots::Figure histogram_figure(const LiveFigures& live) {
    const double longest_s = std::max(2.0 * shortest_s, LiveFigures::quantile(live.late_s, 1.0));
    const int bins = static_cast<int>(std::ceil(bins_a_decade * std::log10(longest_s / shortest_s))) + 1;
    std::vector<double> counts(static_cast<std::size_t>(bins), 0.0);
    for (const double late_s : live.late_s)
        ++counts[static_cast<std::size_t>(
            std::clamp(static_cast<int>(bins_a_decade * std::log10(std::max(late_s, shortest_s) / shortest_s)), 0, bins - 1))];
    plots::Figure figure;
    figure.title = "How late ticks began";
    figure.subtitle = fmt::format("{} ticks every {:g} ms", live.late_s.size(), 1e3 * live.period_s);
    figure.height_px = 360.0;
    plots::Band band;
    band.colour = ink;
    band.opacity = 0.45;
    plots::Series line{.colour = ink, .width_px = 1.2};
    constexpr double none = 0.5; // below one tick, on a logarithmic axis
    for (int bin = 0; bin < bins; ++bin)
        for (const int end : {bin, bin + 1}) {
            const double ms = 1e3 * shortest_s * std::pow(10.0, static_cast<double>(end) / bins_a_decade);
            const double count = std::max(none, counts[static_cast<std::size_t>(bin)]);
            band.x.push_back(ms);
            band.low.push_back(none);
            band.high.push_back(count);
            line.points.push_back({ms, count});
        }
    figure.x = {"late", "ms", band.x.front(), band.x.back(), plots::Scale::logarithmic};
    figure.y = {"ticks", "", none, 2.0 * std::max(1.0, *std::ranges::max_element(counts)), plots::Scale::logarithmic};
    figure.bands.push_back(std::move(band));
    figure.series.push_back(std::move(line));
    for (const auto& [share, name] : {std::pair(0.5, "p50"), std::pair(0.99, "p99")})
        figure.marks.push_back({.across = plots::Mark::Across::at_x,
                                .value = 1e3 * std::max(shortest_s, LiveFigures::quantile(live.late_s, share)),
                                .label = name});
    if (1e3 * live.period_s < figure.x.to)
        figure.marks.push_back({.across = plots::Mark::Across::at_x, .value = 1e3 * live.period_s, .label = "a whole period"});
    return figure;
}

/// The worst of each part of the drive; a point for each of 24000 ticks would say no more.
plots::Figure over_drive_figure(const LiveFigures& live) {
    constexpr std::size_t max_points = 400;
    const std::size_t ticks = live.late_s.size(), step = (ticks + max_points - 1) / max_points;
    plots::Series line{.name = "worst of each part", .colour = ink, .width_px = 1.2};
    for (std::size_t from = 0; from < ticks; from += step) {
        const auto part = std::span(live.late_s).subspan(from, std::min(step, ticks - from));
        line.points.push_back({static_cast<double>(from) * live.period_s, 1e3 * std::max(shortest_s, *std::ranges::max_element(part))});
    }
    std::vector<double> late_ms;
    for (const plots::Point& point : line.points)
        late_ms.push_back(point.y);
    plots::Figure figure;
    figure.title = "Lateness over the drive";
    figure.height_px = 300.0;
    figure.x = {"time", "s", 0.0, std::max(live.period_s, static_cast<double>(ticks) * live.period_s)};
    figure.y = plots::axis_around("late", "ms", late_ms, plots::Scale::logarithmic);
    figure.series.push_back(std::move(line));
    for (const CanOutage& outage : live.socket.outages)
        if (outage.from_ns >= 0)
            figure.marks.push_back({.across = plots::Mark::Across::at_x,
                                    .value = 1e-9 * static_cast<double>(outage.from_ns),
                                    .label = outage.kind == CanOutage::Kind::bus_off ? "bus-off" : "interface away",
                                    .colour = outage_ink});
    return figure;
}

std::string live_summary(const LiveFigures& live) {
    std::string text = fmt::format(
        "{} of {} control ticks every {:g} ms, {} frames used of {}, {} sent.", live.late_s.size(), live.ticks_planned, 1e3 * live.period_s,
        live.used, live.interface.empty() ? short_text(live.log.string(), 80) : short_text(live.interface, 20), live.outputs);
    if (!live.waited)
        text += " Played without waiting: there is no lateness to tell.";
    if (!live.interface.empty())
        text += fmt::format(" Stamps and filters are the kernel's ({}); its buffer for this socket holds {:.0f} KiB.",
                            live.socket.filters < 0 ? "no filter" : fmt::format("{} identifiers", live.socket.filters),
                            static_cast<double>(live.socket.receive_buffer_bytes) / 1024.0);
    if (!live.punctuality.no_priority.empty())
        text += " Without real-time priority: " + live.punctuality.no_priority + ".";
    if (!live.punctuality.no_locked_pages.empty())
        text += " Without locked memory: " + live.punctuality.no_locked_pages + ".";
    return text;
}

Table punctuality_table(const LiveFigures& live) {
    Table table{"punctuality", "How punctual it was", columns_of("what<|p50 [ms]|p99 [ms]|max [ms]"), {}};
    for (const auto& [what, samples] :
         {std::pair("a tick’s begin after its time", &live.late_s), std::pair("a tick’s work", &live.work_s)}) {
        std::vector<Cell>& row = table.rows.emplace_back(std::vector<Cell>{what});
        for (const double share : {0.5, 0.99, 1.0}) {
            const double ms = 1e3 * LiveFigures::quantile(*samples, share);
            row.emplace_back(figure(ms, 3), ms);
        }
    }
    return table;
}

Table losses_table(const LiveFigures& live) {
    Table table{"losses", "What was lost", columns_of("what<|count|of<"), {}};
    const auto add = [&](const char* what, std::uint64_t count, const std::string& of) {
        table.rows.push_back({what, fmt::format("{}", count), of});
    };
    if (live.waited) {
        add("ticks that ended after the next one’s time", live.overruns, fmt::format("of {}", live.late_s.size()));
        add("frames that came after the tick of their stamp", live.late,
            fmt::format("of {}, by at most {:.3f} ms; they count for the next tick", live.used, 1e3 * live.latest_s));
    }
    if (!live.interface.empty()) {
        const CanSocketFigures& socket = live.socket;
        add("frames dropped by the socket", socket.dropped, fmt::format("{} received", socket.received));
        add("frames that were not sent", socket.superseded + socket.not_sent,
            fmt::format("of {}; {} for newer ones while the queue was full{}", live.outputs, socket.superseded,
                        socket.why_not_sent.empty() ? "" : ", else: " + socket.why_not_sent));
        add("error frames", socket.error_frames, fmt::format("{} of bus-off, {} of the controller", socket.bus_off, socket.controller));
    }
    if (live.drawing)
        add("moments that were not rendered", static_cast<std::uint64_t>(live.moments - live.drawn),
            fmt::format("of {}; {} of {} to be stored were", live.moments, live.captured, live.captures));
    if (!live.recording.empty())
        add("frames that the recording lacks", live.not_recorded, fmt::format("of {}", live.recorded));
    return table;
}

std::string outage_words(const CanOutage& outage) {
    const char* const what = outage.kind == CanOutage::Kind::bus_off ? "Bus-off"
                             : outage.kind == CanOutage::Kind::down  ? "Interface down"
                                                                     : "Interface removed";
    return fmt::format("{} at {:.2f} s, {}", what, 1e-9 * static_cast<double>(outage.from_ns),
                       outage.until_ns == 0 ? "until the end"
                                            : fmt::format("for {:.2f} s", 1e-9 * static_cast<double>(outage.until_ns - outage.from_ns)));
}

} // namespace

std::vector<plots::Figure> lateness_figures(const LiveFigures& live) {
    if (live.late_s.empty() || !live.waited)
        return {};
    return {histogram_figure(live), over_drive_figure(live)};
}

Section live_section(const LiveFigures& live) {
    Section section{"On the bus", {live_summary(live)}};
    if (live.waited)
        section.blocks.emplace_back(punctuality_table(live));
    section.blocks.emplace_back(losses_table(live));
    Listing outages;
    if (!live.interface.empty())
        for (const CanOutage& outage : live.socket.outages)
            outages.items.push_back(outage_words(outage));
    if (!outages.items.empty())
        section.blocks.emplace_back(std::move(outages));
    add_plots(section, "live", lateness_figures(live));
    if (!live.replay.empty())
        section.blocks.emplace_back(fmt::format("Recorded in `{}`; the same drive from it: `{}`", live.recording.string(), live.replay));
    return section;
}

} // namespace fernlicht
