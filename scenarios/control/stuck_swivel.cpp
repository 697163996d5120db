#include "scenarios/control/stuck_swivel.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

bool StuckSwivel::step(double asked_rad, double actual_rad, double dt_s) {
    constexpr double still_rad_s = 0.5 * 3.14159265358979323846 / 180.0, rounding_s = 1.0e-9;
    const bool off = std::abs(std::clamp(asked_rad, least_rad_, greatest_rad_) - actual_rad) > parameters_.off_rad;
    const bool still = std::abs(actual_rad - last_rad_) <= still_rad_s * dt_s;
    still_s_ = off && still ? still_s_ + dt_s : 0.0;
    last_rad_ = actual_rad;
    found_ = found_ || (still_s_ > 0.0 && still_s_ >= parameters_.after_s - rounding_s);
    return found_;
}

} // namespace fernlicht
