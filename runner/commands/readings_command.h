// `fernlicht readings`: lists what is read of a drive.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_readings_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
