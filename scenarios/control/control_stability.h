// Lamp control at its extremes: how far lamps exceed their limits. Takes seconds in all: for commands and tests, not for a run.
#pragma once

#include "scenarios/control/control_run.h"
#include "scenarios/vehicle/solver_study.h"

namespace fernlicht {

/// Bend light by `law` for two lamps, with this period.
ControlParameters plain_bend_light(BendLaw law, double period_s);

/// Actuators from 0.1 Hz to 1 MHz, dead times from 0 to 5 s, periods from 0.1 ms to 1 s, each with each. Error: rad beyond the stops, or
/// moved in 1 ms beyond what the rate limit allows; a value that is not finite is infinite.
std::vector<ExtremeTrial> control_of_extreme_actuators();

/// Signals that are NaN, infinite, 1e300, denormal, that change sign every tick, cars that stand, reverse, and take a hairpin at 80 m/s.
/// Error as above.
std::vector<ExtremeTrial> control_with_extreme_signals();

/// Weaving, mirrored. Error: the sum of both angles where it should be 0, rad.
std::vector<ExtremeTrial> control_mirrored();

/// Bend light while weaving: 20 m/s, yaw rate 0.2 rad/s times sin(2 pi t / 4 s), its steering and bearing.
ControlRun weave(BendLaw law, double period_s, double end_s);
/// Error of the swivel over 4 s of weaving against a period of 0.25 ms, the largest at 997 moments, rad.
double control_period_error_rad(BendLaw law, double period_s);

} // namespace fernlicht
