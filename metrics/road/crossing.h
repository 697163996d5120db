// How illuminance runs between two neighbouring samples, and where it meets a limit there.
#pragma once

#include <cmath>

namespace fernlicht {

/// Away from the lamps light falls off by powers of distance and beams by factors per degree: straight in the logarithm. Where
/// either sample is dark there is no logarithm, and the value runs straight.
inline double between_samples(double a, double b, double share) {
    return a > 0.0 && b > 0.0 ? a * std::pow(b / a, share) : a + (b - a) * share;
}

/// Share of the way from `a` to `b` at which `limit` is met; one of the two lies below it, the other does not. limit > 0.
inline double crossing_share(double a, double b, double limit) {
    return a > 0.0 && b > 0.0 ? std::log(a / limit) / std::log(a / b) : (a - limit) / (a - b);
}

} // namespace fernlicht
