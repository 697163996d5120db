// `fernlicht compare A B`: what differs between two pictures, runs or lamps.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// Adds the subcommand; chosen, it sets `chosen`, which gives 1 when a class of strictness was asked for and not kept, or a
/// regulation that B does not pass.
void add_compare_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

} // namespace fernlicht
