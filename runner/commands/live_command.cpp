#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/run_files.h"
#include "runner/commands/words/exit_codes.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/live/live_run.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "runner/files/page_link.h"
#include "runner/findings/run_context.h"
#include "scenarios/drives/keys/bus_keys.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct LiveFlags {
    LiveOptions options;
    std::filesystem::path drive;
    std::string start, resolution, out;
    const OutputFormat* tables = nullptr;
    double duration_s = 0.0;
    bool no_wait = false, no_draw = false, lossless = false;
};

Drive drive_of(const LiveFlags& flags) {
    DriveEdits edits;
    if (!flags.resolution.empty())
        edits.resolution = resolution_of(flags.resolution);
    edits.can_log = flags.options.log; // the recording that a drive names itself is not played
    if (!flags.start.empty()) {
        edits.can_start_ns = stamp_from_text(flags.start);
        if (!edits.can_start_ns)
            refuse_flag("--can-start", flags.start, "a stamp of the recording, e.g. 1436509052.249713");
    }
    Drive drive = read_drive(named_file("drive", flags.drive, "DRIVE"), edits);
    if (flags.duration_s > 0.0)
        drive.duration_s = flags.duration_s;
    return drive;
}

/// What a run without loss has none of.
bool lost(const LiveFigures& live) {
    return live.socket.dropped + live.socket.superseded + live.socket.not_sent + live.not_recorded > 0 || !live.socket.outages.empty();
}

void check_bus_flags(const LiveFlags& flags) {
    if (flags.options.interface.empty() == flags.options.log.empty())
        throw InputError({{}, 0, 0, "--can"},
                         flags.options.log.empty() ? "found neither an interface nor a recording" : "found an interface and a recording",
                         "--can IFACE or --can-log FILE, one of both");
    if (flags.options.log == "none")
        refuse_flag("--can-log", flags.options.log.string(), "a recording; `fernlicht run --can-log none` plays a drive by its script");
    if (flags.no_wait && flags.options.log.empty())
        throw InputError({{}, 0, 0, "--no-wait"}, "found it beside --can", "--can-log FILE: a bus cannot be hurried");
    if (!flags.start.empty() && flags.options.log.empty())
        refuse_flag("--can-start", flags.start, "--can-log FILE: the drive's 0 s on a bus is now");
}

/// Of a drive that fails the report is written before the error comes: whoever reads the sentence learns where.
Report run_and_name(Drive drive, const LiveOptions& options) {
    const std::filesystem::path page = options.folder / "report.html";
    std::error_code ignored;
    const bool was_there = std::filesystem::exists(page, ignored);
    try {
        return run_live(std::move(drive), options);
    } catch (...) {
        if (!was_there && std::filesystem::exists(page, ignored)) {
            fmt::print("{}\n", page.string());
            std::fflush(stdout);
        }
        throw;
    }
}

int live(const LiveFlags& flags, const std::vector<std::string>& command) {
    check_bus_flags(flags);
    LiveOptions options = flags.options;
    options.wait = !flags.no_wait;
    options.draw = !flags.no_draw && !flags.no_wait;
    options.command = command;
    options.write = [&](const Report& report) { write_report(report, options.folder, flags.tables); };
    Drive drive = drive_of(flags);
    options.folder = result_folder(flags.out, drive.name);
    const Report report = run_and_name(std::move(drive), options);
    fmt::print("{}", live_text(*report.live));
    if (!report.live->replay.empty())
        fmt::print("replay     {}\n", report.live->replay);
    for (const std::string& warning : report.warnings)
        tell(LogLevel::warning, warning);
    if (!report.complete)
        tell(LogLevel::warning, "incomplete: " + report.interrupted);
    fmt::print("{}\n", page_link(options.folder / "report.html"));
    return !report.complete ? static_cast<int>(ExitCode::interrupted) : flags.lossless && lost(*report.live) ? 1 : 0;
}

} // namespace

void add_live_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen) {
    const auto flags = std::make_shared<LiveFlags>();
    CLI::App* sub = app.add_subcommand("live", "play a drive in real time, with inputs from a CAN bus and outputs onto it");
    add_shared(*sub, "DRIVE", flags->drive)->required();
    sub->add_option("--can", flags->options.interface, "CAN interface of the kernel, such as can0 or vcan0")->option_text("IFACE");
    add_shared(*sub, "--can-log", flags->options.log);
    add_shared(*sub, "--can-start", flags->start)->default_str("that of the log's first frame");
    add_shared(*sub, "--duration", flags->duration_s)->check(CLI::Range(0.01, 1.0e6))->default_str("the drive's");
    add_shared(*sub, "--lamp-set", flags->options.lamp_set);
    sub->add_option("--listen", flags->options.listen_s, "seconds to listen to the bus before 0 s")
        ->check(CLI::Range(0.0, 3600.0))
        ->option_text("S");
    sub->add_option("--record", flags->options.record, "candump log of the frames that were used")
        ->option_text("FILE")
        ->default_str("one in the report's folder");
    sub->add_option("--receive-buffer", flags->options.receive_buffer_bytes, "bytes of the socket's receive buffer")
        ->check(CLI::Range(1, 1 << 30))
        ->default_str("4 MiB where permitted");
    sub->add_flag("--no-draw", flags->no_draw, "render no pictures; needs no GL");
    sub->add_flag("--no-wait", flags->no_wait, "with --can-log: go as fast as possible, without pictures");
    sub->add_flag("--lossless", flags->lossless,
                  "exit with 1 if a frame was dropped, not sent or not recorded, or the interface went down");
    add_shared(*sub, "--backend", flags->options.backend);
    add_shared(*sub, "--resolution", flags->resolution);
    add_shared(*sub, "--out", flags->out);
    add_tables_flag(*sub, flags->tables);
    sub->footer("A log is played at its own pace, in place of an interface.");
    sub->callback([flags, command, &chosen] { chosen = [flags, command] { return live(*flags, command); }; });
}

} // namespace fernlicht
