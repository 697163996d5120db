// `fernlicht techniques`: lists the ways to light a scene.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_techniques_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
