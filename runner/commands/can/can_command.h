// `fernlicht can`: small tools for logs and frames of a CAN bus, one file each in runner/can/.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
