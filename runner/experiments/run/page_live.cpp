#include "runner/experiments/run/page_plots.h"
#include "runner/files/clean_text.h"
#include "runner/play/live/live_figures.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using kainjow::mustache::data;

data live_times_row(const std::string& what, const std::vector<double>& samples) {
    data row;
    row.set("what", what);
    for (const auto& [name, share] : {std::pair("p50", 0.5), std::pair("p99", 0.99), std::pair("max", 1.0)})
        row.set(name, figure(1e3 * LiveFigures::quantile(samples, share), 3));
    return row;
}

data live_loss_row(const std::string& what, std::uint64_t count, const std::string& of) {
    data row;
    row.set("what", what);
    row.set("count", fmt::format("{}", count));
    row.set("of", of);
    return row;
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

} // namespace

data live_part(const LiveFigures& live) {
    data part, times{data::type::list}, losses{data::type::list}, outages{data::type::list}, plots{data::type::list};
    part.set("summary", live_summary(live));
    part.set("waited", live.waited);
    times.push_back(live_times_row("a tick’s begin after its time", live.late_s));
    times.push_back(live_times_row("a tick’s work", live.work_s));
    part.set("times", times);
    if (live.waited) {
        losses.push_back(
            live_loss_row("ticks that ended after the next one’s time", live.overruns, fmt::format("of {}", live.late_s.size())));
        losses.push_back(
            live_loss_row("frames that came after the tick of their stamp", live.late,
                          fmt::format("of {}, by at most {:.3f} ms; they count for the next tick", live.used, 1e3 * live.latest_s)));
    }
    if (!live.interface.empty()) {
        const CanSocketFigures& socket = live.socket;
        losses.push_back(live_loss_row("frames dropped by the socket", socket.dropped, fmt::format("{} received", socket.received)));
        losses.push_back(live_loss_row("frames that were not sent", socket.superseded + socket.not_sent,
                                       fmt::format("of {}; {} for newer ones while the queue was full{}", live.outputs, socket.superseded,
                                                   socket.why_not_sent.empty() ? "" : ", else: " + clean_text(socket.why_not_sent))));
        losses.push_back(live_loss_row("error frames", socket.error_frames,
                                       fmt::format("{} of bus-off, {} of the controller", socket.bus_off, socket.controller)));
        for (const CanOutage& outage : socket.outages) {
            const char* const what = outage.kind == CanOutage::Kind::bus_off ? "Bus-off"
                                     : outage.kind == CanOutage::Kind::down  ? "Interface down"
                                                                             : "Interface removed";
            outages.push_back(fmt::format("{} at {:.2f} s, {}.", what, 1e-9 * static_cast<double>(outage.from_ns),
                                          outage.until_ns == 0
                                              ? "until the end"
                                              : fmt::format("for {:.2f} s", 1e-9 * static_cast<double>(outage.until_ns - outage.from_ns))));
        }
    }
    if (live.drawing)
        losses.push_back(live_loss_row("moments that were not drawn", static_cast<std::uint64_t>(live.moments - live.drawn),
                                       fmt::format("of {}; {} of {} to be stored were", live.moments, live.captured, live.captures)));
    if (!live.recording.empty())
        losses.push_back(live_loss_row("frames that the recording lacks", live.not_recorded, fmt::format("of {}", live.recorded)));
    part.set("losses", losses);
    part.set("has_outages", !outages.is_empty_list());
    part.set("outages", outages);
    for (const std::string& svg : live_svgs(live))
        plots.push_back(svg);
    part.set("plots", plots);
    part.set("has_replay", !live.replay.empty());
    part.set("recording", clean_text(live.recording.string()));
    part.set("replay", clean_text(live.replay));
    return part;
}

} // namespace fernlicht
