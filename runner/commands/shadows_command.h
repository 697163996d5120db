// fernlicht shadows: how wrong each shadow method is, and what it costs.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// Adds the command; when it is chosen, `chosen` becomes what does it. `command` is the command line, for the results.
void add_shadows_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

} // namespace fernlicht
