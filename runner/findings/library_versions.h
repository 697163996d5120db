// The versions of everything that a result may depend on.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

/// Name and version of fernlicht, the compiler and each library, as they are at run time where the library can tell.
std::vector<std::pair<std::string, std::string>> library_versions();

} // namespace fernlicht
