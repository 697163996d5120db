// Ordinary differential equations x' = f(t, x): the problem, how to solve it, what the solving took, and the solution.
// C++17 only, for single_step.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace fernlicht {

struct OdeProblem {
    /// x' at (t, x). Smooth between two restarts of the integrator; may have kinks, which cost rejected steps, but no jumps.
    std::function<void(double t_s, const double* x, double* dxdt)> derivative;
    /// df/dx by rows and df/dt; empty: forward differences of `derivative`. Only the Rosenbrock method asks for it.
    std::function<void(double t_s, const double* x, double* jacobian, double* dfdt)> jacobian;
    /// Magnitude of each component, above 0: the error of a step is held below tolerance * (scale + |x|), in the root mean square.
    std::vector<double> scale;

    std::size_t size() const { return scale.size(); }
};

enum class Solver { automatic, dormand_prince, rosenbrock };
inline constexpr std::string_view name(Solver solver) {
    return solver == Solver::automatic ? "auto" : solver == Solver::dormand_prince ? "dormand-prince" : "rosenbrock";
}

struct SolverOptions {
    Solver solver = Solver::automatic;
    double tolerance = 1.0e-6;         ///< 1e-12 .. 1e-2, of scale + |x|, for each step
    double fixed_step_s = 0.0;         ///< above 0: every step this long, the error is not looked at; needs a solver that is not automatic
    double event_tolerance_s = 1.0e-9; ///< an event is located in a bracket of this length (or of 4 roundings of t, if that is more)
    std::uint64_t max_steps = 2'000'000;
};

/// What one of the two methods did.
struct MethodWork {
    std::uint64_t steps = 0, rejected = 0;
    double simulated_s = 0.0;
};

struct SolverWork {
    MethodWork dormand_prince, rosenbrock;
    std::uint64_t derivatives = 0, jacobians = 0; ///< evaluations; a Jacobian by differences counts its derivatives too
    std::uint64_t switches = 0;                   ///< from one method to the other
    std::uint64_t events = 0;                     ///< located inside a step
};

/// The solution over time: on each step the method's own continuous extension, kept as its values at the 6 places 0, 1/5 .. 1 of the step.
/// They determine it: that of Dormand-Prince is a quintic (order 4), that of the Rosenbrock method a cubic (order 3).
/// Where the state jumps (a step in the road), two steps meet in one moment; the later one is taken.
class DensePath {
  public:
    static constexpr std::size_t nodes = 6;

    /// `kept`: which components of the state are stored, in this order.
    explicit DensePath(std::vector<std::size_t> kept = {});

    /// A step from `start_s` to `end_s`; `values`: nodes x size-of-state, by nodes. Steps follow one another without gaps.
    void add(double start_s, double end_s, const double* values, std::size_t state_size);

    bool empty() const { return ends_s_.empty(); }
    double start_s() const { return starts_s_.front(); }
    double end_s() const { return ends_s_.back(); }
    std::size_t steps() const { return ends_s_.size(); }
    double step_end_s(std::size_t step) const { return ends_s_[step]; }
    std::size_t step_at(double time_s) const; ///< the last one that begins at or before `time_s`
    /// Kept component number `component` at `time_s`, which is clamped to the path.
    double at(double time_s, std::size_t component) const;

  private:
    std::vector<std::size_t> kept_;
    std::vector<double> starts_s_, ends_s_, values_;
};

/// Value at `place` in [0, 1] of the quintic through `values[k * stride]` at k / 5.
double quintic(const double* values, std::size_t stride, double place);

} // namespace fernlicht
