// Whether two means differ by more than their samples' own spread explains.
#pragma once

#include <cstddef>
#include <optional>

namespace fernlicht {

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

} // namespace fernlicht
