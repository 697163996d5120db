// When did a series change its level, and in which of many series is that more than chance?
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace fernlicht {

struct LevelStep {
    std::size_t first = 0; ///< sample with which the new level begins, 1 .. n - 1
    double z = 0.0;        ///< the sum of the samples before it, off what a random order would give, in standard deviations of that
};
/// The split of a series that tells two levels apart best: the largest |S_t - t m| / sqrt(s^2 t (n - t) / n) over t = 1 .. n - 1, S_t the
/// sum of the first t of n samples, m their mean and s^2 their variance (n - 1). z^2 / (n - 1) is the share of the variance that two levels
/// explain, so the F of two groups is (n - 2) z^2 / (n - 1 - z^2): the likelihood ratio of James, James and Siegmund (1987). nullopt where
/// nothing varies, or of fewer than two samples. Throws std::invalid_argument for NaN or infinity.
std::optional<LevelStep> largest_step(const std::vector<double>& samples);

struct ChangePoint {
    std::size_t first = 0; ///< sample with which the new level begins
    double p = 1.0;        ///< share of random orders whose largest step is as large (Antoch and Huskova 2001), the order found among them
    double ratio = 1.0;    ///< median from there on over median before
};
/// Fewer samples are not tested.
inline constexpr std::size_t fewest_samples_of_change = 6;
inline constexpr int orders_of_change = 9999;

/// Of times: the largest step of their logarithms, clipped at three robust standard deviations (1.4826 times the median absolute deviation)
/// from the median, so that one bad night neither makes a change nor hides one. What clips does not depend on the order: p is exact for
/// independent samples of one distribution, whatever it is. The same samples and seed give the same p on every machine. nullopt for fewer
/// than fewest_samples_of_change and where nothing varies. Throws std::invalid_argument for a time that is not finite and above 0.
std::optional<ChangePoint> change_point(const std::vector<double>& times, std::uint64_t seed = 1, int orders = orders_of_change);

/// Which of these tests are discoveries, of which at most a share of `rate` is expected to be false: the procedure of Benjamini and
/// Hochberg (1995), for independent or positively dependent tests. Throws std::invalid_argument for a p or a rate outside 0..1.
std::vector<bool> discoveries(const std::vector<double>& p, double rate);

struct SeriesChange {
    std::size_t series = 0;
    ChangePoint change;
};
/// All changes of several series, by series and sample: each series whole, then the parts on both sides of what was found (binary
/// segmentation), with discoveries() over all parts of one round. Where none of orders_of_change random orders steps as far, and the p of
/// that is too large for a discovery, 10 m / rate orders of the m parts tell. A rise and a fall that cancel can hide each other. Errors as
/// change_point.
std::vector<SeriesChange> change_points(const std::vector<std::vector<double>>& series, double rate);

} // namespace fernlicht
