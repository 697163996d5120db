#include "metrics/aliasing/contrast_sensitivity.h"
#include "metrics/aliasing/spatial_aliasing.h"
#include "tests/metrics/aliasing/analytic_pictures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <oneapi/tbb/global_control.h>
#include <random>

namespace fernlicht {
namespace {

/// cos(pi a r^2): its frequency along x is a x, up to 0.8 cycles per pixel at the edges of 128 x 128 pixels.
double zone_plate(double x, double y) {
    constexpr double a = 0.8 / 64.0;
    return 1.0 + 0.5 * std::cos(pi * a * ((x - 64.0) * (x - 64.0) + (y - 64.0) * (y - 64.0)));
}

TEST(SpatialAliasing, AZonePlateFoldsBackWhatLiesBeyondTheLimit) {
    const BandSplit split = split_bands(drawn(128, 128, k, zone_plate), k);
    const SpatialAliasing found = measure_spatial_aliasing(drawn(128, 128, 1, zone_plate), split, ppd);
    // A cosine of amplitude 0.5 has a mean square of 0.125; beyond 0.5 cycles per pixel along x or y it folds back whole.
    const double expected = std::sqrt(0.125 * (1.0 - (0.5 / 0.8) * (0.5 / 0.8)));
    EXPECT_NEAR(found.aliasing.rms / expected, 1.0, 0.05);
    // Near the limit itself, f and 1 - f are nearly one frequency, and some of what folds back passes for the scene.
    EXPECT_GT(found.folded.rms, 0.9 * found.aliasing.rms);
    EXPECT_LT(found.lost.rms, 0.25 * expected);
}

class SlantedEdge : public ::testing::TestWithParam<double> {};

TEST_P(SlantedEdge, FoldsBackItsClosedForm) {
    const double angle = GetParam() * pi / 180.0, nx = std::cos(angle), ny = std::sin(angle);
    const auto edge = [&](double x, double y) { return (x - 64.0) * nx + (y - 64.0) * ny > 0.0 ? 1.5 : 0.5; };
    const BandSplit split = split_bands(drawn(128, 128, k, edge), k);
    const SpatialAliasing found = measure_spatial_aliasing(drawn(128, 128, 1, edge), split, ppd);
    // A step of height 1 has the spectrum 1 / (2 pi i t) along its normal n; what is beyond the limit, t max(|nx|, |ny|) > 1/2, has an
    // energy of 2 integral 1 / (4 pi^2 t^2) dt = max(|nx|, |ny|) / pi^2 per pixel of the edge's length, 128 / max(|nx|, |ny|).
    const double expected = std::sqrt(128.0 / (pi * pi) / (128.0 * 128.0));
    EXPECT_NEAR(found.aliasing.rms / expected, 1.0, 0.05);
}
INSTANTIATE_TEST_SUITE_P(Degrees, SlantedEdge, ::testing::Values(5.0, 17.0, 38.0, 73.0));

/// Noise of every frequency of the reference, the same each time, and a step across it.
Image<float> busy_reference(int width_px, int height_px) {
    std::mt19937 generator(7);
    Image<float> picture(width_px * k, height_px * k);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            picture.at(x, y) = 1.0F + static_cast<float>(generator() % 1000) / 1000.0F + (x + y / 5 > picture.width() / 2 ? 2.0F : 0.0F);
    return picture;
}

int mirrored(int i, int n) { return i < 0 ? -1 - i : i >= n ? 2 * n - 1 - i : i; }

Image<float> blurred_and_sampled(const Image<float>& fine, double sigma_x_px, double sigma_y_px) {
    const auto kernel = [](double sigma_px) {
        std::vector<double> weights;
        double sum = 0.0;
        for (int i = -40; i < 40; ++i) {
            weights.push_back(std::exp(-0.5 * std::pow((i + 0.5) / k / sigma_px, 2)));
            sum += weights.back();
        }
        for (double& w : weights)
            w /= sum;
        return weights;
    };
    const std::vector<double> wx = kernel(sigma_x_px), wy = kernel(sigma_y_px);
    Image<double> rows(fine.width() / k, fine.height());
    for (int y = 0; y < rows.height(); ++y)
        for (int x = 0; x < rows.width(); ++x)
            for (int i = -40; i < 40; ++i)
                rows.at(x, y) +=
                    wx[static_cast<std::size_t>(i + 40)] * static_cast<double>(fine.at(mirrored(x * k + k / 2 + i, fine.width()), y));
    Image<float> out(rows.width(), rows.height() / k);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x) {
            double sum = 0.0;
            for (int i = -40; i < 40; ++i)
                sum += wy[static_cast<std::size_t>(i + 40)] * rows.at(x, mirrored(y * k + k / 2 + i, rows.height()));
            out.at(x, y) = static_cast<float>(sum);
        }
    return out;
}

TEST(SpatialAliasing, PureBlurReadsNothing) {
    const Image<float> reference = busy_reference(96, 96);
    const BandSplit split = split_bands(reference, k);
    Image<float> sampled(96, 96);
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 96; ++x)
            sampled.at(x, y) = reference.at(x * k + k / 2, y * k + k / 2);
    const double aliased = measure_spatial_aliasing(sampled, split, ppd).aliasing.rms;
    for (const auto& [sx, sy] : {std::pair(0.6, 0.6), std::pair(1.0, 1.0), std::pair(0.7, 1.4)}) {
        const SpatialAliasing found = measure_spatial_aliasing(blurred_and_sampled(reference, sx, sy), split, ppd);
        // The ridge leaves 0.3 % of the energy at most; sigma = 0.6 lets 3 % of the amplitude just above the limit through.
        EXPECT_LT(found.aliasing.rms, 0.02 * aliased);
        EXPECT_GT(found.lost.rms, 0.02);
        EXPECT_LT(found.lost.rms, 0.1);
    }
}

TEST(SpatialAliasing, AGratingThatIsNotThereReadsItsContrastInTimesItsThreshold) {
    const BandSplit flat = split_bands(Image<float>(96 * k, 96 * k, 2.0F), k);
    constexpr double modulation = 0.03, f = 3.0 / 16.0;
    const SpatialAliasing found = measure_spatial_aliasing(
        drawn(96, 96, 1, [](double x, double) { return 2.0 * (1.0 + modulation * std::cos(2.0 * pi * f * x)); }), flat, ppd);
    // 1 %: the window spreads the grating over bins of slightly different sensitivity.
    EXPECT_NEAR(found.aliasing.rms, 2.0 * modulation / std::sqrt(2.0), 0.01 * 2.0 * modulation);
    EXPECT_NEAR(found.aliasing.contrast_percent, 100.0 * modulation / std::sqrt(2.0), 0.03);
    EXPECT_NEAR(found.aliasing.visible / (modulation * still_contrast_sensitivity(f * ppd, 2.0)), 1.0, 0.02);
    EXPECT_GT(found.bands[1].aliasing.rms, 0.98 * found.aliasing.rms); // 1/8 to 1/4
    EXPECT_LT(found.folded.rms, 1e-6);                                 // the reference has nothing above the limit
    EXPECT_LT(found.lost.rms, 1e-6);
}

TEST(SpatialAliasing, StepsOfEightBitsAreNoFoldedContent) {
    const auto hill = [](double x, double y) { return 0.5 + 0.02 * std::sin(x / 30.0) + 0.02 * std::cos(y / 25.0 + x / 70.0); };
    const BandSplit split = split_bands(drawn(96, 96, k, hill), k);
    const auto stepped = [&](double x, double y) { return std::round(255.0 * hill(x, y)) / 255.0; };
    const SpatialAliasing even = measure_spatial_aliasing(drawn(96, 96, 1, hill), split, ppd);
    const SpatialAliasing steps = measure_spatial_aliasing(drawn(96, 96, 1, stepped), split, ppd);
    EXPECT_LT(even.aliasing.rms, 2e-5); // the low pass rings at the edges, where the mirrored hill has a crease
    // Rounding to steps of 1/255 strays by 1 / (255 sqrt 12) = 0.0011 at most; some of it is slower than 1/16 cycle per pixel.
    EXPECT_GT(steps.aliasing.rms, 0.0003);
    EXPECT_LT(steps.aliasing.rms, 0.00115);
    EXPECT_LT(steps.folded.rms, 0.2 * steps.aliasing.rms);
}

TEST(SpatialAliasing, BrightnessIsNoAliasing) {
    const BandSplit split = split_bands(drawn(96, 96, k, zone_plate), k);
    const auto brighter = [](double x, double y) { return 3.0 * zone_plate(x, y); };
    const SpatialAliasing once = measure_spatial_aliasing(drawn(96, 96, 1, zone_plate), split, ppd);
    const SpatialAliasing thrice = measure_spatial_aliasing(drawn(96, 96, 1, brighter), split, ppd);
    EXPECT_NEAR(thrice.aliasing.contrast_percent / once.aliasing.contrast_percent, 1.0, 1e-4); // rounding to float
}

TEST(SpatialAliasing, ABrightSpotInTheDarkHasFullContrastAndNoMore) {
    // Ten pixels away and more, all is black; the spot covers one sample of the reference, and by chance the pixel's centre.
    Image<float> fine(64 * k, 64 * k, 0.0F), tested(64, 64, 0.0F);
    fine.at(32 * k + k / 2, 32 * k + k / 2) = tested.at(32, 32) = 300.0F;
    const SpatialAliasing found = measure_spatial_aliasing(tested, split_bands(fine, k), ppd);
    EXPECT_GT(found.level_picture.at(32, 32), 300.0 / 40.0); // 1 / 32 of it where a block has it in the middle
    EXPECT_EQ(found.level_picture.at(2, 2), least_seen_cdm2);
    EXPECT_LT(found.aliasing.contrast_percent, 100.0);
    EXPECT_GT(found.aliasing.contrast_percent, 20.0);
}

TEST(SpatialAliasing, WhereAPictureIsBlackByMistakeContrastIsFullAndNoMore) {
    const auto ramp = [](double x, double) { return 0.02 + 0.01 * x; };
    const auto cut = [&](double x, double y) { return x < 40.25 ? 0.0 : ramp(x, y); };
    const SpatialAliasing found = measure_spatial_aliasing(drawn(96, 96, 1, cut), split_bands(drawn(96, 96, k, ramp), k), ppd);
    EXPECT_GT(found.aliasing.contrast_percent, 1.0);
    EXPECT_LT(found.aliasing.contrast_percent, 100.0);
    EXPECT_LT(found.rest.contrast_percent, 100.0);
    EXPECT_GT(found.level_picture.at(20, 48), 0.1); // of what should be there
}

TEST(SpatialAliasing, ThreadsChangeNoBit) {
    const Image<float> reference = busy_reference(64, 64), tested(64, 64, 1.0F);
    std::vector<SpatialAliasing> found;
    for (const std::size_t threads : {1U, 2U}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        found.push_back(measure_spatial_aliasing(blurred_and_sampled(reference, 0.4, 0.5), split_bands(reference, k), ppd));
    }
    EXPECT_EQ(found[0].aliasing.visible, found[1].aliasing.visible);
    EXPECT_EQ(found[0].aliasing_picture, found[1].aliasing_picture);
    EXPECT_EQ(found[0].folded_picture, found[1].folded_picture);
}

TEST(SpatialAliasing, OfAStepItsPartFoldedBackIsUnderstatedByWhatTheReferenceDoesNotKnow) {
    const double angle = 23.0 * pi / 180.0;
    const auto step = [nx = std::cos(angle), ny = std::sin(angle)](double x, double y) {
        return 1.0 + ((x - 64.0) * nx + (y - 64.0) * ny > 0.0 ? 0.5 : 0.0);
    };
    double share_before = 0.0, whole_before = 0.0;
    for (const auto& [fine, least] : {std::pair(4, 0.74), std::pair(8, 0.83), std::pair(16, 0.91)}) { // docs/aliasing.md tells these
        const SpatialAliasing found =
            measure_spatial_aliasing(drawn(128, 128, 1, step), split_bands(drawn(128, 128, fine, step), fine), 20.0);
        const double share = found.folded.rms / found.aliasing.rms;
        EXPECT_GT(share, least) << fine;
        EXPECT_GT(share, share_before) << fine;
        EXPECT_LT(share, 1.0) << fine;
        if (share_before > 0.0) {
            EXPECT_NEAR(found.aliasing.rms / whole_before, 1.0, 0.01) << fine; // the whole does not suffer
        }
        share_before = share;
        whole_before = found.aliasing.rms;
    }
}

TEST(SpatialAliasing, RefusesWhatDoesNotFit) {
    const BandSplit split = split_bands(Image<float>(32 * k, 32 * k, 1.0F), k);
    EXPECT_THROW(measure_spatial_aliasing(Image<float>(33, 32, 1.0F), split, ppd), std::invalid_argument);
    EXPECT_THROW(measure_spatial_aliasing(Image<float>(32, 32, 1.0F), split, 0.0), std::invalid_argument);
    EXPECT_THROW(measure_spatial_aliasing(Image<float>(32, 32, std::nanf("")), split, ppd), std::invalid_argument);
    EXPECT_THROW(split_bands(Image<float>(33, 32, 1.0F), 4), std::invalid_argument);
    EXPECT_THROW(split_bands(Image<float>(64, 64, 1.0F), 2), std::invalid_argument);
    EXPECT_THROW(split_bands(Image<float>(64, 64, std::nanf("")), 4), std::invalid_argument);
}

TEST(BandSplit, KeepsWhatADisplayCanShowAndFoldsTheRest) {
    const auto grating = [](double f) { return [f](double x, double y) { return 1.0 + std::cos(2.0 * pi * f * x) * (1.0 + 0.0 * y); }; };
    // At 0.4 cycles per pixel the low pass lets all through, at 0.65 nothing.
    const BandSplit below = split_bands(drawn(200, 32, k, grating(0.4)), k), above = split_bands(drawn(200, 32, k, grating(0.65)), k);
    EXPECT_NEAR(below.ideal.at(100, 16), grating(0.4)(100.5, 0.0), 0.002);
    EXPECT_NEAR(above.ideal.at(100, 16), 1.0, 0.002);
    // Folded: the mean of the samples to both sides, 1/16 pixel off.
    EXPECT_NEAR(above.folded.at(100, 16), std::cos(2.0 * pi * 0.65 * 100.5) * std::cos(2.0 * pi * 0.65 / 16.0), 0.002);
}

} // namespace
} // namespace fernlicht
