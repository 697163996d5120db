// `fernlicht can convert`: a log in another of candump's forms.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_can_convert(CLI::App& can, std::function<int()>& chosen);

} // namespace fernlicht
