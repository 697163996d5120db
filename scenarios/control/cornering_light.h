// Static cornering light: lamps that shine beside the car while it turns slowly.
#pragma once

#include "scenarios/control/control_parameters.h"
#include "scenarios/control/first_order.h"
#include "scenarios/control/signals.h"

namespace fernlicht {

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
