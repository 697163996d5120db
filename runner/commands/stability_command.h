// `fernlicht stability`: extreme and degenerate inputs as a table of cases, each measured and judged.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

/// Adds the subcommand; chosen, it sets `chosen`, which gives 1 when a case fails.
void add_stability_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
