#include "runner/commands/commands.h"

#include "renderer/gpu_timer.h"
#include "renderer/renderer.h"
#include "runner/findings/library_versions.h"
#include "runner/findings/run_context.h"
#include "runner/play/live/can_socket.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

void line(const char* what, const std::string& text) { fmt::print("{:<16} {}\n", what, text); }

/// Every way to draw, tried; true when at least one works.
bool tell_backends() {
    bool can_draw = false;
    for (const BackendAttempt& attempt : try_all_backends()) {
        const char* name = attempt.backend.c_str();
        if (!attempt.works) {
            line(name, "fails: " + attempt.failure);
            continue;
        }
        line(name, fmt::format("works: OpenGL {} on {} ({})", attempt.info.gl_version, attempt.info.gl_renderer, attempt.info.gl_vendor));
        can_draw = true;
    }
    return can_draw;
}

/// What a run with --backend auto would use; false when it computes light wrongly.
bool tell_chosen() {
    Device device = open_device("auto");
    line("auto", device.info().backend);
    try {
        line("sanity", fmt::format("a wall at 25 m is lit rightly: worst error {:.1e} of the illuminance, bound {:.0e}",
                                   check_sanity(device), sanity_bound));
    } catch (const DeviceError& error) {
        line("sanity", error.what());
        return false;
    }
    const TimerCheck timer = check_timer(device);
    line("GPU clock",
         fmt::format("GL_TIME_ELAPSED says {:.2f} ms of a load that takes {:.2f} ms: {}", 1e3 * timer.query_s, 1e3 * timer.finish_s,
                     timer.agrees() ? "it is used for passes" : "GPU times are not measured here, passes are timed finish to finish"));
    const ReadBackCheck reading = check_read_back(device);
    line("read back", fmt::format("{:.2f} ms a frame plainly, {:.2f} ms overlapped: {}", 1e3 * reading.plain_s, 1e3 * reading.overlapped_s,
                                  reading.faster() == ReadBack::plain ? "plain" : "overlapped"));
    return true;
}

void tell_machine() {
    const KernelCan can = probe_kernel_can();
    if (can.available)
        line("kernel CAN",
             fmt::format("present, interfaces: {}", can.interfaces.empty() ? "none" : fmt::format("{}", fmt::join(can.interfaces, ", "))));
    else
        line("kernel CAN", "absent: " + can.reason);
    std::error_code error;
    const std::filesystem::space_info space = std::filesystem::space(".", error);
    line("disk", error ? "unknown: " + error.message()
                       : fmt::format("{:.1f} GiB free in this folder", static_cast<double>(space.available) / (1 << 30)));
    line("CPU", fmt::format("{} ({})", cpu_name(), simd_class()));
    line("system", os_name());
    for (const auto& [name, version] : library_versions())
        line(name.c_str(), version);
}

int doctor() {
    bool works = tell_backends();
    if (works)
        works = tell_chosen();
    else
        line("auto", "nothing here can render");
    tell_machine();
    return works ? 0 : 3;
}

} // namespace

void add_doctor_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    CLI::App* command = app.add_subcommand("doctor", "report which backends work on this machine; exit with 3 if none does");
    command->callback([&chosen] { chosen = doctor; });
}

} // namespace fernlicht
