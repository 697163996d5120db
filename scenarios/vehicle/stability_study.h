// Extremes of the solvers: how far off each comes out. Seconds together, so for commands and tests, not for a run.
#pragma once

#include <string>
#include <vector>

namespace fernlicht {

struct ExtremeTrial {
    std::string what;   ///< "actuator of 10 MHz"
    double error = 0.0; ///< in the unit of its study
};

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
