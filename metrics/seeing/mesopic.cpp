#include "metrics/seeing/mesopic.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double scotopic_weight = 683.0 / 1699.0;
constexpr double converged = 1e-10; // of m: 3e-10 of the luminance, far below the four digits that a and b have
constexpr int most_iterations = 200;

double luminance_at(double m, double photopic_cdm2, double scotopic_cdm2) {
    const double rods = (1.0 - m) * scotopic_weight;
    return (m * photopic_cdm2 + rods * scotopic_cdm2) / (m + rods);
}

double adapted(double mesopic_cdm2) { return std::clamp(0.7670 + 0.3334 * std::log10(mesopic_cdm2), 0.0, 1.0); }

} // namespace

Mesopic mesopic_luminance(double photopic_cdm2, double sp_ratio) {
    if (!(photopic_cdm2 > 0.0) || !std::isfinite(photopic_cdm2) || !(sp_ratio >= 0.01 && sp_ratio <= 100.0))
        throw std::invalid_argument(fmt::format("mesopic_luminance of {} cd/m2 with S/P {}", photopic_cdm2, sp_ratio));
    const double scotopic_cdm2 = sp_ratio * photopic_cdm2;
    const auto next = [&](double m) { return adapted(luminance_at(m, photopic_cdm2, scotopic_cdm2)); };
    Mesopic result;
    double m = 0.5, change = 1.0;
    while (change >= converged && result.iterations < most_iterations) {
        const double updated = next(m);
        change = std::abs(updated - m);
        m = updated;
        ++result.iterations;
    }
    result.bisected = change >= converged;
    if (result.bisected) {
        double low = 0.0, high = 1.0; // next(low) >= low and next(high) <= high, for next() stays within 0 and 1
        for (int halving = 0; halving < 60; ++halving) {
            m = 0.5 * (low + high);
            (next(m) > m ? low : high) = m;
        }
    }
    result.m = m;
    result.luminance_cdm2 = luminance_at(m, photopic_cdm2, scotopic_cdm2);
    return result;
}

} // namespace fernlicht
