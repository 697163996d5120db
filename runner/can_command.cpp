#include "runner/can_command.h"

#include "runner/can/convert_command.h"
#include "runner/can/cut_command.h"
#include "runner/can/decode_command.h"
#include "runner/can/encode_command.h"
#include "runner/can/list_command.h"
#include "runner/can/merge_command.h"
#include "runner/can/record_command.h"
#include "runner/can/stat_command.h"

#include <CLI/CLI.hpp>

namespace fernlicht {

void add_can_command(CLI::App& app, std::function<int()>& chosen) {
    CLI::App* can = app.add_subcommand("can", "small tools for logs of a CAN bus, as candump writes them");
    can->require_subcommand(1);
    add_can_stat(*can, chosen);
    add_can_merge(*can, chosen);
    add_can_cut(*can, chosen);
    add_can_convert(*can, chosen);
    add_can_decode(*can, chosen);
    add_can_encode(*can, chosen);
    add_can_list(*can, chosen);
    add_can_record(*can, chosen);
}

} // namespace fernlicht
