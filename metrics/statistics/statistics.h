// Spread of repeated measurements.
// Is one way slower than another? Times taken in pairs, one pair a round, so that what slows a whole round down cancels.
// Chance that is the same on every machine. std::mt19937_64 is specified to the bit; std::shuffle and the standard's distributions are not.
// Whether two means differ by more than their samples' own spread explains.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace fernlicht {

struct Spread {
    std::size_t count = 0;
    double median = 0.0, p05 = 0.0, p95 = 0.0, minimum = 0.0, maximum = 0.0, mean = 0.0, standard_deviation = 0.0;
};
/// nullopt for no samples; throws std::invalid_argument for NaN or infinity. The deviation is the sample's (n - 1), 0 for one sample.
/// Quantiles by linear interpolation between order statistics (type 7 of Hyndman and Fan 1996).
std::optional<Spread> spread_of(std::vector<double> samples);

/// Type 7 of values in ascending order, at least one; `share` from 0 to 1.
template <class Number> double quantile_of(const std::vector<Number>& ascending, double share) {
    const double place = share * static_cast<double>(ascending.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, ascending.size() - 1);
    return std::lerp(static_cast<double>(ascending[below]), static_cast<double>(ascending[above]), place - static_cast<double>(below));
}

/// Ascending; floats of 0 and above, as errors are: by their bits, in a fifth of the time that comparing takes.
std::vector<float> in_order(std::vector<float> errors);

/// By nearest rank.
template <class Number> double by_nearest_rank(const std::vector<Number>& ascending, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(ascending.size())));
    return static_cast<double>(ascending[rank > 0 ? rank - 1 : 0]);
}

/// The value that this share of them lies below, of an even number's half the upper one; 0 of none.
template <class Number> double middle_of(std::vector<Number> values, double share = 0.5) {
    if (values.empty())
        return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
    std::ranges::nth_element(values, middle);
    return static_cast<double>(*middle);
}

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

enum class Difference { faster, slower, not_distinguishable };

struct PairedRatio {
    std::size_t rounds = 0;
    double median = 0.0, p05 = 0.0, p95 = 0.0; ///< of time / reference within a round; above 1: slower
    Difference difference = Difference::not_distinguishable;
};

/// Fewer rounds tell nothing: five ratios on one side of 1 come by chance in one case of 16, six in one of 32.
inline constexpr std::size_t fewest_rounds = 6;

/// Spread of the ratios over the rounds, and what they say. A difference is real only when it is larger than the spread: when 1 lies
/// outside p05 .. p95. Quantiles as those of spread_of, but of the ratios' logarithms, so that exchanging both ways inverts ratio and
/// spread and turns the verdict round. nullopt for no rounds. Throws std::invalid_argument when a time has no partner or is not finite and
/// above 0.
std::optional<PairedRatio> paired_ratio(const std::vector<double>& times, const std::vector<double>& reference);

/// Evenly one of 0 .. n - 1. Throws std::invalid_argument for n = 0.
std::uint64_t below(std::uint64_t n, std::mt19937_64& generator);

/// 0 .. n - 1 in an order drawn evenly from all (Fisher and Yates 1938, in the form of Durstenfeld 1964, from the end).
std::vector<std::size_t> random_order(std::size_t n, std::mt19937_64& generator);

struct SampleSpread {
    int count = 1;         ///< samples, at least one
    double variance = 0.0; ///< theirs, with n - 1; 0 for one sample
};

struct SpreadTest {
    double standard_error = 0.0; ///< of the difference of the two means
    int freedom = 0;             ///< degrees of freedom of the variance
    double bound = 0.0;          ///< times standard_error: what chance reaches with `false_alarm` at most
};

/// Student's test of two means with a pooled variance: s^2 = (sum of (n_i - 1) s_i^2) / (sum of (n_i - 1)), standard error
/// s sqrt(1/n_1 + 1/n_2), bound the two-sided quantile of Student's t at false_alarm / comparisons (Bonferroni: all `comparisons` tests
/// together give a false alarm with a probability of `false_alarm` at most, however they hang together). With many samples t is the normal
/// z. Exact for normally distributed samples of one variance.
/// nullopt where nothing varies: no variance in either, or one sample on both sides. Throws std::invalid_argument for counts below 1,
/// a variance below 0 or not finite, comparisons below 1 and false_alarm outside 0..1.
std::optional<SpreadTest> spread_test(const SampleSpread& a, const SampleSpread& b, double false_alarm, std::size_t comparisons);

/// Two-sided quantile of Student's t with `freedom` degrees of freedom, at least 1. Otherwise as normal_bound.
double student_bound(int freedom, double false_alarm, std::size_t comparisons);

/// Two-sided quantile of the normal distribution at false_alarm / comparisons: |z| beyond it in one of `comparisons` values happens with a
/// probability of `false_alarm` at most. Errors as spread_test.
double normal_bound(double false_alarm, std::size_t comparisons);

/// What a standard normal value lies below with this probability, 0 < share < 1. Throws std::domain_error outside.
double normal_quantile(double share);

/// What a sum of `freedom` squares of standard normal values exceeds with a probability of `false_alarm`. Throws std::invalid_argument for
/// freedom below 1 and false_alarm outside 0..1.
double chi_squared_bound(int freedom, double false_alarm);

} // namespace fernlicht
