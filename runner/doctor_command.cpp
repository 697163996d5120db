#include "runner/doctor_command.h"

#include "renderer/device.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace fernlicht {
namespace {

int doctor() {
    bool can_draw = false;
    for (const BackendAttempt& attempt : try_all_backends()) {
        if (attempt.works)
            fmt::print("{:<14} works   OpenGL {} on {}\n", attempt.backend, attempt.info.gl_version, attempt.info.gl_renderer);
        else
            fmt::print("{:<14} fails   {}\n", attempt.backend, attempt.failure);
        can_draw = can_draw || attempt.works;
    }
    return can_draw ? 0 : 3;
}

} // namespace

void add_doctor_command(CLI::App& app, std::function<int()>& chosen) {
    CLI::App* command = app.add_subcommand("doctor", "tell what this machine can draw with");
    command->callback([&chosen] { chosen = doctor; });
}

} // namespace fernlicht
