// `fernlicht study`: lamps x drives x techniques x conditions, compared.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// `command` is the whole command line as typed, for the report.
void add_study_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

} // namespace fernlicht
