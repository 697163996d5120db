// `fernlicht can stat`: what a log of a CAN bus shows, by channel and identifier.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_stat(CLI::App& can, std::function<int()>& chosen);

} // namespace fernlicht
