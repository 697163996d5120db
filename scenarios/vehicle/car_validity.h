// Where the model of the car ends. Its equations hold for small angles and for wheels that stay on the road but for hops; they know no
// stops of the springs. A car beyond that is not simulated wrongly in silence: the drive is refused.
#pragma once

#include "scenarios/vehicle/car_run.h"

#include <optional>
#include <string>

namespace fernlicht {

/// By which the sprung weight may press the springs together at rest. A body on such springs swings with sqrt(g / 0.4 m) = 0.8 Hz, below
/// the 1 to 1.5 Hz of cars (Mitschke & Wallentowitz 2014, part B); with more the springs have no place left in a car.
inline constexpr double greatest_deflection_m = 0.4;
/// Of the body against the road: the equations take the angle for its sine, which differ by 0.4 % here.
inline constexpr double greatest_pitch_rad = 0.15;
/// For which both wheels of an axle may be in the air at a stretch: in 0.2 s a falling body comes down by 0.2 m, the whole way of a car's
/// springs, whose stops are not modelled. A wheel's own hop (10 to 14 Hz) is over sooner.
inline constexpr double longest_hop_s = 0.2;

/// By which the sprung weight presses an axle's springs together at rest, in m: g (m load - unsprung) / k.
double deflection_at_rest_m(const VehicleParameters& car, const AxleParameters& axle, double part_of_load);

/// What a run did that the model does not describe, as the two parts of an InputError's sentence.
struct BeyondModel {
    std::string found, expected;
};

struct CarValidity {
    std::optional<BeyondModel> beyond; ///< the first in time
    int hops = 0;                      ///< axles in the air for at most longest_hop_s
    double longest_hop_s = 0.0;
};

/// Looks at the run until `end_s`, six times in each step of the solver.
CarValidity car_validity(const CarRun& run, double end_s);

} // namespace fernlicht
