#include "metrics/images/pixel_errors.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <span>
#include <stdexcept>

namespace fernlicht {
namespace {

void check(const ComparedPixel& p) {
    if (!std::isfinite(p.tested) || !std::isfinite(p.reference) || !(p.standard_error >= 0.0 && std::isfinite(p.standard_error)) ||
        (p.area_m2 && !(*p.area_m2 >= 0.0 && std::isfinite(*p.area_m2))))
        throw std::invalid_argument(fmt::format("pixel {}, {} of picture {}: {} against {} +- {} over {} m2 cannot be compared", p.x, p.y,
                                                p.picture, p.tested, p.reference, p.standard_error, p.area_m2.value_or(0.0)));
}

ErrorQuantiles quantiles_of(const std::vector<float>& ascending) {
    if (ascending.empty())
        return {};
    return {quantile_of(ascending, 0.5), quantile_of(ascending, 0.95), quantile_of(ascending, 0.99)};
}

void keep_worse(WorstPixel& worst, double error, const ComparedPixel& p, bool first) {
    if (first || error > worst.error)
        worst = {error, p.tested, p.reference, p.picture, p.x, p.y};
}

} // namespace

void PixelErrorFold::add(const ComparedPixel& p) {
    check(p);
    const double difference = std::abs(p.tested - p.reference), noise = rule_.sure * p.standard_error;
    if (p.reference < rule_.relative_from) {
        keep_worse(so_far_.dark_worst, difference, p, dark_errors_.empty());
        dark_errors_.push_back(static_cast<float>(difference));
        dark_floors_.push_back(static_cast<float>(noise));
        return;
    }
    if (!errors_.empty() && p.area_m2.has_value() == (without_area_ > 0))
        throw std::invalid_argument(
            fmt::format("pixel {}, {} of picture {} has {} area, and others are not so", p.x, p.y, p.picture, p.area_m2 ? "an" : "no"));
    const double error = difference / p.reference;
    keep_worse(so_far_.worst, error, p, errors_.empty());
    errors_.push_back(static_cast<float>(error));
    floors_.push_back(static_cast<float>(noise / p.reference));
    signed_sum_ += (p.tested - p.reference) / p.reference;
    const double weight = p.area_m2.value_or(1.0);
    sum_ += weight;
    without_area_ += p.area_m2 ? 0U : 1U;
    for (std::size_t i = 0; i < counted_errors.size(); ++i)
        if (difference > counted_errors[i] * p.reference + noise)
            beyond_[i] += weight;
}

// Woodruff (1952): the share of pixels beyond the sample's quantile is a ratio of tiles' sums, k of n pixels each, whose variance is that
// of k - p n within the rows that tiles were drawn from (Cochran 1977, 6.3 and 5.6, with the correction for a finite number of tiles); two
// standard deviations of that share to both sides are ranks of the sample.
std::optional<QuantileInterval> PixelErrorFold::p95_between(const std::vector<float>& ascending, std::size_t tiles_of_row) const {
    if (ascending.empty() || tiles_.empty())
        return std::nullopt;
    constexpr double share = 0.05;
    const double beyond = quantile_of(ascending, 1.0 - share), pixels = static_cast<double>(errors_.size());
    std::map<int, std::vector<double>> rows;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        const std::size_t end = t + 1 < tiles_.size() ? tiles_[t + 1].first : errors_.size();
        const std::span<const float> here(errors_.data() + tiles_[t].first, end - tiles_[t].first);
        const auto over = std::ranges::count_if(here, [&](float error) { return static_cast<double>(error) > beyond; });
        rows[tiles_[t].row].push_back(static_cast<double>(over) - share * static_cast<double>(here.size()));
    }
    if (std::ranges::all_of(rows, [&](const auto& row) { return row.second.size() >= tiles_of_row; }))
        return std::nullopt; // none is missing
    double variance = 0.0;
    for (const auto& [row, of_tile] : rows) {
        if (of_tile.size() < 2)
            return std::nullopt;
        const double deviation = spread_of(of_tile)->standard_deviation, drawn = static_cast<double>(of_tile.size());
        variance += (1.0 - drawn / static_cast<double>(tiles_of_row)) * drawn * deviation * deviation;
    }
    const double two_deviations = 2.0 * std::sqrt(variance) / pixels;
    if (two_deviations > share)
        return std::nullopt; // the sample's largest error bounds nothing
    return QuantileInterval{quantile_of(ascending, 1.0 - share - two_deviations), quantile_of(ascending, 1.0 - share + two_deviations)};
}

std::optional<PixelErrors> PixelErrorFold::finish(std::size_t tiles_of_row) const {
    if (errors_.empty() && dark_errors_.empty())
        return std::nullopt;
    PixelErrors all = so_far_;
    all.pixels = errors_.size();
    all.dark_pixels = dark_errors_.size();
    const std::vector<float> ascending = in_order(errors_);
    all.error = quantiles_of(ascending);
    all.p95_between = p95_between(ascending, tiles_of_row);
    all.floor = quantiles_of(in_order(floors_));
    all.dark_error = quantiles_of(in_order(dark_errors_));
    all.dark_floor = quantiles_of(in_order(dark_floors_));
    all.mean = errors_.empty() ? 0.0 : signed_sum_ / static_cast<double>(errors_.size());
    if (without_area_ == 0)
        all.area_m2 = sum_;
    for (std::size_t i = 0; i < beyond_.size(); ++i)
        all.percent_beyond[i] = sum_ > 0.0 ? 100.0 * beyond_[i] / sum_ : 0.0;
    return all;
}

} // namespace fernlicht
