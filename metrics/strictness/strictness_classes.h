// The classes of strictness that have a name, from the strictest on.
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

} // namespace fernlicht
