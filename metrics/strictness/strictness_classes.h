// The classes of strictness that have a name, from the strictest on.
// Classes of strictness by name, or from a file of the user's.
#pragma once

#include "metrics/strictness/strictness.h"

#include <string>
#include <vector>

namespace fernlicht {

struct StrictnessClass {
    std::string name;
    std::string meaning;    ///< one sentence: who needs it, and why its numbers are what they are
    StrictnessNode display; ///< for 8-bit pictures, in levels
    StrictnessNode linear;  ///< for lx, cd/m2, m
};

/// identical, same-driver, same-light, same-picture.
const std::vector<StrictnessClass>& strictness_classes();

/// The class of this name; else the YAML file of this name (docs/comparing.md has its keys), whose masks are read too. Throws InputError:
/// neither a class nor a file; unknown keys, numbers out of range, with file and line; masks that cannot be read.
StrictnessClass read_strictness(const std::string& name_or_file);

} // namespace fernlicht
