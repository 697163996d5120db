// YAML files that are named by their path, or by their name in our library (scenarios/values/library_folders.h).
#pragma once

#include "scenarios/values/errors.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fernlicht {

/// Names of those of a kind ("recipe": recipes/), of all folders of the library, in order.
std::vector<std::string> library_names(const std::string& kind);

/// `given` as a path from `folder`, or else such a name. Absolute and normal. Throws InputError at `where`.
std::filesystem::path library_file(const std::string& kind, const std::string& given, const std::filesystem::path& folder,
                                   const InputError::Where& where);

} // namespace fernlicht
