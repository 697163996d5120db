// `fernlicht can cut`: the part of a log between two times, of some identifiers and channels.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_cut(CLI::App& can, std::function<int()>& chosen);

} // namespace fernlicht
