// Spread of repeated measurements.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace fernlicht {

struct Spread {
    std::size_t count = 0;
    double median = 0.0, p05 = 0.0, p95 = 0.0, minimum = 0.0, maximum = 0.0, mean = 0.0, standard_deviation = 0.0;
};
/// nullopt for no samples; throws std::invalid_argument for NaN or infinity. The deviation is the sample's (n - 1), 0 for one sample.
/// Quantiles by linear interpolation between order statistics (type 7 of Hyndman and Fan 1996).
std::optional<Spread> spread_of(std::vector<double> samples);

} // namespace fernlicht
