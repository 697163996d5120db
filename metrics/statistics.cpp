#include "metrics/statistics.h"

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

} // namespace

std::optional<Spread> spread_of(std::vector<double> samples) {
    if (samples.empty())
        return std::nullopt;
    if (!std::ranges::all_of(samples, [](double sample) { return std::isfinite(sample); }))
        throw std::invalid_argument("spread_of: a sample is not finite");
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

} // namespace fernlicht
