// Error against run time of the solvers that move car and lamps. Takes seconds: for commands that report, not for a run.
// The closed form that solvers of second-order systems are held against.
// Extremes of the solvers: how far off each comes out. Seconds together, so for commands and tests, not for a run.
#pragma once

#include "scenarios/vehicle/ode.h"

#include <string>
#include <vector>

namespace fernlicht {

/// One problem solved one way.
struct SolverRow {
    std::string problem; ///< "actuator of 5 Hz", ...
    Solver solver = Solver::automatic;
    double tolerance = 0.0, step_s = 0.0; ///< one of them is above 0: steps by the tolerance, or all of one length
    double error = 0.0;                   ///< largest at 997 moments over the run, between steps too: what frames see
    double floor = 0.0;                   ///< what the error was measured against is itself no better than this; 0: a closed form
    std::string unit;                     ///< of error and floor
    std::string against;                  ///< "closed form", "run at a tolerance of 1e-12"
    std::uint64_t steps = 0, rejected = 0, derivatives = 0, jacobians = 0;
    double seconds = 0.0, min_seconds = 0.0, max_seconds = 0.0; ///< median, least and most over the repetitions
    std::size_t repetitions = 0;
    std::string not_measured; ///< why there is neither error nor time; "" where there are
};

struct SolverStudy {
    int repetitions = 5; ///< odd
    /// Run time is bounded by these: some 10 s with the defaults.
    std::vector<double> tolerances{1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
    std::vector<double> steps_s{0.032, 0.016, 0.008, 0.004, 0.002}; ///< of the one problem that is solved with fixed steps too
};

/// By problem, solver and tolerance, the coarsest first. Errors are the same on every call, times are the machine's.
/// Problems: lamp actuators of 5 Hz and of 50 kHz that answer a step (closed form); a car at 20 m/s over an edge of 2 cm; a car that brakes
/// to rest from 10 m/s.
std::vector<SolverRow> study_solvers(const SolverStudy& study = {});

/// x(t) of x'' = w^2 (1 - x) - 2 z w x' from rest at 0, w in rad/s, z >= 0; 0 before t = 0. From the roots of s^2 + 2 z w s + w^2, in any
/// textbook of control; to some roundings of 1 except within 1e-4 of z = 1, where the roots cancel (z = 1 itself has its own form).
double step_response(double w, double z, double t_s);
/// The same as a problem, with its Jacobian.
OdeProblem step_problem(double w, double z);

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
