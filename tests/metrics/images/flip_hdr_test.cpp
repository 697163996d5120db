#include "metrics/images/flip.h"

#include "tests/metrics/images/direct_flip.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace fernlicht {
namespace {

using tests::DirectFlip;

Image<glm::vec3> grey_scene(int width, int height, const std::vector<float>& values) {
    Image<glm::vec3> image(width, height);
    for (std::size_t i = 0; i < image.size(); ++i)
        image.pixels()[i] = glm::vec3(values[i % values.size()]);
    return image;
}

/// The tone mapper by its published coefficients, 0.6 times the exposure going in.
double aces(double x) {
    const double v = 0.6 * x;
    return std::clamp(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 0.0, 1.0);
}

/// Where it is 0.85, by halving.
double shown_as_085() {
    double low = 0.0, high = 10.0;
    for (int i = 0; i < 100; ++i)
        (aces(0.5 * (low + high)) < 0.85 ? low : high) = 0.5 * (low + high);
    return low;
}

// Largest 8, median 0.5: sixteen to one is four stops. Start shows 8 as 0.85, stop 0.5.
TEST(FlipHdr, ExposuresByHand) {
    const ExposureRange range = exposures_for(grey_scene(5, 1, {0.1F, 0.2F, 0.5F, 1.0F, 8.0F}));
    EXPECT_NEAR(aces(8.0 * std::exp2(range.start)), 0.85, 1e-9);
    EXPECT_NEAR(range.start, std::log2(shown_as_085() / 8.0), 1e-9);
    EXPECT_NEAR(range.stop - range.start, 4.0, 1e-6);
    EXPECT_EQ(range.count, 4);
}

// More than half is black, as in most night pictures: the median of the four lit pixels stands in. 32 to 4: three stops.
TEST(FlipHdr, BlackNightsAreExposedForWhatIsLit) {
    const ExposureRange range = exposures_for(grey_scene(10, 1, {0, 0, 0, 0, 0, 0, 1.0F, 2.0F, 4.0F, 32.0F}));
    EXPECT_NEAR(range.stop - range.start, 3.0, 1e-6);
    EXPECT_EQ(range.count, 3);
}

TEST(FlipHdr, ExtremesKeepTheRangeBounded) {
    const ExposureRange deep = exposures_for(grey_scene(3, 1, {1e-38F, 1e-38F, 1e30F}));
    EXPECT_DOUBLE_EQ(deep.stop - deep.start, most_stops);
    EXPECT_EQ(deep.count, static_cast<int>(most_stops));
    const ExposureRange flat = exposures_for(grey_scene(3, 1, {2.0F}));
    EXPECT_DOUBLE_EQ(flat.start, flat.stop);
    EXPECT_EQ(flat.count, 2);
    const auto bright = grey_scene(4, 4, {1e30F, 1.0F}), dark = grey_scene(4, 4, {1e-30F, 1.0F});
    for (const auto map = flip_hdr(bright, dark, exposures_for(dark)); const float e : map.pixels())
        EXPECT_TRUE(e >= 0.0F && e <= 1.0F) << e;
}

// All but dark: exposures of more than 2^127 are no floats.
TEST(FlipHdr, NextToNoLightIsStillCompared) {
    const auto faint = grey_scene(4, 4, {0.0F, 1e-40F, 1e-39F}), none = grey_scene(4, 4, {0.0F});
    const auto map = flip_hdr(none, faint, exposures_for(faint));
    for (const float e : map.pixels())
        EXPECT_TRUE(e >= 0.0F && e <= 1.0F) << e;
}

TEST(FlipHdr, TheSameIsZero) {
    const auto picture = grey_scene(30, 20, {0.0F, 0.01F, 3.0F, 200.0F, 1e4F});
    for (const auto map = flip_hdr(picture, picture, exposures_for(picture)); const float e : map.pixels())
        EXPECT_EQ(e, 0.0F);
}

// Every exposure as the paper writes it, in doubles; the worst of them. Floats as for one exposure (flip_test.cpp), whose largest is taken:
// 3e-4. Without colours no root of one channel is subtracted from another's: 116 times two roots good to 3e-7 is 1e-4 at most, as an error
// 0.0576 (1e-4)^0.7 = 9e-5, and its largest 1.5e-4.
TEST(FlipHdr, IsTheWorstOfAllExposures) {
    const int width = 32, height = 24;
    std::vector<float> lit, other;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double beam = 60.0 * std::exp(-0.01 * ((x - 16) * (x - 16) + 4.0 * (y - 14) * (y - 14))) + 0.02;
            lit.push_back(static_cast<float>(beam));
            other.push_back(static_cast<float>(y > 13 && x > 20 ? 0.5 * beam : beam));
        }
    const auto reference = grey_scene(width, height, lit), tested = grey_scene(width, height, other);
    const ExposureRange range = exposures_for(reference);
    ASSERT_GE(range.count, 3);
    const DirectFlip direct(width, height, default_pixels_per_degree);
    std::vector<double> worst(lit.size(), 0.0);
    for (int i = 0; i < range.count; ++i) {
        const double factor = std::exp2(range.start + (range.stop - range.start) * i / (range.count - 1));
        std::vector<std::array<double, 3>> a, b;
        for (std::size_t k = 0; k < lit.size(); ++k) {
            const double va = aces(factor * static_cast<double>(other[k])), vb = aces(factor * static_cast<double>(lit[k]));
            a.push_back({va, va, va});
            b.push_back({vb, vb, vb});
        }
        const auto errors = direct.errors(a, b);
        for (std::size_t k = 0; k < errors.size(); ++k)
            worst[k] = std::max(worst[k], errors[k]);
    }
    const auto map = flip_hdr(tested, reference, range);
    EXPECT_GT(*std::ranges::max_element(worst), 0.1);
    for (std::size_t k = 0; k < worst.size(); ++k)
        ASSERT_NEAR(static_cast<double>(map.pixels()[k]), worst[k], 3e-4) << k;
    Image<float> tested_grey(width, height), reference_grey(width, height);
    tested_grey.pixels() = other;
    reference_grey.pixels() = lit;
    const auto grey_map = flip_hdr(tested_grey, reference_grey, exposures_for(reference_grey));
    for (std::size_t k = 0; k < worst.size(); ++k)
        ASSERT_NEAR(static_cast<double>(grey_map.pixels()[k]), worst[k], 1.5e-4) << k;
}

TEST(FlipHdr, WrongInputIsRefused) {
    const auto light = grey_scene(2, 2, {1.0F}), none = grey_scene(2, 2, {0.0F}), negative = grey_scene(2, 2, {1.0F, -1.0F}),
               infinite = grey_scene(2, 2, {std::numeric_limits<float>::infinity()});
    EXPECT_THROW(exposures_for(none), std::invalid_argument);
    EXPECT_THROW(exposures_for(Image<float>{}), std::invalid_argument);
    EXPECT_THROW(exposures_for(negative), std::invalid_argument);
    EXPECT_THROW(flip_hdr(infinite, light, exposures_for(light)), std::invalid_argument);
    EXPECT_THROW(flip_hdr(grey_scene(2, 3, {1.0F}), light, exposures_for(light)), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
