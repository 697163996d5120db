// One step of each of the two methods, by Boost.Odeint.
#pragma once

#include "scenarios/vehicle/ode.h"

#include <memory>

namespace fernlicht {

/// A step that was tried: the state at its end, the estimate of its error, and its continuous extension.
struct TriedStep {
    std::vector<double> end, error;
    std::vector<double> nodes; ///< DensePath::nodes x size; filled by SingleStep::extend
    /// Dormand-Prince: step length times an estimate of the largest eigenvalue's magnitude, |f(t+h, end) - f(t+h, g6)| / |end - g6| with g6
    /// the sixth stage (Hairer & Wanner II, IV.2); 0 where the two stages agree. Rosenbrock: the same product from the Jacobian.
    double stiffness = 0.0;
};

/// Dormand-Prince 5(4) (Dormand & Prince 1980; Hairer, Norsett & Wanner I, table II.5.2): 7 stages, the last is the next step's first.
/// Rosenbrock of order 4 with an embedded third order, 6 stages, stiffly accurate and L-stable (RODAS, Hairer & Wanner II, IV.7).
class SingleStep {
  public:
    SingleStep(const OdeProblem& problem, SolverWork& work); ///< both must outlive it
    ~SingleStep();

    /// Leaves the result in `tried()`. `x` may not be its `end`.
    void dormand_prince(double t_s, double step_s, const std::vector<double>& x);
    void rosenbrock(double t_s, double step_s, const std::vector<double>& x);
    /// The last step tried is the one taken: its end is where the next one begins.
    void accept();
    /// The problem or the state changed: nothing of the steps before holds.
    void restart();
    /// Fills `nodes` of the last step tried.
    void extend(double step_s, const std::vector<double>& x);
    TriedStep& tried();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace fernlicht
