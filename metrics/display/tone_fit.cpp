#include "metrics/display/tone_fit.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double ln_10 = 2.302585092994045684;
constexpr double darkest_share = 0.005; // of the pixels may lie below the darkest luminance worth showing
constexpr std::size_t histogram_bins =
    static_cast<std::size_t>(LuminanceHistogram::last_decade - LuminanceHistogram::first_decade) * LuminanceHistogram::bins_a_decade;
constexpr double bin_ln = ln_10 / LuminanceHistogram::bins_a_decade;

/// Sum of the slopes, each cut to its bounds, as it rises with their common factor.
double summed(const std::vector<double>& shares, double factor, double least, double most) {
    double sum = 0.0;
    for (const double share : shares)
        sum += std::clamp(factor * share, least, most);
    return sum;
}

} // namespace

LuminanceHistogram::LuminanceHistogram() : counts_(histogram_bins, 0) {}

double LuminanceHistogram::bin_cdm2(std::size_t bin) { return std::exp(ln_10 * first_decade + bin_ln * static_cast<double>(bin)); }

void LuminanceHistogram::add(double luminance_cdm2) {
    ++pixels_;
    if (!std::isfinite(luminance_cdm2))
        return;
    most_ = std::max(most_, luminance_cdm2);
    if (luminance_cdm2 < bin_cdm2(0))
        return;
    const double at = (std::log(luminance_cdm2) - ln_10 * first_decade) / bin_ln;
    ++counts_[std::min(static_cast<std::size_t>(at), histogram_bins - 1)];
    ++counted_;
    ln_sum_ += std::log(luminance_cdm2);
}

void LuminanceHistogram::add(const Image<float>& luminance_cdm2) {
    for (const float value : luminance_cdm2.pixels())
        add(static_cast<double>(value));
}

double LuminanceHistogram::log_mean_cdm2() const { return counted_ == 0 ? 0.0 : std::exp(ln_sum_ / static_cast<double>(counted_)); }

double fitted_s(double luminance_cdm2, double l_max_cdm2, double share) {
    if (!(luminance_cdm2 > 0.0 && luminance_cdm2 < l_max_cdm2))
        return 1.0;
    return std::max(1.0, share * (l_max_cdm2 - luminance_cdm2) / (luminance_cdm2 * (1.0 - share)));
}

ToneMapper histogram_mapper(const LuminanceHistogram& histogram, double l_max_cdm2, double range, double min_slope) {
    ToneMapper mapper{ToneMapperKind::linear, 1.0, l_max_cdm2, {}};
    const std::vector<std::uint64_t>& counts = histogram.counts();
    std::uint64_t counted = 0, below = 0;
    for (const std::uint64_t count : counts)
        counted += count;
    std::size_t first = 0;
    while (first < counts.size() && static_cast<double>(below + counts[first]) <= darkest_share * static_cast<double>(counted))
        below += counts[first++];
    if (first == counts.size() || !(LuminanceHistogram::bin_cdm2(first + 1) < l_max_cdm2))
        return mapper;
    const auto end =
        static_cast<std::size_t>(std::ceil((std::log(l_max_cdm2) - std::log(LuminanceHistogram::bin_cdm2(first))) / bin_ln - 1.0e-9)) +
        first;
    const double display_ln = -std::log(range), ln_first = std::log(LuminanceHistogram::bin_cdm2(first)), ln_last = std::log(l_max_cdm2);
    if (ln_last - ln_first <= display_ln)
        return mapper;
    const std::size_t bins = end - first;
    const double step_ln = (ln_last - ln_first) / static_cast<double>(bins), mean_slope = display_ln / (ln_last - ln_first);
    std::vector<double> shares(bins, 0.0);
    for (std::size_t i = 0; i < bins; ++i)
        shares[i] = first + i < counts.size() ? static_cast<double>(counts[first + i]) / static_cast<double>(counted) : 0.0;
    const double least = min_slope * mean_slope, wanted = display_ln / step_ln;
    // All slopes at 1 give more than is wanted, all at the least less; bins without pixels stay at the least, so that the most of the rest
    // may not suffice: then the empty ones take what is left, evenly.
    double low = 0.0, high = 1.0;
    while (summed(shares, high, least, 1.0) < wanted && high < 1.0e12)
        high *= 2.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (summed(shares, middle, least, 1.0) < wanted ? low : high) = middle;
    }
    std::vector<double> slopes(bins);
    for (std::size_t i = 0; i < bins; ++i)
        slopes[i] = std::clamp(high * shares[i], least, 1.0);
    const double missing = wanted - summed(shares, high, least, 1.0);
    const auto empty = static_cast<double>(std::ranges::count(shares, 0.0));
    if (missing > 0.0 && empty > 0.0)
        for (std::size_t i = 0; i < bins; ++i)
            slopes[i] += shares[i] == 0.0 ? missing / empty : 0.0;
    mapper.kind = ToneMapperKind::histogram;
    double ln_share = -display_ln, sum = 0.0;
    for (const double slope : slopes)
        sum += slope * step_ln;
    for (std::size_t i = 0; i <= bins; ++i) {
        mapper.curve.push_back({ln_first + step_ln * static_cast<double>(i), i == bins ? 0.0 : ln_share});
        if (i < bins)
            ln_share += slopes[i] * step_ln * (display_ln / sum);
    }
    mapper.curve.back().ln_luminance = ln_last;
    return mapper;
}

void AdaptedLuminance::see(double log_mean_cdm2, double step_s) {
    if (!(log_mean_cdm2 > 0.0) || !std::isfinite(log_mean_cdm2))
        return;
    if (adapted_cdm2_ == 0.0) {
        adapted_cdm2_ = log_mean_cdm2;
        return;
    }
    const double tau_s = log_mean_cdm2 > adapted_cdm2_ ? brighter_s_ : darker_s_, apart = std::log(log_mean_cdm2 / adapted_cdm2_);
    adapted_cdm2_ *= std::exp(-apart * std::expm1(-step_s / tau_s));
}

} // namespace fernlicht
