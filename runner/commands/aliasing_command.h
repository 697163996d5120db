// fernlicht aliasing: how much of what a picture shows is not there, by how it is drawn.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// Adds the command; when it is chosen, `chosen` becomes what does it. `command` is the command line, for the results.
void add_aliasing_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

} // namespace fernlicht
