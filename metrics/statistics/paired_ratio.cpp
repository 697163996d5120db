#include "metrics/statistics/paired_ratio.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fernlicht {

std::optional<PairedRatio> paired_ratio(const std::vector<double>& times, const std::vector<double>& reference) {
    const auto is_time = [](double time) { return std::isfinite(time) && time > 0.0; };
    if (times.size() != reference.size())
        throw std::invalid_argument("paired_ratio: a time has no partner");
    if (!std::ranges::all_of(times, is_time) || !std::ranges::all_of(reference, is_time))
        throw std::invalid_argument("paired_ratio: a time is not finite and above 0");
    std::vector<double> logarithms;
    for (std::size_t i = 0; i < times.size(); ++i)
        logarithms.push_back(std::log(times[i] / reference[i]));
    const std::optional<Spread> spread = spread_of(std::move(logarithms));
    if (!spread)
        return std::nullopt;
    PairedRatio ratio{spread->count, std::exp(spread->median), std::exp(spread->p05), std::exp(spread->p95)};
    if (ratio.rounds >= fewest_rounds && spread->p05 > 0.0)
        ratio.difference = Difference::slower;
    if (ratio.rounds >= fewest_rounds && spread->p95 < 0.0)
        ratio.difference = Difference::faster;
    return ratio;
}

} // namespace fernlicht
