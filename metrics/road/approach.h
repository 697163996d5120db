// A figure followed while a car comes nearer to a place: what it is at a distance, how far away it passes a limit, for how long.
// Between moments it runs as in lit_line.h: straight in its logarithm, straight where one of the two is 0.
#pragma once

#include "metrics/readings/value.h"

#include <string>
#include <vector>

namespace fernlicht {

struct ApproachSample {
    double time_s = 0.0;
    double distance_m = 0.0;     ///< still to go, which falls or stays; or gone, which rises or stays
    std::optional<double> value; ///< >= 0; nullopt: not measured
};
using Approach = std::vector<ApproachSample>;

/// With distances to go: the value where so many metres are left. Not measured where the drive comes from nearer or ends farther away.
Value value_at(const Approach& approach, double distance_m);

/// An approach that comes so near is finished though the place is not passed: a lamp is hardly a point of light from there on.
inline constexpr double near_enough_m = 10.0;

/// With distances to go, of a drive that did not pass the place: "the drive comes from 246.2 m to 210.4 m before it"; "" where it passed,
/// came within near_enough_m, or no moment was before the place.
std::string cut_short(const Approach& approach, bool passed);

/// With distances to go: farthest at which the value reaches the limit; 0: nowhere. At least the first moment's distance where it does so
/// from there on; at most the last one's where it does so nowhere and the approach was cut short.
Value reached_from_m(const Approach& approach, double limit, bool passed);

/// Seconds and metres of the drive at or above the limit.
struct Stretch {
    double time_s = 0.0, length_m = 0.0;
};
Stretch at_or_above(const Approach& approach, double limit);
Stretch below(const Approach& approach, double limit);

/// Largest and smallest of the measured values.
std::optional<double> largest(const Approach& approach);
std::optional<double> smallest(const Approach& approach);

} // namespace fernlicht
