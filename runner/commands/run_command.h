// `fernlicht run`: plays drives and writes a report.
#pragma once

#include "runner/play/play.h"

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// "FIRST:LAST", "FIRST:" or ":LAST" of --frames; all for "". Throws InputError naming the flag.
TickRange tick_range(const std::string& frames);

/// `command` is the whole command line as typed, for the report.
void add_run_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

} // namespace fernlicht
