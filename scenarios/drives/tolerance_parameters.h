// How cars of one series differ: how their lamps stand and shine, how high and how loaded they are.
#pragma once

#include "scenarios/drives/limit.h"

#include <vector>

namespace fernlicht {

enum class ToleranceKind { pitch, yaw, roll, flux, height, load };
inline constexpr std::size_t tolerance_kinds = 6;
/// Drawn for each lamp by itself; height and load are the car's.
inline bool is_of_each_lamp(ToleranceKind kind) { return kind < ToleranceKind::height; }

/// A normal distribution, or an even one where `from` and `to` are given, about what the drive has.
struct Tolerance {
    double sigma = 0.0, mean = 0.0;
    std::optional<double> from, to; ///< both or neither
    std::string source;             ///< who states it; "": assumed

    /// Not all cars are as the drive has it.
    bool counts() const { return from ? *from != 0.0 || *to != 0.0 : sigma > 0.0 || mean != 0.0; }
    bool operator==(const Tolerance&) const = default;
};

struct ToleranceParameters {
    std::optional<Tolerance> pitch_deg, yaw_deg, roll_deg, flux_percent, height_mm, load_kg; ///< nullopt: usual_tolerance()
    std::vector<Limit> limits;                                                               ///< of which the share of cars within is told
    int draws = 10'000;                                                                      ///< cars by slopes
    int cars = 200;                                                                          ///< of these, in full
    bool rendered = false; ///< whether those are drawn for reach and width, not calculated
    int seed = 1;

    bool operator==(const ToleranceParameters&) const = default;
};

/// 0.1 degrees of pitch, yaw and roll, 5 % of flux and 10 mm, normally distributed; no load.
Tolerance usual_tolerance(ToleranceKind kind);
/// Stated or usual.
Tolerance tolerance_of(const ToleranceParameters& parameters, ToleranceKind kind);
const char* name_of(ToleranceKind kind); ///< "pitch"
const char* unit_of(ToleranceKind kind); ///< "deg", "%", "mm", "kg"

} // namespace fernlicht
