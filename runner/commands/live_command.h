// `fernlicht live`: a drive against the clock, on a CAN bus.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

void add_live_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

} // namespace fernlicht
