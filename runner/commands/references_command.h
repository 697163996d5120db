// `fernlicht references list|show|diff|remove`: what was accepted, and how it differs.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_references_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
