// What a measurement says: rows that reports write and limits judge.
#pragma once

#include "metrics/readings/value.h"

#include <string>
#include <vector>

namespace fernlicht {

struct Reading {
    std::string name; ///< snake_case with its unit at the end: "reach_5lx_road_own_m"
    Value value;
    std::string unit;  ///< "m", "lx", "m2", "1", "s", "cd/m2"
    std::string where; ///< "own lane, centre" - free text for people
    int tick = -1;     ///< -1: of the whole drive
};
using Readings = std::vector<Reading>;

/// A lane's or a pass's name as it stands within a reading's name: "left 1" -> "left_1".
std::string name_part(const std::string& text);

/// Whether a reading tells how long something took on this machine: such readings are reported and never compared.
bool is_unit_of_time(const std::string& unit);

} // namespace fernlicht
