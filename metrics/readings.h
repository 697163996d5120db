// What a measurement says: rows that reports write and limits judge.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

struct Reading {
    std::string name;            ///< snake_case with its unit at the end: "reach_5lx_road_own_m"
    std::optional<double> value; ///< nullopt: not_measured, with the reason in `why_not`; never NaN
    std::string unit;            ///< "m", "lx", "m2", "1", "s", "cd/m2"
    std::string where;           ///< "own lane, centre" - free text for people
    int tick = -1;               ///< -1: of the whole drive
    std::string why_not;
};
using Readings = std::vector<Reading>;

} // namespace fernlicht
