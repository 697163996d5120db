// `fernlicht accuracy`: error against run time.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// `command` is the whole command line as typed, for the result.
void add_accuracy_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

} // namespace fernlicht
