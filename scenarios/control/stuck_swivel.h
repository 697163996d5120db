// A swivel that does not do what it is asked: found by what lamp control knows of it, command and position.
#pragma once

#include "scenarios/control/control_parameters.h"

#include <cmath>

namespace fernlicht {

/// Stuck is an actuator that for `after_s` without a break was more than `off_rad` from what it is asked for (cut to its stops) and moved
/// less than half a degree a second. A healthy one moves whenever it is elsewhere. Once found, it stays found: until the car is started
/// again.
class StuckSwivel {
  public:
    StuckSwivel(const StuckSwivelParameters& parameters, const ActuatorParameters& actuator)
        : parameters_(parameters), least_rad_(actuator.least_rad), greatest_rad_(actuator.greatest_rad) {}

    /// `asked_rad`: the command that has reached it, `actual_rad`: where it is, both now, `dt_s` after the last step.
    bool step(double asked_rad, double actual_rad, double dt_s);
    bool found() const { return found_; }
    /// Found, and so far aside that it may glare.
    bool aside() const { return found_ && std::abs(last_rad_) > parameters_.off_rad; }

  private:
    StuckSwivelParameters parameters_;
    double least_rad_, greatest_rad_, last_rad_ = 0.0, still_s_ = 0.0;
    bool found_ = false;
};

} // namespace fernlicht
