#include "metrics/images/flip_colour.h"

namespace fernlicht::flip {

ErrorScale error_scale() {
    const ColourMatrix& m = white_of_rgb;
    const HuntLab green = hunt_lab(m[4], m[1] - m[4], m[4] - m[7]), blue = hunt_lab(m[5], m[2] - m[5], m[5] - m[8]);
    const double da = static_cast<double>(green.a - blue.a), db = static_cast<double>(green.b - blue.b);
    const double largest = std::pow(std::abs(static_cast<double>(green.l - blue.l)) + std::hypot(da, db), 0.7);
    const double knee = 0.4 * largest;
    return {static_cast<float>(knee), static_cast<float>(0.95 / knee), static_cast<float>(0.05 / (largest - knee))};
}

} // namespace fernlicht::flip
