#include "metrics/noisy_difference.h"

#include "metrics/spread_test.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace fernlicht {
namespace {

void check(const NoisyPicture& a, const NoisyPicture& b) {
    for (const Image<float>* const image : {a.mean, a.variance, b.mean, b.variance}) {
        if (image->empty() || image->width() != a.mean->width() || image->height() != a.mean->height())
            throw std::invalid_argument("compare_noisy: pictures are empty or of different sizes");
        if (!std::ranges::all_of(image->pixels(), [](float value) { return std::isfinite(value); }))
            throw std::invalid_argument("compare_noisy: a value is not finite");
    }
    for (const Image<float>* const image : {a.variance, b.variance})
        if (std::ranges::any_of(image->pixels(), [](float value) { return value < 0.0F; }))
            throw std::invalid_argument("compare_noisy: a variance is below 0");
}

bool same(const Image<float>& a, const Image<float>& b) { return std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0; }

} // namespace

NoisyDifference compare_noisy(const NoisyPicture& a, const NoisyPicture& b, double threshold_absolute, double threshold_relative,
                              double false_alarm) {
    check(a, b);
    NoisyDifference out;
    out.identical = same(*a.mean, *b.mean) && same(*a.variance, *b.variance);
    double sum_a = 0.0, sum_b = 0.0, sum = 0.0, sum_variance = 0.0;
    for (std::size_t i = 0; i < a.mean->size(); ++i) {
        const double mean_a = a.mean->pixels()[i], mean_b = b.mean->pixels()[i], difference = mean_a - mean_b;
        const double variance = static_cast<double>(a.variance->pixels()[i]) + static_cast<double>(b.variance->pixels()[i]);
        sum_a += mean_a;
        sum_b += mean_b;
        if (!(variance > 0.0)) {
            out.exact_over += std::abs(difference) > threshold_absolute + threshold_relative * std::abs(mean_b) ? 1U : 0U;
            continue;
        }
        ++out.compared;
        sum += difference;
        sum_variance += variance;
        if (const double z = std::abs(difference) / std::sqrt(variance); z > out.worst_z) {
            out.worst_z = z;
            out.worst_x = static_cast<int>(i % static_cast<std::size_t>(a.mean->width()));
            out.worst_y = static_cast<int>(i / static_cast<std::size_t>(a.mean->width()));
        }
    }
    out.sum_ratio = sum_b == 0.0 ? 1.0 : sum_a / sum_b;
    if (out.compared > 0) {
        out.pixel_bound = student_bound(std::min(a.freedom, b.freedom), 0.5 * false_alarm, out.compared);
        out.sum_bound = normal_bound(0.5 * false_alarm, 1);
        out.sum_z = sum / std::sqrt(sum_variance);
    }
    return out;
}

} // namespace fernlicht
