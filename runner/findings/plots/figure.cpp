#include "runner/findings/plots/figure.h"

#include <cmath>

namespace fernlicht::plots {

Image<Colour> heat_map(const Image<float>& values, const Axis& axis, Colour missing) {
    Image<Colour> pixels(values.width(), values.height());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto value = static_cast<double>(values.pixels()[i]);
        const double t = position(axis, value);
        pixels.pixels()[i] = !std::isfinite(value) ? missing : sequential(std::isfinite(t) ? t : 0.0);
    }
    return pixels;
}

Image<Colour> difference_map(const Image<float>& values, const Axis& axis, Colour missing) {
    Image<Colour> pixels(values.width(), values.height());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double t = position(axis, static_cast<double>(values.pixels()[i]));
        pixels.pixels()[i] = std::isfinite(t) ? diverging(2.0 * t - 1.0) : missing;
    }
    return pixels;
}

} // namespace fernlicht::plots
