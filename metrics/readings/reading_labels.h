// Names of readings for people.
// The table of quantities for people.
// Units as people write them.
#pragma once

#include "metrics/readings/reading_key.h"

#include <string>

namespace fernlicht {

/// "reach at 5 lx on a target, own lane, 5th percentile".
std::string reading_label(const ReadingKey& key);

/// Whose eyes a glare reading is of: "mirrors of a car 15 m ahead", "eyes of oncoming driver opposite".
std::string eye_label(const ReadingKey& key);

/// "m2": "m²"; "cd/m2": "cd/m²"; "1", that of a ratio: "". Other units stay as they are.
inline std::string unit_label(const std::string& unit) {
    return unit == "1" ? "" : unit == "m2" || unit.ends_with("/m2") ? unit.substr(0, unit.size() - 1) + "²" : unit;
}

/// To stand behind a figure: " m²"; "" for a ratio.
inline std::string unit_suffix(const std::string& unit) { return unit == "1" ? "" : " " + unit_label(unit); }

} // namespace fernlicht
