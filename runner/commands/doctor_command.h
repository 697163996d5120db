// `fernlicht doctor`: what this machine can draw with.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_doctor_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
