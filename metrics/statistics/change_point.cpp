#include "metrics/statistics/change_point.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <tuple>

namespace fernlicht {
namespace {

/// As far from the median as a bad night counts.
constexpr double clipped_at = 3.0, deviations_of_mad = 1.4826;
/// So many times as many orders as the p takes that a discovery alone among all needs.
constexpr double orders_of_one_discovery = 10.0;

/// The sums before each sample, off their expectation, need nothing else: mean and variance do not depend on the order.
struct StepSearch {
    double mean = 0.0;
    std::vector<double> scale; ///< of the sum of the first t + 1, for a standard deviation of one

    explicit StepSearch(const std::vector<double>& samples) {
        if (std::ranges::adjacent_find(samples, std::ranges::not_equal_to{}) == samples.end())
            return; // of equal ones the mean may be rounded
        const auto n = static_cast<double>(samples.size());
        mean = std::accumulate(samples.begin(), samples.end(), 0.0) / n;
        double squares = 0.0;
        for (const double sample : samples)
            squares += (sample - mean) * (sample - mean);
        for (std::size_t t = 1; t < samples.size(); ++t) {
            const auto before = static_cast<double>(t);
            scale.push_back(1.0 / std::sqrt(squares / (n - 1.0) * before * (n - before) / n));
        }
    }
    LevelStep largest(const std::vector<double>& samples) const {
        LevelStep step;
        double sum = 0.0;
        for (std::size_t t = 0; t < scale.size(); ++t) {
            sum += samples[t] - mean;
            if (const double z = std::abs(sum) * scale[t]; z > step.z)
                step = {t + 1, z};
        }
        return step;
    }
};

std::vector<double> clipped_logarithms(const std::vector<double>& times) {
    std::vector<double> logarithms;
    for (const double time : times) {
        if (!(std::isfinite(time) && time > 0.0))
            throw std::invalid_argument("change_point: a time is not finite and above 0");
        logarithms.push_back(std::log(time));
    }
    const std::optional<Spread> spread = spread_of(logarithms);
    const double reach = clipped_at * deviations_of_mad * median_absolute_deviation(logarithms).value_or(0.0);
    if (spread && reach > 0.0) // more than half of them may be one and the same
        for (double& one : logarithms)
            one = std::clamp(one, spread->median - reach, spread->median + reach);
    return logarithms;
}

double median_of(const std::vector<double>& times, std::size_t first, std::size_t end) {
    return spread_of({times.begin() + static_cast<std::ptrdiff_t>(first), times.begin() + static_cast<std::ptrdiff_t>(end)})->median;
}

/// Of a series, not yet known to have one level.
struct SeriesPart {
    std::size_t series = 0, first = 0, end = 0;
};

} // namespace

std::optional<LevelStep> largest_step(const std::vector<double>& samples) {
    if (!std::ranges::all_of(samples, [](double sample) { return std::isfinite(sample); }))
        throw std::invalid_argument("largest_step: a sample is not finite");
    if (samples.size() < 2)
        return std::nullopt;
    const StepSearch search(samples);
    return search.scale.empty() ? std::nullopt : std::optional(search.largest(samples));
}

std::optional<ChangePoint> change_point(const std::vector<double>& times, std::uint64_t seed, int orders) {
    std::vector<double> samples = clipped_logarithms(times);
    if (samples.size() < fewest_samples_of_change)
        return std::nullopt;
    const StepSearch search(samples);
    if (search.scale.empty())
        return std::nullopt;
    const LevelStep found = search.largest(samples);
    std::mt19937_64 generator(seed);
    int as_large = 1;
    const double least = found.z * (1.0 - 1e-12); // the same split, its sum rounded otherwise
    for (int order = 0; order < orders; ++order) {
        for (std::size_t i = samples.size(); i > 1; --i)
            std::swap(samples[i - 1], samples[below(i, generator)]);
        as_large += search.largest(samples).z >= least ? 1 : 0;
    }
    return ChangePoint{found.first, static_cast<double>(as_large) / (1.0 + orders),
                       median_of(times, found.first, times.size()) / median_of(times, 0, found.first)};
}

std::vector<bool> discoveries(const std::vector<double>& p, double rate) {
    const auto is_share = [](double share) { return share >= 0.0 && share <= 1.0; };
    if (!is_share(rate) || !std::ranges::all_of(p, is_share))
        throw std::invalid_argument("discoveries: a probability outside 0..1");
    std::vector<double> ascending = p;
    std::ranges::sort(ascending);
    double bound = -1.0;
    for (std::size_t i = 0; i < ascending.size(); ++i)
        if (ascending[i] <= rate * static_cast<double>(i + 1) / static_cast<double>(ascending.size()))
            bound = ascending[i];
    std::vector<bool> found;
    for (const double one : p)
        found.push_back(one <= bound);
    return found;
}

std::vector<SeriesChange> change_points(const std::vector<std::vector<double>>& series, double rate) {
    std::vector<SeriesPart> parts;
    for (std::size_t i = 0; i < series.size(); ++i)
        parts.push_back({i, 0, series[i].size()});
    std::vector<SeriesChange> found;
    while (!parts.empty()) {
        const auto times_of = [&](const SeriesPart& part) {
            const auto begin = series[part.series].begin();
            return std::vector<double>(begin + static_cast<std::ptrdiff_t>(part.first), begin + static_cast<std::ptrdiff_t>(part.end));
        };
        std::vector<SeriesPart> tested;
        std::vector<ChangePoint> changes;
        std::vector<double> p;
        for (const SeriesPart& part : parts)
            if (const std::optional<ChangePoint> change = change_point(times_of(part))) {
                tested.push_back(part);
                changes.push_back(*change);
                p.push_back(change->p);
            }
        parts.clear();
        std::vector<bool> is_found = discoveries(p, rate);
        // A discovery alone among many passes a bound that so few orders cannot reach. Few wait for it: at a
        // rate of 1 % fewer than one part in a hundred, or those of the least p would be found together.
        const double orders = rate > 0.0 ? std::ceil(orders_of_one_discovery * static_cast<double>(p.size()) / rate) : 0.0;
        if (orders > orders_of_change && orders < std::numeric_limits<int>::max()) {
            for (std::size_t i = 0; i < tested.size(); ++i)
                if (!is_found[i] && p[i] <= 1.0 / (1.0 + orders_of_change)) {
                    changes[i] = *change_point(times_of(tested[i]), 1, static_cast<int>(orders));
                    p[i] = changes[i].p;
                }
            is_found = discoveries(p, rate);
        }
        for (std::size_t i = 0; i < tested.size(); ++i)
            if (is_found[i]) {
                const std::size_t split = tested[i].first + changes[i].first;
                found.push_back({tested[i].series, {split, changes[i].p, changes[i].ratio}});
                parts.push_back({tested[i].series, tested[i].first, split});
                parts.push_back({tested[i].series, split, tested[i].end});
            }
    }
    std::ranges::sort(found, {}, [](const SeriesChange& one) { return std::tuple(one.series, one.change.first); });
    // A ratio of the parts next to the change alone, now that they are known.
    for (std::size_t i = 0; i < found.size(); ++i) {
        const bool follows = i > 0 && found[i - 1].series == found[i].series,
                   precedes = i + 1 < found.size() && found[i + 1].series == found[i].series;
        const std::vector<double>& all = series[found[i].series];
        ChangePoint& change = found[i].change;
        change.ratio = median_of(all, change.first, precedes ? found[i + 1].change.first : all.size()) /
                       median_of(all, follows ? found[i - 1].change.first : 0, change.first);
    }
    return found;
}

} // namespace fernlicht
