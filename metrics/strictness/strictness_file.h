// Classes of strictness by name, or from a file of the user's.
#pragma once

#include "metrics/strictness/strictness_classes.h"

#include <string>

namespace fernlicht {

/// The class of this name; else the YAML file of this name (docs/comparing.md has its keys), whose masks are read too. Throws InputError:
/// neither a class nor a file; unknown keys, numbers out of range, with file and line; masks that cannot be read.
StrictnessClass read_strictness(const std::string& name_or_file);

} // namespace fernlicht
