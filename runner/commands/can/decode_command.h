// `fernlicht can decode`: what the frames of a log mean.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_decode(CLI::App& can, std::function<int()>& chosen);

} // namespace fernlicht
