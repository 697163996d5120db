// How far a reading moves when the lamps stand or shine a little differently than assumed: by as much as mounting leaves open.
#pragma once

#include "metrics/readings/value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace fernlicht {

/// Signed moves in the reading's unit; nullopt where the twin does not tell.
struct Sensitivity {
    std::optional<double> aim_up, aim_down; ///< all lamps by 0.1 degrees
    std::optional<double> brighter, dimmer; ///< by 10 % of flux
    std::optional<double> higher, lower;    ///< by 10 mm
    std::optional<double> loaded;           ///< by 75 kg over the rear axle

    using Member = std::optional<double> Sensitivity::*;
    bool operator==(const Sensitivity&) const = default;
};

/// In the order of NudgeKind, with the names of their columns.
struct SensitivityRow {
    Sensitivity::Member member;
    const char* name; ///< "aim_up"
};
inline constexpr std::array<SensitivityRow, 7> sensitivity_rows{{{&Sensitivity::aim_up, "aim_up"},
                                                                 {&Sensitivity::aim_down, "aim_down"},
                                                                 {&Sensitivity::brighter, "brighter"},
                                                                 {&Sensitivity::dimmer, "dimmer"},
                                                                 {&Sensitivity::higher, "higher"},
                                                                 {&Sensitivity::lower, "lower"},
                                                                 {&Sensitivity::loaded, "loaded"}}};

/// The difference of two figures, where both are numbers.
inline std::optional<double> move_of(const Value& nudged, const Value& as_is) {
    return nudged.number() && as_is.number() ? std::optional(*nudged.number() - *as_is.number()) : std::nullopt;
}

/// The larger size of both; of the one that is known; nullopt where neither is.
inline std::optional<double> larger(const std::optional<double>& a, const std::optional<double>& b) {
    return a || b ? std::optional(std::max(std::abs(a.value_or(0.0)), std::abs(b.value_or(0.0)))) : std::nullopt;
}
inline std::optional<double> by_aim(const Sensitivity& s) { return larger(s.aim_up, s.aim_down); }
inline std::optional<double> by_flux(const Sensitivity& s) { return larger(s.brighter, s.dimmer); }
inline std::optional<double> by_height(const Sensitivity& s) { return larger(s.higher, s.lower); }
inline std::optional<double> by_load(const Sensitivity& s) { return larger(s.loaded, std::nullopt); }

} // namespace fernlicht
