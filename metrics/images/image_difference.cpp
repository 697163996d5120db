#include "metrics/images/image_difference.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace fernlicht {
namespace {

void check_finite(const Image<float>& image, const char* which) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (!std::isfinite(image.at(x, y)))
                throw std::invalid_argument(fmt::format("{} picture: pixel {}, {} is {}", which, x, y, image.at(x, y)));
}

void check_comparable(const Image<float>& tested, const Image<float>& reference) {
    if (tested.width() != reference.width() || tested.height() != reference.height())
        throw std::invalid_argument(fmt::format("pictures of {}x{} and {}x{} cannot be compared", tested.width(), tested.height(),
                                                reference.width(), reference.height()));
    if (tested.empty())
        throw std::invalid_argument("empty pictures cannot be compared");
    check_finite(tested, "tested");
    check_finite(reference, "reference");
}

double psnr(double peak, double rmse) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (rmse == 0.0)
        return infinity;
    return peak > 0.0 ? 20.0 * std::log10(peak / rmse) : -infinity;
}

} // namespace

ImageDifference compare_images(const Image<float>& tested, const Image<float>& reference, double threshold_absolute,
                               double threshold_relative) {
    check_comparable(tested, reference);
    if (!(threshold_absolute >= 0.0 && threshold_relative >= 0.0))
        throw std::invalid_argument(
            fmt::format("thresholds {} and {} of a comparison must not be negative", threshold_absolute, threshold_relative));
    ImageDifference result;
    double squares = 0.0;
    double peak = 0.0;
    std::size_t over = 0;
    for (int y = 0; y < tested.height(); ++y)
        for (int x = 0; x < tested.width(); ++x) {
            const double expected = static_cast<double>(reference.at(x, y));
            const double difference = std::abs(static_cast<double>(tested.at(x, y)) - expected);
            if (difference > result.maximum) {
                result.maximum = difference;
                result.maximum_x = x;
                result.maximum_y = y;
            }
            squares += difference * difference;
            peak = std::max(peak, expected);
            over += difference > threshold_absolute + threshold_relative * std::abs(expected) ? 1U : 0U;
        }
    const auto pixels = static_cast<double>(tested.size());
    result.rmse = std::sqrt(squares / pixels);
    result.psnr_db = psnr(peak, result.rmse);
    result.identical = result.maximum == 0.0;
    result.percent_over = 100.0 * static_cast<double>(over) / pixels;
    return result;
}

} // namespace fernlicht
