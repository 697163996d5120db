#include "metrics/images/display_difference.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace fernlicht {
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
    if (tested.width() != reference.width() || tested.height() != reference.height())
        throw std::invalid_argument(fmt::format("pictures of {}x{} and {}x{} cannot be compared", tested.width(), tested.height(),
                                                reference.width(), reference.height()));
    if (tested.empty())
        throw std::invalid_argument("empty pictures cannot be compared");
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

} // namespace fernlicht
