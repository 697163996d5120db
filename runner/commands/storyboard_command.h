// `fernlicht storyboard`: plays OpenSCENARIO files without drawing.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_storyboard_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
