// `fernlicht can merge`: several logs of CAN buses as one, in order of time.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_merge(CLI::App& can, std::function<int()>& chosen);

} // namespace fernlicht
