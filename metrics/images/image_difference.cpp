#include "metrics/images/image_difference.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

namespace fernlicht {
namespace {

void check_finite(const Image<float>& image, const char* which) {
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (!std::isfinite(image.at(x, y)))
                throw std::invalid_argument(fmt::format("{} picture: pixel {}, {} is {}", which, x, y, image.at(x, y)));
}

double psnr(double peak, double rmse) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (rmse == 0.0)
        return infinity;
    return peak > 0.0 ? 20.0 * std::log10(peak / rmse) : -infinity;
}

} // namespace

void check_comparable(int width, int height, int reference_width, int reference_height) {
    if (width != reference_width || height != reference_height)
        throw std::invalid_argument(
            fmt::format("pictures of {}x{} and {}x{} cannot be compared", width, height, reference_width, reference_height));
    if (width == 0 || height == 0)
        throw std::invalid_argument("empty pictures cannot be compared");
}

ImageDifference compare_images(const Image<float>& tested, const Image<float>& reference, double threshold_absolute,
                               double threshold_relative) {
    check_comparable(tested, reference);
    check_finite(tested, "tested");
    check_finite(reference, "reference");
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

namespace {

std::array<int, 3> levels(const Rgb8& p) { return {p.r, p.g, p.b}; }

template <class Value> Image<float> made_of(const Image<Rgb8>& picture, const Value& value) {
    Image<float> out(picture.width(), picture.height());
    for (std::size_t i = 0; i < out.size(); ++i)
        out.pixels()[i] = value(picture.pixels()[i]);
    return out;
}

} // namespace

DisplayDifference compare_displays(const Image<Rgb8>& tested, const Image<Rgb8>& reference) {
    check_comparable(tested, reference);
    DisplayDifference result;
    std::array<long long, 3> sums{};
    long long squares = 0, different = 0; // whole numbers: exact up to 4e13 pixels
    for (int y = 0; y < tested.height(); ++y)
        for (int x = 0; x < tested.width(); ++x) {
            const auto a = levels(tested.at(x, y)), b = levels(reference.at(x, y));
            bool differs = false;
            for (std::size_t c = 0; c < 3; ++c) {
                const int difference = a[c] - b[c];
                sums[c] += difference;
                squares += difference * difference;
                differs = differs || difference != 0;
                if (std::abs(difference) > result.maximum) {
                    result.maximum = std::abs(difference);
                    result.maximum_x = x;
                    result.maximum_y = y;
                }
            }
            different += differs ? 1 : 0;
        }
    const auto pixels = static_cast<double>(tested.size());
    result.rmse = std::sqrt(static_cast<double>(squares) / (3.0 * pixels));
    result.psnr_db = squares == 0 ? std::numeric_limits<double>::infinity() : 20.0 * std::log10(255.0 / result.rmse);
    result.percent_different = 100.0 * static_cast<double>(different) / pixels;
    for (std::size_t c = 0; c < 3; ++c)
        result.mean_signed[c] = static_cast<double>(sums[c]) / pixels;
    return result;
}

Image<float> luma_of(const Image<Rgb8>& picture) {
    return made_of(picture, [](const Rgb8& p) {
        return 0.2126F * static_cast<float>(p.r) + 0.7152F * static_cast<float>(p.g) + 0.0722F * static_cast<float>(p.b);
    });
}

Image<float> channel_of(const Image<Rgb8>& picture, int channel) {
    return made_of(picture, [channel](const Rgb8& p) { return static_cast<float>(levels(p)[static_cast<std::size_t>(channel)]); });
}

namespace {

void check(const NoisyPicture& a, const NoisyPicture& b) {
    for (const Image<float>* const image : {a.mean, a.variance, b.mean, b.variance, a.mixed, b.mixed}) {
        if (!image)
            continue;
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

bool is_mixed(const NoisyPicture& picture, int x, int y) { return picture.mixed && picture.mixed->at(x, y) != 0.0F; }

/// The pixel's variance, at least the mean of those around it.
double raised(const Image<float>& variance, int x, int y) {
    double sum = 0.0;
    int count = 0;
    for (int j = std::max(0, y - 1); j <= std::min(variance.height() - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(variance.width() - 1, x + 1); ++i, ++count)
            sum += static_cast<double>(variance.at(i, j));
    return std::max(static_cast<double>(variance.at(x, y)), sum / count);
}

/// What is known of a block, or of all of them.
struct Sums {
    double difference = 0.0, variance = 0.0;
    double estimated = 0.0, squares = 0.0; ///< of the variances as they were estimated
    std::size_t pixels = 0;
    int x = 0, y = 0; ///< a block's first pixel

    double z() const { return variance > 0.0 ? difference / std::sqrt(variance) : 0.0; }
    int freedom(int of_a_pixel) const {
        return squares > 0.0 ? std::max(of_a_pixel, static_cast<int>(of_a_pixel * estimated * estimated / squares)) : of_a_pixel;
    }
    void add(const Sums& other) {
        difference += other.difference;
        variance += other.variance;
        pixels += other.pixels;
    }
};

void judge(const std::vector<Sums>& blocks, int of_a_pixel, double false_alarm, NoisyDifference& out) {
    std::map<int, double> bounds; // many blocks have as many degrees of freedom as others
    Sums all;
    double worst = -1.0;
    for (const Sums& block : blocks) {
        all.add(block);
        const auto [at, is_new] = bounds.try_emplace(block.freedom(of_a_pixel), 0.0);
        if (is_new)
            at->second = student_bound(at->first, 0.5 * false_alarm, blocks.size());
        const double z = std::abs(block.z());
        out.blocks_over += z > at->second ? 1U : 0U;
        if (z / at->second > worst) {
            worst = z / at->second;
            out.worst_z = z;
            out.worst_bound = at->second;
            out.worst_x = block.x;
            out.worst_y = block.y;
        }
    }
    out.sum_z = all.z();
    out.sum_bound = normal_bound(0.5 * false_alarm, 1);
}

} // namespace

NoisyDifference compare_noisy(const NoisyPicture& a, const NoisyPicture& b, double threshold_absolute, double threshold_relative,
                              double false_alarm) {
    check(a, b);
    NoisyDifference out;
    out.identical = same(*a.mean, *b.mean) && same(*a.variance, *b.variance);
    double sum_a = 0.0, sum_b = 0.0;
    const auto add_pixel = [&](Sums& block, int x, int y) {
        const double mean_a = a.mean->at(x, y), mean_b = b.mean->at(x, y), difference = mean_a - mean_b;
        const double variance = raised(*a.variance, x, y) + raised(*b.variance, x, y);
        if (!(variance > 0.0)) {
            out.exact_over += std::abs(difference) > threshold_absolute + threshold_relative * std::abs(mean_b) ? 1U : 0U;
            return;
        }
        if (is_mixed(a, x, y) || is_mixed(b, x, y)) {
            ++out.left_out;
            return;
        }
        ++out.compared;
        ++block.pixels;
        sum_a += mean_a;
        sum_b += mean_b;
        block.difference += difference;
        block.variance += variance;
        for (const Image<float>* const image : {a.variance, b.variance}) {
            const double estimated = image->at(x, y);
            block.estimated += estimated;
            block.squares += estimated * estimated;
        }
    };
    std::vector<Sums> blocks;
    for (int y0 = 0; y0 < a.mean->height(); y0 += noise_block_px)
        for (int x0 = 0; x0 < a.mean->width(); x0 += noise_block_px) {
            Sums block{.x = x0, .y = y0};
            for (int y = y0; y < std::min(y0 + noise_block_px, a.mean->height()); ++y)
                for (int x = x0; x < std::min(x0 + noise_block_px, a.mean->width()); ++x)
                    add_pixel(block, x, y);
            if (block.pixels > 0)
                blocks.push_back(block);
        }
    out.blocks = blocks.size();
    out.sum_ratio = sum_b == 0.0 ? 1.0 : sum_a / sum_b;
    if (!blocks.empty())
        judge(blocks, std::min(a.freedom, b.freedom), false_alarm, out);
    return out;
}

Image<float> decades_of(const Image<float>& picture, double peak) {
    if (!(peak > 0.0 && std::isfinite(peak)))
        throw std::invalid_argument("decades of a picture need a peak above 0");
    const double darkest = peak * std::pow(10.0, -decades_below_peak);
    Image<float> out(picture.width(), picture.height());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto value = static_cast<double>(picture.pixels()[i]);
        out.pixels()[i] = value > darkest ? static_cast<float>(std::log10(value / peak) + decades_below_peak) : 0.0F;
    }
    return out;
}

double peak_of(const Image<float>& picture) {
    return picture.empty() ? 0.0 : std::max(0.0, static_cast<double>(*std::ranges::max_element(picture.pixels())));
}

double srgb_decoded(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

const std::array<float, 256>& srgb_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<float>(srgb_decoded(static_cast<double>(i) / 255.0));
        return values;
    }();
    return table;
}

} // namespace fernlicht
