#include "runner/commands/can/can_command.h"

#include "runner/commands/can/line_output.h"
#include "runner/commands/flag_values.h"
#include "runner/files/log.h"
#include "runner/play/stage.h"
#include "scenarios/can/candump_log.h"
#include "scenarios/drives/play/bus_recording.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

struct RecordFlags {
    std::string drive, lamp_set, start = "0", out;
    bool force = false;
};

int record_drive(const RecordFlags& flags) {
    const std::int64_t start_ns = nanoseconds_of("--start", flags.start);
    DriveEdits edits;
    edits.can_log = std::filesystem::path(); // by its script
    Stage stage(read_drive(named_file("drive", flags.drive, "DRIVE"), edits));
    std::vector<std::string> notes;
    std::vector<CanFrame> frames =
        recorded_inputs(stage.drive, stage.route, lamp_set_of(stage.drive, flags.lamp_set), stage.drive.opened, notes);
    LineOutput out(flags.out, flags.force);
    for (CanFrame& frame : frames) {
        frame.time_ns += start_ns;
        out.text() += candump_line(frame) + '\n';
        if (!out.written())
            return 0;
    }
    out.finish();
    for (const std::string& note : notes)
        tell(LogLevel::info, note);
    return 0;
}

} // namespace

void add_can_record(CLI::App& can, std::function<int()>& chosen) {
    const auto flags = std::make_shared<RecordFlags>();
    CLI::App* sub = can.add_subcommand("record", "write the candump log that a bus would carry if the drive's own script were the car");
    sub->add_option("DRIVE", flags->drive, "drive file (YAML) with `can`")->required();
    sub->add_option("--lamp-set", flags->lamp_set, "lamp set whose script is recorded (default: the first)");
    sub->add_option("--start", flags->start, "timestamp of the drive's 0 s, in s");
    sub->add_option("-o,--out", flags->out, "write to this file instead of standard output");
    sub->add_flag("--force", flags->force, "let --out replace an existing file");
    sub->callback([flags, &chosen] { chosen = [flags] { return record_drive(*flags); }; });
}

} // namespace fernlicht
