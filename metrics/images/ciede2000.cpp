
#include "metrics/images/image_difference.h"
#include "metrics/statistics/statistics.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vector>

namespace fernlicht {
namespace {

double degrees_of(double b, double a) {
    if (a == 0.0 && b == 0.0)
        return 0.0;
    const double h = degrees(std::atan2(b, a));
    return h < 0.0 ? h + 360.0 : h;
}

double cos_deg(double angle_deg) { return std::cos(radians(angle_deg)); }

double seventh_share(double chroma) {
    const double c7 = std::pow(chroma, 7.0);
    return std::sqrt(c7 / (c7 + 6103515625.0)); // 25^7
}

/// Difference and mean of two hues in degrees (the paper's equations 10 and 14): both go the short way round, unless a colour is grey.
struct Hues {
    double difference_deg = 0.0, mean_deg = 0.0;
};
Hues hues(double h1, double h2, bool grey) {
    if (grey)
        return {0.0, h1 + h2};
    const double d = h2 - h1, sum = h1 + h2;
    if (std::abs(d) <= 180.0)
        return {d, 0.5 * sum};
    return {d > 180.0 ? d - 360.0 : d + 360.0, sum < 360.0 ? 0.5 * (sum + 360.0) : 0.5 * (sum - 360.0)};
}

} // namespace

double ciede2000(const Lab& one, const Lab& other) {
    const double g = 0.5 * (1.0 - seventh_share(0.5 * (std::hypot(one.a, one.b) + std::hypot(other.a, other.b))));
    const double a1 = (1.0 + g) * one.a, a2 = (1.0 + g) * other.a;
    const double c1 = std::hypot(a1, one.b), c2 = std::hypot(a2, other.b);
    const Hues h = hues(degrees_of(one.b, a1), degrees_of(other.b, a2), c1 * c2 == 0.0);
    const double dl = other.l - one.l, dc = c2 - c1, dh = 2.0 * std::sqrt(c1 * c2) * std::sin(radians(0.5 * h.difference_deg));
    const double l = 0.5 * (one.l + other.l) - 50.0, c = 0.5 * (c1 + c2), m = h.mean_deg;
    const double t =
        1.0 - 0.17 * cos_deg(m - 30.0) + 0.24 * cos_deg(2.0 * m) + 0.32 * cos_deg(3.0 * m + 6.0) - 0.20 * cos_deg(4.0 * m - 63.0);
    const double sl = 1.0 + 0.015 * l * l / std::sqrt(20.0 + l * l), sc = 1.0 + 0.045 * c, sh = 1.0 + 0.015 * c * t;
    const double turn = 30.0 * std::exp(-std::pow((m - 275.0) / 25.0, 2.0));
    const double rt = -std::sin(radians(2.0 * turn)) * 2.0 * seventh_share(c);
    const double x = dl / sl, y = dc / sc, z = dh / sh;
    return std::sqrt(std::max(0.0, x * x + y * y + z * z + rt * y * z));
}

Lab lab_of(const Rgb8& colour) {
    // Tristimulus values over those of white: the rows of BT.709's matrix, each over its sum.
    static const std::array<double, 256> linear = [] {
        std::array<double, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = srgb_decoded(static_cast<double>(i) / 255.0);
        return values;
    }();
    const double r = linear[colour.r], g = linear[colour.g], b = linear[colour.b];
    const auto root = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : t * (841.0 / 108.0) + 4.0 / 29.0; };
    const double x = root((10135552.0 * r + 8788810.0 * g + 4435075.0 * b) / 23359437.0);
    const double y = root((2613072.0 * r + 8788810.0 * g + 887015.0 * b) / 12288897.0);
    const double z = root((1425312.0 * r + 8788810.0 * g + 70074185.0 * b) / 80288307.0);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

namespace {

/// What was computed of pairs of colours: pictures have far fewer of them than pixels.
class KnownPairs {
  public:
    float difference(const Rgb8& one, const Rgb8& other) {
        const auto code = [](const Rgb8& c) { return std::uint64_t{c.r} << 16 | std::uint64_t{c.g} << 8 | c.b; };
        const std::uint64_t pair = code(one) << 24 | code(other);
        Known& known = known_[(pair * 0x9E3779B97F4A7C15ULL) >> 52]; // Knuth's multiplicative hash
        if (known.pair != pair)
            known = {pair, static_cast<float>(ciede2000(lab_of(one), lab_of(other)))};
        return known.difference;
    }

  private:
    struct Known {
        std::uint64_t pair = 0; // black and black, which do not differ
        float difference = 0.0F;
    };
    std::vector<Known> known_ = std::vector<Known>(4096);
};

} // namespace

Image<float> ciede2000_map(const Image<Rgb8>& tested, const Image<Rgb8>& reference) {
    check_comparable(tested, reference);
    Image<float> map(tested.width(), tested.height());
    tbb::parallel_for(tbb::blocked_range<int>(0, map.height(), 32), [&](const tbb::blocked_range<int>& rows) {
        KnownPairs known;
        for (int y = rows.begin(); y < rows.end(); ++y)
            for (int x = 0; x < map.width(); ++x)
                if (tested.at(x, y) != reference.at(x, y))
                    map.at(x, y) = known.difference(tested.at(x, y), reference.at(x, y));
    });
    return map;
}

ColourDifference summary_of_colours(const Image<float>& differences) {
    if (differences.empty())
        throw std::invalid_argument("an empty map has no mean");
    ColourDifference result;
    double sum = 0.0;
    for (int y = 0; y < differences.height(); ++y)
        for (int x = 0; x < differences.width(); ++x) {
            const double difference = static_cast<double>(differences.at(x, y));
            sum += difference;
            if (difference > result.maximum) {
                result.maximum = difference;
                result.maximum_x = x;
                result.maximum_y = y;
            }
        }
    const std::vector<float> sorted = in_order(differences.pixels());
    result.mean = sum / static_cast<double>(sorted.size());
    result.median = by_nearest_rank(sorted, 0.5);
    result.p95 = by_nearest_rank(sorted, 0.95);
    return result;
}

} // namespace fernlicht
