// Extremes of the solvers, the car and the actuators: how far off each comes out. Seconds together, so for commands and tests, not for a
// run.
#pragma once

#include <string>
#include <vector>

namespace fernlicht {

struct ExtremeTrial {
    std::string what;   ///< "actuator of 10 MHz"
    double error = 0.0; ///< in the unit of its study
};

/// 60 m/s, braked with 7.5 m/s2 to rest, away with 3 m/s2 to 60 m/s again; by each solver. Error: the largest change of speed within a
/// millisecond, over what the friction can do in it, minus 1, where above 0; a jump shows as a large number. And, as trials of their own,
/// by how much the pitch of each solver differs from the automatic choice's, in rad / 1e-3.
std::vector<ExtremeTrial> from_60_mps_to_rest_and_back();

/// An actuator of 5 Hz with steps of 1e-6 s (a hundred thousand of them) against the closed form, and with steps of 10 s, 50 periods long,
/// against where it settles. Error: parts of the step.
std::vector<ExtremeTrial> steps_of_a_microsecond_and_of_ten_seconds();

/// Largest stable step of each solver on x' = lambda x along rays of the left half plane, found by bisection over 2000 steps, against
/// theory: Dormand-Prince: |R(h lambda)| = 1 of its stability function 1 + z + z^2/2 + z^3/6 + z^4/24 + z^5/120 + z^6/600. Rosenbrock: none
/// up to h |lambda| = 1e12. Error: relative.
std::vector<ExtremeTrial> largest_stable_steps();

/// h |lambda| where Dormand-Prince's stability function first reaches 1, for lambda at `angle_rad` from the negative real axis.
double dormand_prince_limit(double angle_rad);

} // namespace fernlicht
