// `fernlicht compare A B`: what differs between two pictures.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

/// Adds the subcommand; chosen, it sets `chosen`, which gives 1 when a class of strictness was asked for and not kept.
void add_compare_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
