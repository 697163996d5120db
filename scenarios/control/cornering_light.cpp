#include "scenarios/control/cornering_light.h"

#include <limits>

namespace fernlicht {

CorneringLight::Levels CorneringLight::step(const SignalTable& table, double dt_s) {
    const double v = table[signal::ego_speed], steering = table[signal::ego_steering], indicator = table[signal::ego_indicator];
    slow_ = v <= (slow_ ? parameters_.until_speed_mps : parameters_.again_below_mps); // false for NaN
    left_ = slow_ && (steering > (left_ ? parameters_.off_rad : parameters_.on_rad) || indicator > 0.5);
    right_ = slow_ && (-steering > (right_ ? parameters_.off_rad : parameters_.on_rad) || indicator < -0.5);
    const double per_s = parameters_.fade_s > 0.0 ? 1.0 / parameters_.fade_s : std::numeric_limits<double>::infinity();
    levels_.left = moved_towards(levels_.left, left_ ? 1.0 : 0.0, per_s, dt_s);
    levels_.right = moved_towards(levels_.right, right_ ? 1.0 : 0.0, per_s, dt_s);
    return levels_;
}

} // namespace fernlicht
