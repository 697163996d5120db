// Bend light: where the lamps look, by steering angle, by yaw rate and speed, or by the lane ahead.
#pragma once

#include "scenarios/control/control_parameters.h"
#include "scenarios/control/first_order.h"
#include "scenarios/control/signals.h"

namespace fernlicht {

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

} // namespace fernlicht
