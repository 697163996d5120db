#include "metrics/images/flip.h"

#include "metrics/images/flip_tile.h"
#include "metrics/images/image_difference.h"
#include "metrics/statistics/statistics.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace fernlicht {
namespace {

template <class Picture> void check(const Picture& tested, const Picture& reference, double pixels_per_degree) {
    check_comparable(tested, reference);
    if (!has_flip_at(pixels_per_degree))
        throw std::invalid_argument(
            fmt::format("{} pixels per degree are not from {} to {}", pixels_per_degree, min_pixels_per_degree, max_pixels_per_degree));
}

/// Calls `work(tile, memory)` for all tiles of a picture, several at once.
template <class Work> void for_tiles(int width, int height, const Work& work) {
    struct Scratch {
        flip::TileMemory memory;
        std::vector<float> errors = std::vector<float>(static_cast<std::size_t>(flip::tile_px) * flip::tile_px);
    };
    const int across = (width + flip::tile_px - 1) / flip::tile_px, down = (height + flip::tile_px - 1) / flip::tile_px;
    tbb::enumerable_thread_specific<Scratch> scratch;
    tbb::parallel_for(0, across * down, [&](int number) {
        const int x = number % across * flip::tile_px, y = number / across * flip::tile_px;
        Scratch& mine = scratch.local();
        work(flip::Tile{x, y, std::min(flip::tile_px, width - x), std::min(flip::tile_px, height - y)}, mine.memory, mine.errors.data());
    });
}

/// `shown(pixel)`: linear RGB, 0..1.
template <class Pixel, class Shown> flip::Rows rows_of(const Image<Pixel>& picture, const Shown& shown) {
    return [&picture, shown](int y, int x, int count, float* r, float* g, float* b) {
        const Pixel* pixel = &picture.at(x, y);
        for (int i = 0; i < count; ++i) {
            const glm::vec3 colour = shown(pixel[i]);
            r[i] = colour.x;
            g[i] = colour.y;
            b[i] = colour.z;
        }
    };
}

/// (a x^2 + b x) / (c x^2 + d x + e): Narkowicz's fit to the ACES curve, with the 0.6 of its exposure in x.
namespace aces {
constexpr double a = 0.6 * 0.6 * 2.51, b = 0.6 * 0.03, c = 0.6 * 0.6 * 2.43, d = 0.6 * 0.59, e = 0.14;

float shown(float x) {
    // Beyond 100 the quotient is 1 after clamping; x squared must stay finite.
    const float v = x < 100.0F ? x : 100.0F;
    const float y = v * (static_cast<float>(a) * v + static_cast<float>(b)) /
                    (v * (static_cast<float>(c) * v + static_cast<float>(d)) + static_cast<float>(e));
    return y < 1.0F ? y : 1.0F;
}

/// The x that is shown as 0.85, the bright end of the exposures (section 3.2 of the second paper).
double bright_end() {
    constexpr double t = 0.85;
    const double p = a - t * c, q = b - t * d, r = -t * e;
    return (-q + std::sqrt(q * q - 4.0 * p * r)) / (2.0 * p);
}
} // namespace aces

glm::vec3 exposed(const glm::vec3& light, float factor) {
    return {aces::shown(factor * light.x), aces::shown(factor * light.y), aces::shown(factor * light.z)};
}
glm::vec3 exposed(float light, float factor) { return glm::vec3(aces::shown(factor * light)); }

bool is_light(float v) { return v >= 0.0F && std::isfinite(v); }
bool is_light(const glm::vec3& v) { return is_light(v.x) && is_light(v.y) && is_light(v.z); }
float luminance_of(float v) { return v; }
float luminance_of(const glm::vec3& v) { return 0.2126F * v.x + 0.7152F * v.y + 0.0722F * v.z; }

template <class Pixel> void check_light(const Image<Pixel>& picture, const char* which) {
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (!is_light(picture.at(x, y)))
                throw std::invalid_argument(fmt::format("{} picture: pixel {}, {} is below 0 or not finite", which, x, y));
}

template <class Pixel> ExposureRange exposures_of(const Image<Pixel>& reference) {
    check_light(reference, "reference");
    std::vector<float> luminances;
    for (const Pixel& p : reference.pixels())
        luminances.push_back(luminance_of(p));
    const double largest = luminances.empty() ? 0.0 : static_cast<double>(*std::ranges::max_element(luminances));
    if (!(largest > 0.0))
        throw std::invalid_argument("a reference without light has no exposure");
    double middle = middle_of(luminances);
    if (!(middle > 0.0)) {
        std::erase_if(luminances, [](float v) { return !(v > 0.0F); });
        middle = middle_of(luminances);
    }
    ExposureRange range;
    range.start = std::log2(aces::bright_end() / largest);
    range.stop = std::min(std::log2(aces::bright_end() / middle), range.start + max_stops);
    range.count = std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
    return range;
}

using PairsOfRows = std::vector<std::pair<flip::Rows, flip::Rows>>;

/// The largest error of all pairs.
Image<float> worst_of(const PairsOfRows& pairs, int width, int height, double pixels_per_degree, flip::Colours colours) {
    const flip::Filters filters = flip::filters_for(pixels_per_degree);
    Image<float> map(width, height);
    for_tiles(width, height, [&](const flip::Tile& tile, flip::TileMemory& memory, float* errors) {
        for (const auto& [tested, reference] : pairs) {
            flip::flip_of_tile(tile, width, height, tested, reference, filters, colours, memory, errors);
            for (int row = 0; row < tile.height; ++row)
                for (int x = 0; x < tile.width; ++x) {
                    float& worst = map.at(tile.x + x, tile.y + row);
                    worst = std::max(worst, errors[row * flip::tile_px + x]);
                }
        }
    });
    return map;
}

template <class Pixel> Image<float> worst_of_exposures(const Image<Pixel>& tested, const Image<Pixel>& reference,
                                                       const ExposureRange& exposures, double pixels_per_degree, flip::Colours colours) {
    check(tested, reference, pixels_per_degree);
    check_light(tested, "tested");
    check_light(reference, "reference");
    PairsOfRows pairs;
    for (int i = 0; i < exposures.count; ++i) {
        const double stops = std::lerp(exposures.start, exposures.stop, static_cast<double>(i) / (exposures.count - 1));
        const auto factor = static_cast<float>(std::exp2(std::min(stops, 127.0))); // a float's largest: 0 times infinity is no light
        const auto shown = [factor](const Pixel& light) { return exposed(light, factor); };
        pairs.emplace_back(rows_of(tested, shown), rows_of(reference, shown));
    }
    return worst_of(pairs, tested.width(), tested.height(), pixels_per_degree, colours);
}

} // namespace

double pixels_per_degree_of_view(double vertical_fov_rad, int height_px) {
    return 0.5 * height_px / std::tan(0.5 * vertical_fov_rad) * radians(1.0);
}

Image<float> flip_ldr(const Image<Rgb8>& tested, const Image<Rgb8>& reference, double pixels_per_degree) {
    check(tested, reference, pixels_per_degree);
    const auto shown = [&table = srgb_table()](const Rgb8& p) { return glm::vec3(table[p.r], table[p.g], table[p.b]); };
    return worst_of({{rows_of(tested, shown), rows_of(reference, shown)}}, tested.width(), tested.height(), pixels_per_degree,
                    flip::Colours::all);
}

ExposureRange exposures_for(const Image<glm::vec3>& reference) { return exposures_of(reference); }
ExposureRange exposures_for(const Image<float>& reference) { return exposures_of(reference); }

Image<float> flip_hdr(const Image<glm::vec3>& tested, const Image<glm::vec3>& reference, const ExposureRange& exposures,
                      double pixels_per_degree) {
    return worst_of_exposures(tested, reference, exposures, pixels_per_degree, flip::Colours::all);
}

Image<float> flip_hdr(const Image<float>& tested, const Image<float>& reference, const ExposureRange& exposures, double pixels_per_degree) {
    return worst_of_exposures(tested, reference, exposures, pixels_per_degree, flip::Colours::grey);
}

FlipSummary summary_of_flip(const Image<float>& errors) {
    if (errors.empty())
        throw std::invalid_argument("an empty map has no mean");
    const std::vector<float> sorted = in_order(errors.pixels());
    double sum = 0.0;
    for (const float e : sorted)
        sum += static_cast<double>(e);
    FlipSummary s;
    s.mean = sum / static_cast<double>(sorted.size());
    s.minimum = static_cast<double>(sorted.front());
    s.maximum = static_cast<double>(sorted.back());
    s.first_quartile = by_nearest_rank(sorted, 0.25);
    s.median = by_nearest_rank(sorted, 0.5);
    s.third_quartile = by_nearest_rank(sorted, 0.75);
    const std::pair<double, double*> parts[] = {
        {0.25, &s.weighted_first_quartile}, {0.5, &s.weighted_median}, {0.75, &s.weighted_third_quartile}};
    double so_far = 0.0;
    std::size_t next = 0;
    for (const float e : sorted) {
        so_far += static_cast<double>(e);
        for (; next < 3 && so_far > parts[next].first * sum; ++next)
            *parts[next].second = static_cast<double>(e);
    }
    return s;
}

} // namespace fernlicht
