// `fernlicht signals`: lists what lamp control reads and writes.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_signals_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
