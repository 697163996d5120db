// Shared libraries beside the program: what few commands need, and what would take every start its time.
#pragma once

#include <string>

namespace fernlicht {

/// A function of such a library, by its C name. The library is opened when it is first asked for, and stays. Throws DeviceError where it is
/// not there or cannot be opened.
void* module_function(const std::string& module, const char* function);

} // namespace fernlicht
