#include "scenarios/vehicle/step_response.h"

#include <cmath>
#include <complex>

namespace fernlicht {

double step_response(double w, double z, double t_s) {
    if (t_s <= 0.0)
        return 0.0;
    if (z == 1.0)
        return 1.0 - std::exp(-w * t_s) * (1.0 + w * t_s);
    const std::complex<double> root = std::sqrt(std::complex<double>(z * z - 1.0));
    const std::complex<double> a = w * (-z + root), b = w * (-z - root);
    return 1.0 + ((b * std::exp(a * t_s) - a * std::exp(b * t_s)) / (a - b)).real();
}

} // namespace fernlicht
