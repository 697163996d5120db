// Bend light: where the lamps look, by steering angle, by yaw rate and speed, or by the lane ahead; and static cornering light: lamps that
// shine beside the car while it turns slowly. Filters are stepped exactly: how a time is cut into steps does not matter while the input
// holds.
#pragma once

#include "scenarios/control/control_parameters.h"
#include "scenarios/control/signals.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

/// y' = (input - y) / time_constant_s; starts at the first input. A time constant of 0 follows at once.
struct FirstOrder {
    double time_constant_s = 0.0;
    double value = 0.0;
    bool started = false;

    double step(double input, double dt_s) {
        const double share = started && time_constant_s > 0.0 ? -std::expm1(-dt_s / time_constant_s) : 1.0;
        value += share * (input - value);
        started = true;
        return value;
    }
};

/// Moves towards `target` by at most `per_s` a second. `per_s` infinite: at once.
inline double moved_towards(double value, double target, double per_s, double dt_s) {
    const double most = per_s * dt_s;
    return std::isfinite(most) ? value + std::clamp(target - value, -most, most) : target;
}

/// What the laws know of the car.
struct ControlledCar {
    double wheelbase_m = 2.7;
    double self_steering_s2_per_m = 0.0; ///< steering for a bend of curvature k: (wheelbase + this * v^2) k
};

class BendLight {
  public:
    BendLight(const BendParameters& parameters, const ControlledCar& car);

    /// Angle in rad, left positive, inside the actuator's limits. A car on a circle of curvature k comes, after a way of v T, to a place at
    /// the angle k v T / 2 from where it points now: steering gives k = steering / (l + EG v^2), the yaw rate r gives k v = r, the lane
    /// ahead gives the angle itself. A signal that is lost, or a car that stands or reverses, has the lamps look straight ahead.
    double step(const SignalTable& table, double dt_s);
    /// Whether the last step had the signals that it needs.
    bool lost() const { return lost_; }

  private:
    double wanted_rad(const SignalTable& table) const;

    BendParameters parameters_;
    ControlledCar car_;
    FirstOrder filter_;
    bool lost_ = false;
};

/// The lamp's own angle: the lamp outside of the bend takes `outer_share`. `left_m`: where the lamp sits.
double bend_of_lamp_rad(const BendParameters& parameters, double bend_rad, double left_m);

class CorneringLight {
  public:
    explicit CorneringLight(const CorneringParameters& parameters) : parameters_(parameters) {}

    struct Levels {
        double left = 0.0, right = 0.0;
    };
    /// On by steering beyond `on_rad` until it is below `off_rad`, or by the indicator; never from `until_speed_mps` on until slower than
    /// `again_below_mps`. Fades in `fade_s`. A signal that is lost turns them off.
    Levels step(const SignalTable& table, double dt_s);

  private:
    CorneringParameters parameters_;
    bool slow_ = true, left_ = false, right_ = false;
    Levels levels_;
};

} // namespace fernlicht
