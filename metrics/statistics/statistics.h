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

/// Median of the distances from the median: what one outlier cannot move. nullopt and errors as spread_of.
std::optional<double> median_absolute_deviation(const std::vector<double>& samples);

struct MedianInterval {
    double low = 0.0, high = 0.0;
    double confidence = 0.0; ///< what the interval has: at least what was asked for
};
/// Where the median of what the samples were drawn from lies, whatever its distribution: the k-th sample from below to the k-th from above
/// with the largest k for which 1 - 2 P(fewer than k of n coins show heads) is at least `confidence` (0..1; the sign test turned round).
/// Samples must be independent. nullopt for too few of them: 0.95 needs six. Throws std::invalid_argument for NaN or infinity.
std::optional<MedianInterval> median_interval(std::vector<double> samples, double confidence = 0.95);

} // namespace fernlicht
