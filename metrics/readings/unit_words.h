// Units as people write them.
#pragma once

#include <string>

namespace fernlicht {

/// "m2": "m²"; "cd/m2": "cd/m²". Other units stay as they are.
inline std::string unit_in_words(const std::string& unit) {
    return unit == "m2" || unit.ends_with("/m2") ? unit.substr(0, unit.size() - 1) + "²" : unit;
}

} // namespace fernlicht
