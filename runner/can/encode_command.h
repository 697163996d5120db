// `fernlicht can encode`: frames from the values of signals.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_encode(CLI::App& can, std::function<int()>& chosen);

} // namespace fernlicht
