// The lit part of a line of samples: along a lane for its reach, across the road for its width.
#pragma once

#include <optional>
#include <vector>

namespace fernlicht {

struct LineSample {
    double at_m = 0.0;        ///< ascending along a line
    std::optional<double> lx; ///< nullopt: not looked at here; no line runs through such a place
};

struct LitLine {
    bool lit = false;                   ///< anywhere
    double first_m = 0.0, last_m = 0.0; ///< nearest and farthest place with E >= limit; 0 where unlit
    double lit_m = 0.0;                 ///< length at or above the limit
    double unlit_before_last_m = 0.0;   ///< length below the limit from the line's start to `last_m`
    bool lit_at_end = false;            ///< at the last place that was looked at
};

/// limit_lx > 0. Between samples as in crossing.h.
LitLine lit_line(const std::vector<LineSample>& line, double limit_lx);

} // namespace fernlicht
