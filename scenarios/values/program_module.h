// Parts of the program in files of their own: what few commands need, and what would slow down every start.
#pragma once

#include <filesystem>
#include <string>

namespace fernlicht {

/// The program's folder, links followed.
std::filesystem::path program_folder();

/// Where a part of the program lies: beside it, as it was built, or in ../lib/fernlicht/modules, as it is installed. Where it is in
/// neither, the latter.
std::filesystem::path program_part(const std::string& name);

/// A function of a shared library of ours, by its C name. The library is opened when it is first asked for, and stays. Throws DeviceError
/// where it is not there or cannot be opened.
void* module_function(const std::string& module, const char* function);

} // namespace fernlicht
