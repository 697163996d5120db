#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace fernlicht {
namespace {

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
    spread.median = quantile_of(samples, 0.5);
    spread.p05 = quantile_of(samples, 0.05);
    spread.p95 = quantile_of(samples, 0.95);
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
    return quantile_of(distances, 0.5);
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

std::uint64_t below(std::uint64_t n, std::mt19937_64& generator) {
    if (n == 0)
        throw std::invalid_argument("below: there is no number below 0");
    // 2^64 mod n numbers are refused: what is left is a multiple of n, so that no remainder comes more often than another.
    const std::uint64_t refused = (std::uint64_t{0} - n) % n;
    std::uint64_t drawn = generator();
    while (drawn < refused)
        drawn = generator();
    return drawn % n;
}

std::vector<std::size_t> random_order(std::size_t n, std::mt19937_64& generator) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i)
        std::swap(order[i - 1], order[below(i, generator)]);
    return order;
}

namespace {

void check(const SampleSpread& spread) {
    if (spread.count < 1 || !std::isfinite(spread.variance) || spread.variance < 0.0)
        throw std::invalid_argument("spread_test: a count below 1, or a variance that is negative or not finite");
}

/// Of one tail of one test.
double tail(double false_alarm, std::size_t comparisons) {
    if (!(false_alarm > 0.0 && false_alarm < 1.0) || comparisons < 1)
        throw std::invalid_argument("spread_test: no comparisons, or a false alarm's probability outside 0..1");
    return 0.5 * false_alarm / static_cast<double>(comparisons);
}

} // namespace

std::optional<SpreadTest> spread_test(const SampleSpread& a, const SampleSpread& b, double false_alarm, std::size_t comparisons) {
    check(a);
    check(b);
    static_cast<void>(tail(false_alarm, comparisons)); // refuses what is none, with and without a spread
    SpreadTest test;
    test.freedom = a.count + b.count - 2;
    const double squares = (a.count - 1) * a.variance + (b.count - 1) * b.variance;
    if (test.freedom == 0 || !(squares > 0.0))
        return std::nullopt;
    test.standard_error = std::sqrt(squares / test.freedom * (1.0 / a.count + 1.0 / b.count));
    test.bound = student_bound(test.freedom, false_alarm, comparisons);
    return test;
}

double student_bound(int freedom, double false_alarm, std::size_t comparisons) {
    if (freedom < 1)
        throw std::invalid_argument("student_bound: no degrees of freedom");
    return boost::math::quantile(boost::math::complement(boost::math::students_t(freedom), tail(false_alarm, comparisons)));
}

double normal_quantile(double share) { return boost::math::quantile(boost::math::normal(), share); }

double normal_bound(double false_alarm, std::size_t comparisons) {
    return boost::math::quantile(boost::math::complement(boost::math::normal(), tail(false_alarm, comparisons)));
}

double chi_squared_bound(int freedom, double false_alarm) {
    if (freedom < 1 || !(false_alarm > 0.0 && false_alarm < 1.0))
        throw std::invalid_argument("chi_squared_bound: no degrees of freedom, or a probability outside 0..1");
    return boost::math::quantile(boost::math::complement(boost::math::chi_squared(freedom), false_alarm));
}

std::vector<float> in_order(std::vector<float> errors) {
    constexpr std::uint32_t digit_bits = 11, digits = 1U << digit_bits;
    if (errors.size() < digits || std::ranges::any_of(errors, [](float e) { return !(e >= 0.0F) || std::signbit(e); })) {
        std::ranges::sort(errors);
        return errors;
    }
    std::vector<float> other(errors.size());
    for (std::uint32_t shift = 0; shift < 32; shift += digit_bits) {
        const auto digit = [shift](float e) { return std::bit_cast<std::uint32_t>(e) >> shift & (digits - 1); };
        std::array<std::size_t, digits> place{};
        for (const float e : errors)
            ++place[digit(e)];
        std::exclusive_scan(place.begin(), place.end(), place.begin(), std::size_t{0});
        for (const float e : errors)
            other[place[digit(e)]++] = e;
        errors.swap(other);
    }
    return errors;
}

} // namespace fernlicht
