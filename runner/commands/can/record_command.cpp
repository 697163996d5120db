#include "runner/commands/can/can_command.h"

#include "runner/commands/can/line_output.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
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
    const std::int64_t start_ns = nanoseconds_of("--can-start", flags.start);
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
    add_shared(*sub, "DRIVE", flags->drive)->required();
    add_shared(*sub, "--lamp-set", flags->lamp_set)->default_str("the first");
    add_shared(*sub, "--can-start", flags->start)->capture_default_str();
    add_shared(*sub, "-o,--out", flags->out);
    add_shared(*sub, "--force", flags->force);
    sub->callback([flags, &chosen] { chosen = [flags] { return record_drive(*flags); }; });
}

} // namespace fernlicht
