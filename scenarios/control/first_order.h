// A first-order filter and a limit on the rate of change, stepped exactly: their results at a time do not depend on how it is cut into
// steps while the input holds.
#pragma once

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

} // namespace fernlicht
