// The lit part of a line of samples: along a lane for its reach, across the road for its width.
// How illuminance runs between two neighbouring samples, and where it meets a limit there.
#pragma once

#include <cmath>
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

/// limit_lx > 0. Between samples as in lit_line.h.
LitLine lit_line(const std::vector<LineSample>& line, double limit_lx);

/// Away from the lamps light falls off by powers of distance and beams by factors per degree: straight in the logarithm. Where
/// either sample is dark there is no logarithm, and the value runs straight.
inline double between_samples(double a, double b, double share) {
    return a > 0.0 && b > 0.0 ? a * std::pow(b / a, share) : a + (b - a) * share;
}

/// Share of the way from `a` to `b` at which `limit` is met; one of the two lies below it, the other does not. limit > 0.
inline double crossing_share(double a, double b, double limit) {
    return a > 0.0 && b > 0.0 ? std::log(a / limit) / std::log(a / b) : (a - limit) / (a - b);
}

} // namespace fernlicht
