// Pictures that are hard to compare: of one pixel, of next to no light, of the largest floats, all the same.
#include "metrics/images/ciede2000.h"
#include "metrics/images/flip.h"
#include "metrics/images/image_difference.h"
#include "metrics/images/ssim.h"
#include "runner/experiments/stability/stability_case.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr std::pair<int, int> sizes_px[] = {{1, 1}, {1, 40}, {40, 1}, {13, 7}};

bool within(const Image<float>& map, float least, float most) {
    return std::ranges::all_of(map.pixels(), [&](float v) { return v >= least && v <= most; }); // false for NaN
}

bool is_similarity(const Ssim& found) { return found.mean >= -1.0 - 1e-9 && found.mean <= 1.0 + 1e-9 && found.minimum >= -1.0 - 1e-9; }

/// Every pair of these levels, in stripes over black, so that the picture has edges too.
Found levels_of_light(StabilityBench&) {
    const float levels[] = {1e-45F, 1e-38F, 1e-6F, 1.0F, 1e6F, 1e30F, std::numeric_limits<float>::max()};
    Found worst;
    for (const auto& [width, height] : sizes_px)
        for (const float a : levels)
            for (const float b : levels) {
                Image<float> reference(width, height, 0.0F), tested(width, height, 0.0F);
                for (std::size_t i = 0; i < reference.size(); i += 2) {
                    reference.pixels()[i] = a;
                    tested.pixels()[i] = b;
                }
                const double peak = peak_of(reference);
                const ImageDifference difference = compare_images(tested, reference, 0.0, 0.0);
                const bool good = within(flip_hdr(tested, reference, exposures_for(reference)), 0.0F, 1.0F) &&
                                  is_similarity(ssim(decades_of(tested, peak), decades_of(reference, peak), decades_below_peak)) &&
                                  std::isfinite(difference.rmse) && std::isfinite(difference.psnr_db) == (a != b);
                worst.add(good ? 0.0 : 1.0, fmt::format("{} x {} pixels of {:g} against {:g}", width, height, b, a));
            }
    return worst;
}

/// The corners of the display's colours, and the same against the same, which must be 0 to the bit.
Found colours_of_displays(StabilityBench&) {
    Found worst;
    const auto corner = [](int i) {
        const auto level = [i](int bit) { return static_cast<std::uint8_t>((i >> bit & 1) * 255); };
        return Rgb8{level(0), level(1), level(2)};
    };
    for (const auto& [width, height] : sizes_px)
        for (int i = 0; i < 8; ++i)
            for (int k = 0; k < 8; ++k)
                for (const double density : {1.0, default_pixels_per_degree, 1000.0}) {
                    if (density > 100.0 && width * height > 40) // filters of 270 pixels on pictures of ten: once is enough
                        continue;
                    const Image<Rgb8> reference(width, height, corner(i)), tested(width, height, corner(k));
                    const Image<float> flip = flip_ldr(tested, reference, density), colours = ciede2000_map(tested, reference);
                    const bool good = i == k ? within(flip, 0.0F, 0.0F) && within(colours, 0.0F, 0.0F)
                                             : within(flip, 1e-3F, 1.0F) && within(colours, 1.0F, 200.0F);
                    worst.add(good ? 0.0 : 1.0,
                              fmt::format("{} x {} pixels of colours {} and {} at {} a degree", width, height, k, i, density));
                }
    return worst;
}

} // namespace

std::vector<StabilityCase> comparison_cases() {
    return {{"comparison", "light", "levels from 1e-45 to 3.4e38, pictures of one pixel, row or column", 0.0, "numbers out of their range",
             "sums are in doubles, exposures end at 2^127, decades at four below the peak", levels_of_light},
            {"comparison", "colours", "corners of the display's colours, 1 to 1000 pixels per degree, pictures smaller than the filters",
             0.0, "numbers out of their range", "filters see the edge go on and sum to 1; powers are taken of at least 1e-30",
             colours_of_displays}};
}

} // namespace fernlicht
