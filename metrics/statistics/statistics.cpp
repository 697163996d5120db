#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace fernlicht {
namespace {

double quantile(const std::vector<double>& ascending, double share) {
    const double place = share * static_cast<double>(ascending.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, ascending.size() - 1);
    return std::lerp(ascending[below], ascending[above], place - static_cast<double>(below));
}

void refuse_not_finite(const std::vector<double>& samples) {
    if (!std::ranges::all_of(samples, [](double sample) { return std::isfinite(sample); }))
        throw std::invalid_argument("spread of samples: a sample is not finite");
}

} // namespace

std::optional<Spread> spread_of(std::vector<double> samples) {
    if (samples.empty())
        return std::nullopt;
    refuse_not_finite(samples);
    std::ranges::sort(samples);
    const auto count = static_cast<double>(samples.size());
    Spread spread;
    spread.count = samples.size();
    spread.median = quantile(samples, 0.5);
    spread.p05 = quantile(samples, 0.05);
    spread.p95 = quantile(samples, 0.95);
    spread.minimum = samples.front();
    spread.maximum = samples.back();
    spread.mean = std::accumulate(samples.begin(), samples.end(), 0.0) / count;
    // Two passes: the textbook's one-pass difference of squares loses every digit when the spread is small beside the mean.
    double squares = 0.0;
    for (const double sample : samples)
        squares += (sample - spread.mean) * (sample - spread.mean);
    spread.standard_deviation = samples.size() > 1 ? std::sqrt(squares / (count - 1.0)) : 0.0;
    return spread;
}

std::optional<double> median_absolute_deviation(const std::vector<double>& samples) {
    const std::optional<Spread> spread = spread_of(samples);
    if (!spread)
        return std::nullopt;
    std::vector<double> distances;
    for (const double sample : samples)
        distances.push_back(std::abs(sample - spread->median));
    std::ranges::sort(distances);
    return quantile(distances, 0.5);
}

std::optional<MedianInterval> median_interval(std::vector<double> samples, double confidence) {
    refuse_not_finite(samples);
    std::ranges::sort(samples);
    const std::size_t n = samples.size();
    // In logarithms: 2^-n is no double from n = 1075 on.
    double log_chance = -static_cast<double>(n) * std::log(2.0); // of exactly k heads
    double fewer = 0.0;                                          // chance of fewer than k + 1 heads
    std::optional<MedianInterval> interval;
    for (std::size_t k = 0; 2 * (k + 1) <= n; ++k) {
        fewer += std::exp(log_chance);
        if (1.0 - 2.0 * fewer < confidence)
            break;
        interval = {samples[k], samples[n - 1 - k], 1.0 - 2.0 * fewer};
        log_chance += std::log(static_cast<double>(n - k) / static_cast<double>(k + 1));
    }
    return interval;
}

} // namespace fernlicht
