#include "metrics/images/pixel_errors.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

void check(const ComparedPixel& p) {
    if (!std::isfinite(p.tested) || !std::isfinite(p.reference) || !(p.standard_error >= 0.0 && std::isfinite(p.standard_error)) ||
        (p.area_m2 && !(*p.area_m2 >= 0.0 && std::isfinite(*p.area_m2))))
        throw std::invalid_argument(fmt::format("pixel {}, {} of picture {}: {} against {} +- {} over {} m2 cannot be compared", p.x, p.y,
                                                p.picture, p.tested, p.reference, p.standard_error, p.area_m2.value_or(0.0)));
}

ErrorQuantiles quantiles_of(std::vector<float> values) {
    if (values.empty())
        return {};
    std::ranges::sort(values);
    return {quantile_of(values, 0.5), quantile_of(values, 0.95), quantile_of(values, 0.99)};
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

std::optional<PixelErrors> PixelErrorFold::finish() const {
    if (errors_.empty() && dark_errors_.empty())
        return std::nullopt;
    PixelErrors all = so_far_;
    all.pixels = errors_.size();
    all.dark_pixels = dark_errors_.size();
    all.error = quantiles_of(errors_);
    all.floor = quantiles_of(floors_);
    all.dark_error = quantiles_of(dark_errors_);
    all.dark_floor = quantiles_of(dark_floors_);
    all.mean = errors_.empty() ? 0.0 : signed_sum_ / static_cast<double>(errors_.size());
    if (without_area_ == 0)
        all.area_m2 = sum_;
    for (std::size_t i = 0; i < beyond_.size(); ++i)
        all.percent_beyond[i] = sum_ > 0.0 ? 100.0 * beyond_[i] / sum_ : 0.0;
    return all;
}

} // namespace fernlicht
