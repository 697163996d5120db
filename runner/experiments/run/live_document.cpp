#include "runner/experiments/run/run_document.h"
#include "runner/experiments/run/run_plots.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/play/live/live_figures.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

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
        add("moments that were not drawn", static_cast<std::uint64_t>(live.moments - live.drawn),
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
    add_plots(section, "live", live_svgs(live));
    if (!live.replay.empty())
        section.blocks.emplace_back(fmt::format("Recorded in `{}`; the same drive from it: `{}`", live.recording.string(), live.replay));
    return section;
}

} // namespace fernlicht
