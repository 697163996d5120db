#include "metrics/display/exposure.h"

#include <cmath>

namespace fernlicht {

void AdaptedLuminance::see(double log_mean_cdm2, double step_s) {
    if (!(log_mean_cdm2 > 0.0) || !std::isfinite(log_mean_cdm2))
        return;
    if (adapted_cdm2_ == 0.0) {
        adapted_cdm2_ = log_mean_cdm2;
        return;
    }
    const double tau_s = log_mean_cdm2 > adapted_cdm2_ ? brighter_s_ : darker_s_, apart = std::log(log_mean_cdm2 / adapted_cdm2_);
    adapted_cdm2_ *= std::exp(-apart * std::expm1(-step_s / tau_s));
}

} // namespace fernlicht
