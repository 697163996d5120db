#include "metrics/aliasing/contrast_sensitivity.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace fernlicht {

double still_contrast_sensitivity(double cycles_per_degree, double luminance_cdm2) {
    const double u2 = cycles_per_degree * cycles_per_degree;
    if (!(cycles_per_degree >= 0.0 && luminance_cdm2 > 0.0 && std::isfinite(u2) && std::isfinite(luminance_cdm2)))
        throw std::invalid_argument("a contrast sensitivity takes a frequency from 0 up and a luminance above 0");
    if (u2 == 0.0)
        return 0.0;
    const double optics = std::exp(-0.0016 * u2 * std::pow(1.0 + 100.0 / luminance_cdm2, 0.08));
    const double extent = 1.0 + 1.44 + 0.64 * u2;
    const double noise = 63.0 / std::pow(luminance_cdm2, 0.83) - 1.0 / std::expm1(-0.02 * u2);
    return 5200.0 * optics / std::sqrt(extent * noise);
}

double flicker_sensitivity(double cycles_per_degree, double hertz) {
    if (!(cycles_per_degree > 0.0 && hertz >= 0.0 && std::isfinite(cycles_per_degree) && std::isfinite(hertz)))
        throw std::invalid_argument("a flicker sensitivity takes a spatial frequency above 0 and a temporal one from 0 up");
    if (hertz == 0.0)
        return 0.0;
    const double a = 2.0 * std::numbers::pi * cycles_per_degree, v = hertz / cycles_per_degree;
    const double slowness = std::abs(std::log10(v / 3.0));
    return (6.1 + 7.3 * slowness * slowness * slowness) * v * a * a * std::exp(-2.0 * a * (v + 2.0) / 45.9);
}

} // namespace fernlicht
