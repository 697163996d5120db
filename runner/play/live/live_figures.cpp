#include "runner/play/live/live_figures.h"

#include "runner/files/clean_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

const char* outage_name(CanOutage::Kind kind) {
    return kind == CanOutage::Kind::down ? "down" : kind == CanOutage::Kind::removed ? "removed" : "bus_off";
}

struct Lateness {
    double p50, p99, max;
};

/// nullopt without samples.
std::optional<Lateness> lateness_of(const LiveFigures& live, const std::vector<double>& samples) {
    if (samples.empty() || !live.waited)
        return std::nullopt;
    return Lateness{LiveFigures::quantile(samples, 0.5), LiveFigures::quantile(samples, 0.99), LiveFigures::quantile(samples, 1.0)};
}

JsonMembers lateness_members(Lateness& late) { return {{"p50", late.p50}, {"p99", late.p99}, {"max", late.max}}; }

JsonMembers outage_members(CanOutage& outage) {
    const double until_s = 1e-9 * static_cast<double>(outage.until_ns);
    return {{"kind", one_of(outage.kind, names_of<CanOutage::Kind>(outage_name, 3))},
            {"from_s", 1e-9 * static_cast<double>(outage.from_ns)},
            {"until_s", outage.until_ns == 0 ? std::nullopt : std::optional(until_s)}};
}

JsonMembers socket_members(CanSocketFigures& socket) {
    return {{"received", socket.received},
            {"dropped", socket.dropped},
            {"error_frames", socket.error_frames},
            {"bus_off", socket.bus_off},
            {"controller_problems", socket.controller},
            {"without_stamp", socket.without_stamp},
            {"sent", socket.sent},
            {"no_room_to_send", socket.no_room},
            {"superseded", socket.superseded},
            {"not_sent", socket.not_sent},
            {"why_not_sent", socket.why_not_sent},
            {"outages", socket.outages, outage_members},
            {"receive_buffer_bytes", socket.receive_buffer_bytes},
            {"kernel_filters", or_null(socket.filters, -1)}};
}

/// "0.082 ms"
std::string milliseconds(double seconds) { return fmt::format("{:.3f} ms", 1e3 * seconds); }

std::string of_samples(const std::vector<double>& samples) {
    return fmt::format("{} (p50), {} (p99), {} (max)", milliseconds(LiveFigures::quantile(samples, 0.5)),
                       milliseconds(LiveFigures::quantile(samples, 0.99)), milliseconds(LiveFigures::quantile(samples, 1.0)));
}

std::string outages_text(const std::vector<CanOutage>& outages) {
    std::string text;
    for (const CanOutage& outage : outages) {
        const char* const what = outage.kind == CanOutage::Kind::bus_off ? "bus-off"
                                 : outage.kind == CanOutage::Kind::down  ? "interface down"
                                                                         : "interface removed";
        text += fmt::format("{}{} at {:.2f} s", text.empty() ? "" : ", ", what, 1e-9 * static_cast<double>(outage.from_ns));
        text += outage.until_ns == 0 ? " to the end"
                                     : fmt::format(" for {:.2f} s", 1e-9 * static_cast<double>(outage.until_ns - outage.from_ns));
    }
    return text;
}

} // namespace

double LiveFigures::quantile(std::vector<double> samples, double share) {
    if (samples.empty())
        return 0.0;
    std::ranges::sort(samples);
    const double place = share * static_cast<double>(samples.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    return std::lerp(samples[below], samples[std::min(below + 1, samples.size() - 1)], place - static_cast<double>(below));
}

std::string candump_stamp(std::int64_t time_ns) { return fmt::format("{}.{:06}", time_ns / 1'000'000'000, time_ns / 1000 % 1'000'000); }

JsonMembers live_members(LiveFigures& live) {
    return {{"interface", or_null(live.interface)},
            {"log", live.log.empty() ? std::nullopt : std::optional(live.log.string())},
            {"start_s", candump_stamp(live.start_ns)},
            {"period_s", live.period_s},
            {"listened_s", live.listened_s},
            {"ticks_planned", live.ticks_planned},
            {"ticks", live.late_s.size()},
            {"lateness_s", lateness_of(live, live.late_s), lateness_members},
            {"work_s", lateness_of(live, live.work_s), lateness_members},
            {"overruns", live.overruns},
            {"real_time_priority", live.punctuality.no_priority.empty()},
            {"locked_pages", live.punctuality.no_locked_pages.empty()},
            {"clock_set_by_s", 1e-9 * static_cast<double>(live.clock_set_by_ns)},
            {"frames_used", live.used},
            {"frames_late", live.late},
            {"latest_frame_s", live.latest_s},
            {"frames_from_future", live.from_future},
            {"frames_unused", live.unused},
            {"socket", null_unless(!live.interface.empty(), socket_members(live.socket))},
            {"outputs_due", live.outputs},
            {"recording", live.recording.empty() ? std::nullopt : std::optional(live.recording.string())},
            {"recorded", live.recorded},
            {"not_recorded", live.not_recorded},
            {"replay", live.replay},
            {"pictures", null_unless(live.drawing, JsonMembers{{"moments", live.moments},
                                                               {"drawn", live.drawn},
                                                               {"skipped", live.moments - live.drawn},
                                                               {"to_store", live.captures},
                                                               {"stored", live.captured}})}};
}

std::string live_text(const LiveFigures& live) {
    std::string text = fmt::format("ticks      {} of {}, every {:g} ms", live.late_s.size(), live.ticks_planned, 1e3 * live.period_s);
    text += live.waited ? fmt::format("; late by {}; {} overran\n", of_samples(live.late_s), live.overruns) : ", without waiting\n";
    text += fmt::format("frames     {} used", live.used);
    text += live.waited ? fmt::format(", {} of them late, by at most {}\n", live.late, milliseconds(live.latest_s)) : "\n";
    if (!live.interface.empty()) {
        const CanSocketFigures& socket = live.socket;
        text +=
            fmt::format("{:<10} {} received, {} dropped by the socket, {} error frames; {} sent of {} due, {} superseded, {} failed{}\n",
                        live.interface, socket.received, socket.dropped, socket.error_frames, socket.sent, live.outputs, socket.superseded,
                        socket.not_sent, socket.why_not_sent.empty() ? "" : " (" + socket.why_not_sent + ")");
        if (!socket.outages.empty())
            text += fmt::format("{:<10} {}\n", "outages", outages_text(socket.outages));
    }
    if (!live.punctuality.no_priority.empty() || !live.punctuality.no_locked_pages.empty())
        text += fmt::format("{:<10} without {}{}{}\n", "real time", live.punctuality.no_priority.empty() ? "" : "SCHED_FIFO",
                            !live.punctuality.no_priority.empty() && !live.punctuality.no_locked_pages.empty() ? " and " : "",
                            live.punctuality.no_locked_pages.empty() ? "" : "mlockall");
    if (live.drawing)
        text += fmt::format("pictures   {} of {} moments rendered, {} skipped; {} of {} stored\n", live.drawn, live.moments,
                            live.moments - live.drawn, live.captured, live.captures);
    if (live.not_recorded > 0)
        text += fmt::format("recording  lacks {} frames: no room while the disk was slow\n", live.not_recorded);
    return text;
}

} // namespace fernlicht
