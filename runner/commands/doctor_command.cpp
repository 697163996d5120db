#include "runner/commands/commands.h"

#include "renderer/gpu_timer.h"
#include "renderer/renderer.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/files/json_text.h"
#include "runner/findings/library_versions.h"
#include "runner/findings/run_context.h"
#include "runner/play/live/can_socket.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace fernlicht {
namespace {

/// What was found, for people line by line as it is found, and for programs.
struct Told {
    bool json = false;
    nlohmann::ordered_json found = nlohmann::ordered_json::object();

    void line(const char* what, const std::string& text) const {
        if (!json)
            fmt::print("{:<16} {}\n", what, text);
    }
};

/// Every way to draw, tried; true when at least one works.
bool tell_backends(Told& told) {
    bool can_draw = false;
    for (const BackendAttempt& attempt : try_all_backends()) {
        const char* name = attempt.backend.c_str();
        told.found["backends"].push_back({{"name", attempt.backend}, {"works", attempt.works}});
        nlohmann::ordered_json& one = told.found["backends"].back();
        if (!attempt.works) {
            told.line(name, "fails: " + attempt.failure);
            one["why_not"] = attempt.failure;
            continue;
        }
        told.line(name,
                  fmt::format("works: OpenGL {} on {} ({})", attempt.info.gl_version, attempt.info.gl_renderer, attempt.info.gl_vendor));
        one.update(
            {{"gl_version", attempt.info.gl_version}, {"gl_renderer", attempt.info.gl_renderer}, {"gl_vendor", attempt.info.gl_vendor}});
        can_draw = true;
    }
    return can_draw;
}

/// What a run with --backend auto would use; false when it computes light wrongly.
bool tell_chosen(Told& told) {
    Device device = open_device("auto");
    told.line("auto", device.info().backend);
    told.found["auto"] = device.info().backend;
    try {
        const double error = check_sanity(device);
        told.line("sanity",
                  fmt::format("a wall at 25 m is lit rightly: worst error {:.1e} of the illuminance, bound {:.0e}", error, sanity_bound));
        told.found["sanity"] = {{"worst_error", error}, {"bound", sanity_bound}};
    } catch (const DeviceError& error) {
        told.line("sanity", error.what());
        told.found["sanity"] = {{"failed", error.what()}};
        return false;
    }
    const TimerCheck timer = check_timer(device);
    told.line("GPU clock",
              fmt::format("GL_TIME_ELAPSED says {:.2f} ms of a load that takes {:.2f} ms: {}", 1e3 * timer.query_s, 1e3 * timer.finish_s,
                          timer.agrees() ? "it is used for passes" : "GPU times are not measured here, passes are timed finish to finish"));
    told.found["gpu_clock"] = {{"query_s", timer.query_s}, {"finish_s", timer.finish_s}, {"used", timer.agrees()}};
    const ReadBackCheck reading = check_read_back(device);
    const char* const faster = reading.faster() == ReadBack::plain ? "plain" : "overlapped";
    told.line("read back", fmt::format("{:.2f} ms a frame plainly, {:.2f} ms overlapped: {}", 1e3 * reading.plain_s,
                                       1e3 * reading.overlapped_s, faster));
    told.found["read_back"] = {{"plain_s", reading.plain_s}, {"overlapped_s", reading.overlapped_s}, {"used", faster}};
    return true;
}

void tell_machine(Told& told) {
    const KernelCan can = probe_kernel_can();
    if (can.available)
        told.line("kernel CAN", fmt::format("present, interfaces: {}",
                                            can.interfaces.empty() ? "none" : fmt::format("{}", fmt::join(can.interfaces, ", "))));
    else
        told.line("kernel CAN", "absent: " + can.reason);
    told.found["kernel_can"] = {{"present", can.available}, {"interfaces", can.interfaces}};
    std::error_code error;
    const std::filesystem::space_info space = std::filesystem::space(".", error);
    told.line("disk", error ? "unknown: " + error.message()
                            : fmt::format("{:.1f} GiB free in this folder", static_cast<double>(space.available) / (1 << 30)));
    told.found["disk_free_bytes"] = error ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(space.available);
    told.line("CPU", fmt::format("{} ({})", cpu_name(), simd_class()));
    told.found["cpu"] = {{"name", cpu_name()}, {"class", simd_class()}};
    told.line("system", os_name());
    told.found["system"] = os_name();
    for (const auto& [name, version] : library_versions()) {
        told.line(name.c_str(), version);
        told.found["versions"][name] = version;
    }
}

int doctor(bool json) {
    Told told{.json = json};
    bool works = tell_backends(told);
    if (works)
        works = tell_chosen(told);
    else
        told.line("auto", "nothing here can render");
    tell_machine(told);
    if (json) {
        told.found["works"] = works;
        fmt::print("{}", json_text(told.found));
    }
    return works ? 0 : 3;
}

} // namespace

void add_doctor_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto json = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("doctor", "report which backends work on this machine; exit with 3 if none does");
    add_shared(*command, "--json", *json);
    command->callback([json, &chosen] { chosen = [json] { return doctor(*json); }; });
}

} // namespace fernlicht
