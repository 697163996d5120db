#include "runner/write/thumbnail.h"

#include "runner/write/plots/png.h"
#include "scenarios/values/jpeg_file.h"
#include "scenarios/values/png_file.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fernlicht {
namespace {

/// By measurement: night pictures of 640 pixels take 23 kB then, a sixth of their PNG.
constexpr int jpeg_quality = 85;

double light_of(std::uint8_t code) {
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

std::uint8_t code_of(double light) {
    const double v = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(v, 0.0, 1.0)));
}

/// How much of each pixel falls into one of a smaller picture, along one axis.
struct Share {
    int from = 0;
    std::vector<double> weights;
};
std::vector<Share> shares_of(int from, int to) {
    std::vector<Share> shares;
    for (int i = 0; i < to; ++i) {
        const double low = static_cast<double>(i) * from / to, high = static_cast<double>(i + 1) * from / to;
        Share share{static_cast<int>(low), {}};
        for (int k = share.from; k < from && k < high; ++k)
            share.weights.push_back((std::min(high, k + 1.0) - std::max(low, static_cast<double>(k))) / (high - low));
        shares.push_back(std::move(share));
    }
    return shares;
}

JpegPicture shrunk(const PngPicture& picture, int width) {
    static const std::array<double, 256> light = [] {
        std::array<double, 256> all{};
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = light_of(static_cast<std::uint8_t>(i));
        return all;
    }();
    const PngHead& head = picture.head;
    const int height = std::max(1, static_cast<int>(std::lround(static_cast<double>(head.height) * width / head.width)));
    const std::vector<Share> columns = shares_of(head.width, width), rows = shares_of(head.height, height);
    JpegPicture small{width, height, 3, {}};
    small.bytes.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    std::vector<double> across(static_cast<std::size_t>(head.width) * 3); // the rows of one, added
    for (const Share& row : rows) {
        std::ranges::fill(across, 0.0);
        for (std::size_t k = 0; k < row.weights.size(); ++k) {
            const std::uint8_t* const from = picture.bytes.data() + (static_cast<std::size_t>(row.from) + k) * across.size();
            for (std::size_t i = 0; i < across.size(); ++i)
                across[i] += row.weights[k] * light[from[i]];
        }
        for (const Share& column : columns)
            for (std::size_t c = 0; c < 3; ++c) {
                double sum = 0.0;
                for (std::size_t k = 0; k < column.weights.size(); ++k)
                    sum += column.weights[k] * across[(static_cast<std::size_t>(column.from) + k) * 3 + c];
                small.bytes.push_back(code_of(sum));
            }
    }
    return small;
}

} // namespace

std::string embedded_picture(const std::string& png, int most_px) {
    const PngHead head = decode_png_head(png);
    if (head.channels != 3 || head.bits != 8 || !head.icc.empty())
        return "data:image/png;base64," + plots::base64(png);
    const PngPicture picture = decode_png(png, [](const PngHead&) {});
    return "data:image/jpeg;base64," +
           plots::base64(encode_jpeg(
               head.width > most_px ? shrunk(picture, most_px) : JpegPicture{head.width, head.height, 3, picture.bytes}, jpeg_quality));
}

std::string embedded_codes(const std::vector<const Image<std::uint8_t>*>& codes) {
    Image<plots::Colour> packed(codes.front()->width(), codes.front()->height());
    for (int y = 0; y < packed.height(); ++y)
        for (int x = 0; x < packed.width(); ++x) {
            const auto code = [&](std::size_t i) { return i < codes.size() ? codes[i]->at(x, y) : std::uint8_t{0}; };
            packed.at(x, y) = {code(0), code(1), code(2)};
        }
    return plots::base64(plots::png_of_pixels(packed, 9));
}

} // namespace fernlicht
