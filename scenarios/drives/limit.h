// What a drive's reading must keep within.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace fernlicht {

struct Limit {
    std::string reading; ///< name of a row, e.g. "reach_5lx_road_own_m"
    std::optional<double> at_least, at_most;
    std::size_t line = 0; ///< of the drive's file; 0: from elsewhere

    bool operator==(const Limit& other) const { return reading == other.reading && at_least == other.at_least && at_most == other.at_most; }
};

} // namespace fernlicht
