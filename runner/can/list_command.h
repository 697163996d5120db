// `fernlicht can list`: what a DBC file describes.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_list(CLI::App& can, std::function<int()>& chosen);

} // namespace fernlicht
