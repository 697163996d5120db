// `fernlicht can record`: a drive's script as the recording of a bus.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_record(CLI::App& can, std::function<int()>& chosen);

} // namespace fernlicht
