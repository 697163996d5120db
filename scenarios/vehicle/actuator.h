// A lamp's actuator over time: second order with limits on rate and angle, commanded every control period after a dead time.
#pragma once

#include "scenarios/vehicle/integrator.h"
#include "scenarios/vehicle/vehicle_parameters.h"

#include <memory>

namespace fernlicht {

struct ActuatorRun {
    DensePath path{{0, 1}}; ///< angle, rad; rate, rad/s
    SolverWork work;
    std::uint64_t rate_limited = 0, at_stop = 0; ///< how often a limit was met

    double angle_rad(double time_s) const { return path.at(time_s, 0); }
};

/// An actuator that is moved on step by step, for a control law that looks at where it is.
/// Limits: x'' = w^2 (c - x) - 2 z w x' holds inside them. At the rate limit x' stays there until x'' points inwards; at a stop x stays and
/// x' = 0 (what is left of it is lost) until the command leads inwards. Both are events, located within the solver's event tolerance.
class Actuator {
  public:
    /// At rest at `angle_rad` at time 0, commanded to stay there.
    explicit Actuator(const ActuatorParameters& actuator, double angle_rad, const SolverOptions& options = {});
    Actuator(Actuator&&) noexcept;
    ~Actuator();

    double angle_rad() const;
    /// Holds from now on, cut to the stops; the dead time is the caller's.
    void command(double angle_rad);
    /// Jammed it stands still at once, whatever is commanded, until it is freed.
    void jam(bool jammed);
    /// Throws InputError when the solver gives up.
    void advance(double until_s);
    /// The motion until now, without the work. Before the first advance() its path has no steps.
    const ActuatorRun& so_far() const;
    /// The motion until now; the actuator is used up.
    ActuatorRun take();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Starts at rest at the command of time 0. `command`: what the control law asks for at a control tick, rad; it is asked once a tick, in
/// order. `switches_s`: further times at which the law is asked anew at once (a lamp switched on or off); they start the dead time like a
/// tick. A command that does not change costs nothing. Throws InputError when the solver gives up.
ActuatorRun run_actuator(const ActuatorParameters& actuator, const std::function<double(double tick_s)>& command,
                         const std::vector<double>& switches_s, double end_s, const SolverOptions& options = {});

} // namespace fernlicht
