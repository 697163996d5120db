#include "runner/play/live/live_figures.h"

#include "runner/files/clean_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

const char* outage_name(CanOutage::Kind kind) {
    return kind == CanOutage::Kind::down ? "down" : kind == CanOutage::Kind::removed ? "removed" : "bus_off";
}

Json quantiles_json(const std::vector<double>& samples) {
    if (samples.empty())
        return nullptr;
    return {{"p50", LiveFigures::quantile(samples, 0.5)},
            {"p99", LiveFigures::quantile(samples, 0.99)},
            {"max", LiveFigures::quantile(samples, 1.0)}};
}

Json socket_json(const CanSocketFigures& socket) {
    Json outages = Json::array();
    for (const CanOutage& outage : socket.outages)
        outages.push_back({{"kind", outage_name(outage.kind)},
                           {"from_s", 1e-9 * static_cast<double>(outage.from_ns)},
                           {"until_s", outage.until_ns == 0 ? Json(nullptr) : Json(1e-9 * static_cast<double>(outage.until_ns))}});
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
            {"outages", outages},
            {"receive_buffer_bytes", socket.receive_buffer_bytes},
            {"kernel_filters", socket.filters < 0 ? Json(nullptr) : Json(socket.filters)}};
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

nlohmann::ordered_json live_json(const LiveFigures& live) {
    Json json{{"interface", live.interface.empty() ? Json(nullptr) : Json(live.interface)},
              {"log", live.log.empty() ? Json(nullptr) : Json(live.log.string())},
              {"start_s", candump_stamp(live.start_ns)},
              {"period_s", live.period_s},
              {"listened_s", live.listened_s},
              {"ticks_planned", live.ticks_planned},
              {"ticks", live.late_s.size()},
              {"lateness_s", live.waited ? quantiles_json(live.late_s) : Json(nullptr)},
              {"work_s", live.waited ? quantiles_json(live.work_s) : Json(nullptr)},
              {"overruns", live.overruns},
              {"real_time_priority", live.punctuality.no_priority.empty()},
              {"locked_pages", live.punctuality.no_locked_pages.empty()},
              {"clock_set_by_s", 1e-9 * static_cast<double>(live.clock_set_by_ns)},
              {"frames_used", live.used},
              {"frames_late", live.late},
              {"latest_frame_s", live.latest_s},
              {"frames_from_future", live.from_future},
              {"frames_unused", live.unused},
              {"socket", live.interface.empty() ? Json(nullptr) : socket_json(live.socket)},
              {"outputs_due", live.outputs},
              {"recording", live.recording.empty() ? Json(nullptr) : Json(live.recording.string())},
              {"recorded", live.recorded},
              {"not_recorded", live.not_recorded},
              {"replay", live.replay}};
    json["pictures"] = live.drawing ? Json{{"moments", live.moments},
                                           {"drawn", live.drawn},
                                           {"skipped", live.moments - live.drawn},
                                           {"to_store", live.captures},
                                           {"stored", live.captured}}
                                    : Json(nullptr);
    return json;
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
        text += fmt::format("pictures   {} of {} moments drawn, {} skipped; {} of {} stored\n", live.drawn, live.moments,
                            live.moments - live.drawn, live.captured, live.captures);
    if (live.not_recorded > 0)
        text += fmt::format("recording  lacks {} frames: no room while the disk was slow\n", live.not_recorded);
    return text;
}

} // namespace fernlicht
