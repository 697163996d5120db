// Step-size control, choice of the method by stiffness, and events.
//
// Control: a step is taken when the root mean square of error / (tolerance * (scale + |x|)) is at most 1; the next step's length follows
// from it with a proportional-integral controller for Dormand-Prince (Hairer, Norsett & Wanner I, II.4: beta = 0.04), a plain one for
// Rosenbrock. Choice (`automatic`): starts with Dormand-Prince. When 15 steps with h |lambda| > 3.25 come before 6 in a row without, the
// problem is stiff (as in Hairer's DOPRI5; its region of stability ends at 3.3 on the real axis) and Rosenbrock takes over; back it goes
// after 25 steps in a row with h |lambda| < 1, h being Rosenbrock's own step: the gap between 1 and 3.25 keeps it from swinging. Events: a
// watch changes sign between two of the step's six nodes. It is bracketed on the continuous extension; the step is then repeated up to
// there by the method itself, so that the state has the method's order, and the integration stops. Two changes of sign within a fifth of a
// step stay unseen.
#pragma once

#include "scenarios/vehicle/single_step.h"

#include <optional>

namespace fernlicht {

/// Stops the integration where its value changes from below 0 to 0 or above (rising), or from above to 0 or below (falling).
struct Watch {
    std::function<double(double t_s, const double* x)> value;
    bool rising = true, falling = true;
};

struct Arrival {
    double time_s = 0.0;
    std::optional<std::size_t> event; ///< which watch; none: the end was reached
};

class OdeIntegrator {
  public:
    /// `problem` must outlive it. Throws std::invalid_argument for options out of range.
    OdeIntegrator(const OdeProblem& problem, const SolverOptions& options);

    /// Integrates `x` from `start_s` until `end_s` or the first event, writing steps into `path` where one is given. The method and its
    /// step length are kept from call to call; the problem or `x` may have changed in between. Throws InputError when the steps are used
    /// up, or become too short to move on: the equations or the method cannot be solved so.
    Arrival integrate(double start_s, double end_s, std::vector<double>& x, const std::vector<Watch>& watches = {},
                      DensePath* path = nullptr);

    const SolverWork& work() const { return work_; }
    Solver active() const { return active_; }

  private:
    void try_step(double t_s, double step_s, const std::vector<double>& x);
    double first_step(double t_s, double room_s, const std::vector<double>& x);
    double error_of(const std::vector<double>& x);
    double next_step(double step_s, double error, bool taken);
    void weigh_stiffness();
    double step_to(const Watch& watch, bool rising, double t_s, double step_s, double within_s, const std::vector<double>& x);
    [[noreturn]] void give_up(double t_s, const std::string& found) const;

    const OdeProblem& problem_;
    SolverOptions options_;
    SolverWork work_;
    SingleStep single_;
    Solver active_;
    double step_s_ = 0.0;        ///< to be tried next; 0: not known yet
    double last_error_ = 1.0e-4; ///< of the last step taken, for the integral part
    bool after_rejection_ = false;
    int stiff_steps_ = 0, mild_steps_ = 0, slow_steps_ = 0;
};

} // namespace fernlicht
