#include "metrics/aliasing/jaggedness.h"
#include "metrics/aliasing/spatial_aliasing.h"
#include "metrics/aliasing/temporal_aliasing.h"
#include "tests/metrics/aliasing/analytic_pictures.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <oneapi/tbb/global_control.h>
#include <opencv2/core.hpp>
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
    EXPECT_EQ(found.level_picture.at(2, 2), min_seen_cdm2);
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
    for (const auto& [fine, least] :
         {std::pair(4, 0.74), std::pair(8, 0.83), std::pair(16, 0.91)}) { // docs/aliasing.md tells the first and the last
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

TEST(FourierTransform, IsThatOfOpenCVAndNamesItsFrequencies) {
    constexpr std::size_t side = 32;
    std::mt19937 generator(3);
    std::vector<std::complex<double>> block(side * side);
    cv::Mat_<cv::Vec2d> theirs(static_cast<int>(side), static_cast<int>(side));
    for (std::size_t i = 0; i < block.size(); ++i) {
        block[i] = {static_cast<double>(generator() % 2001) - 1000.0, static_cast<double>(generator() % 2001) - 1000.0};
        theirs(static_cast<int>(i / side), static_cast<int>(i % side)) = {block[i].real(), block[i].imag()};
    }
    cv::dft(theirs, theirs);
    fourier_transform(block, side);
    double largest = 0.0;
    for (std::size_t i = 0; i < block.size(); ++i) {
        const cv::Vec2d& expected = theirs(static_cast<int>(i / side), static_cast<int>(i % side));
        largest = std::max(largest, std::abs(block[i] - std::complex<double>(expected[0], expected[1])));
    }
    // Ten stages of rounding at values of up to 1000 * 1024 whose squares add to about 2.6e4^2.
    EXPECT_LT(largest, 1e-9);
    std::vector<std::complex<double>> three(3);
    EXPECT_THROW(fourier_transform(std::span(three)), std::invalid_argument);
    EXPECT_THROW(fourier_transform(three, 2), std::invalid_argument);
    EXPECT_EQ(bin_frequency(0, 32), 0.0);
    EXPECT_EQ(bin_frequency(15, 32), 15.0 / 32.0);
    EXPECT_EQ(bin_frequency(16, 32), -0.5);
    EXPECT_EQ(bin_frequency(31, 32), -1.0 / 32.0);
}

TEST(ContrastSensitivity, IsThatOfBartenAndOfKelly) {
    // The printed formulas, worked out apart from this program.
    EXPECT_NEAR(still_contrast_sensitivity(5.0, 100.0), 586.313020008566, 1e-9);
    EXPECT_NEAR(still_contrast_sensitivity(4.0, 0.01), 25.779198181579336, 1e-10);
    EXPECT_NEAR(still_contrast_sensitivity(4.75, 1.0), 148.1418777623553, 1e-9);
    // What every such measurement shows: a peak between 1 and 6 cycles per degree, less in the dark, next to nothing at 60.
    EXPECT_GT(still_contrast_sensitivity(4.0, 100.0), still_contrast_sensitivity(0.5, 100.0));
    EXPECT_GT(still_contrast_sensitivity(4.0, 100.0), still_contrast_sensitivity(10.0, 100.0));
    EXPECT_LT(still_contrast_sensitivity(4.0, 0.01), 0.1 * still_contrast_sensitivity(4.0, 100.0));
    EXPECT_LT(still_contrast_sensitivity(60.0, 100.0), 1.0);
    EXPECT_EQ(still_contrast_sensitivity(0.0, 100.0), 0.0);
    // Kelly at 3 degrees per second: the logarithm is 0, so 6.1 * 3 a^2 exp(-10 a / 45.9); a = 2 pi.
    EXPECT_NEAR(flicker_sensitivity(1.0, 3.0), 6.1 * 3.0 * 39.478417604 * std::exp(-62.83185307 / 45.9), 1e-6);
    EXPECT_LT(flicker_sensitivity(1.0, 60.0), 0.01 * flicker_sensitivity(1.0, 6.0));
    EXPECT_EQ(flicker_sensitivity(1.0, 0.0), 0.0);
    EXPECT_THROW(still_contrast_sensitivity(1.0, 0.0), std::invalid_argument);
    EXPECT_THROW(flicker_sensitivity(0.0, 1.0), std::invalid_argument);
}

/// A line through the middle of 128 x 128 pixels; `ramp_px` wide, 0: a step.
auto slanted(double degrees, double ramp_px, double shift_px = 0.0) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return [nx = std::cos(angle), ny = std::sin(angle), ramp_px, shift_px](double x, double y) {
        const double across = (x - 64.0) * nx + (y - 64.0) * ny - shift_px;
        return ramp_px > 0.0 ? std::clamp(0.5 + across / ramp_px, 0.0, 1.0) : across > 0.0 ? 1.0 : 0.0;
    };
}

TEST(Jaggedness, AStepRoundedToPixelsStraysByItsClosedForm) {
    for (const double degrees : {4.0, 11.0, 86.0, 101.0, 23.0, 37.0}) {
        const auto edge = slanted(degrees, 0.0);
        const auto found = measure_jaggedness(drawn(128, 128, 1, edge), drawn(128, 128, k, edge), k, 0.5);
        ASSERT_TRUE(found);
        // Rounding to whole pixels along the axis that the edge stands across is uniform over one pixel, and so is rounding to samples of
        // the reference over 1/8: sqrt((1 + 1/64) / 12) of them, less what a mean over some 33 points takes (3 % of the square).
        const double cosine =
            std::max(std::abs(std::cos(degrees * std::numbers::pi / 180.0)), std::abs(std::sin(degrees * std::numbers::pi / 180.0)));
        EXPECT_NEAR(found->rms_px / (cosine / std::sqrt(12.0)), 1.0, 0.05);
        EXPECT_NEAR(static_cast<double>(found->points), 128.0, 2.0);
    }
}

TEST(Jaggedness, AnEvenRampIsSmoothAndAMovedOneToo) {
    const Image<float> reference = drawn(128, 128, k, slanted(11.0, 8.0));
    for (const double shift_px : {0.0, 0.7}) { // where the whole line lies is no jaggedness
        const auto found = measure_jaggedness(drawn(128, 128, 1, slanted(11.0, 8.0, shift_px)), reference, k, 0.5);
        ASSERT_TRUE(found);
        // Between samples, a ramp is linear: what is left are half a sample's offset beside the pixel's middle, 1/16 px tan 11 degrees =
        // 0.012.
        EXPECT_LT(found->rms_px, 0.005);
    }
}

TEST(Jaggedness, NothingToMeasureIsSaid) {
    const Image<float> flat(64, 64, 1.0F), fine(512, 512, 1.0F);
    EXPECT_FALSE(measure_jaggedness(flat, fine, k, 0.5));
    // A line that the reference has not within two pixels has no partner.
    EXPECT_FALSE(measure_jaggedness(drawn(128, 128, 1, slanted(11.0, 0.0, 10.0)), drawn(128, 128, k, slanted(11.0, 0.0)), k, 0.5));
    EXPECT_THROW(measure_jaggedness(flat, flat, k, 0.5), std::invalid_argument);
    EXPECT_THROW(measure_jaggedness(flat, fine, k, std::nan("")), std::invalid_argument);
}

constexpr int side = 160;

/// A mark 12 pixels wide through the middle, its borders `degrees` from upright; ten times as bright as the road, under light that falls
/// off to the right by a third.
struct MarkedRoad {
    double nx, ny;
    explicit MarkedRoad(double degrees)
        : nx(std::cos(degrees * std::numbers::pi / 180.0)), ny(std::sin(degrees * std::numbers::pi / 180.0)) {}
    bool mark(double x, double y) const { return std::abs((x - 0.5 * side) * nx + (y - 0.5 * side) * ny) < 6.0; }
    double luminance(double x, double y) const { return (mark(x, y) ? 1.0 : 0.1) * (1.0 - x / (3.0 * side)); }
    EdgeReference reference() const {
        EdgeReference edges{k, drawn(side, side, k, [this](double x, double y) { return luminance(x, y); }), {}, {}, {}};
        edges.ground = Image<Ground>(side * k, side * k, Ground::road);
        for (int y = 0; y < side * k; ++y)
            for (int x = 0; x < side * k; ++x)
                if (mark((x + 0.5) / k, (y + 0.5) / k))
                    edges.ground.at(x, y) = Ground::mark;
        return edges;
    }
    /// The mean of n x n samples a pixel.
    Image<float> picture(int n) const {
        const Image<float> fine = drawn(side, side, n, [this](double x, double y) { return luminance(x, y); });
        Image<float> out(side, side);
        for (int y = 0; y < side * n; ++y)
            for (int x = 0; x < side * n; ++x)
                out.at(x / n, y / n) += fine.at(x, y) / static_cast<float>(n * n);
        return out;
    }
};

TEST(NamedEdges, StairsOfAMarkReadTheirClosedForm) {
    for (const double degrees : {5.0, 13.0, 22.0}) {
        const MarkedRoad road(degrees);
        const auto one = mark_jaggedness(road.picture(1), road.reference()), four = mark_jaggedness(road.picture(2), road.reference());
        ASSERT_TRUE(one && four);
        // Rounding to whole pixels, as for any step (jaggedness.h); 10 % for the light that falls off and for the middle between both
        // brightnesses, which is not where a pixel's step is.
        EXPECT_NEAR(one->found.rms_px / (road.nx / std::sqrt(12.0)), 1.0, 0.1) << degrees;
        EXPECT_LT(four->found.rms_px, 0.75 * one->found.rms_px);
        EXPECT_LT(one->floor_px, 0.08); // straight lines between pixels' centres are none across a pixel's area
        EXPECT_GT(one->found.standard_error_px, 0.0);
        EXPECT_LT(one->found.standard_error_px, 0.05);
    }
}

TEST(NamedEdges, TheEndsOfAMarkAndWhatIsNoRoadAreLeftOut) {
    const MarkedRoad road(13.0);
    EdgeReference whole = road.reference(), half = whole;
    const auto all = mark_jaggedness(road.picture(1), whole);
    for (int y = 0; y < side * k; ++y)
        for (int x = 0; x < side * k; ++x)
            if (y < side * k / 2)
                half.ground.at(x, y) = Ground::other;
    const auto rest = mark_jaggedness(road.picture(1), half);
    ASSERT_TRUE(all && rest);
    EXPECT_NEAR(static_cast<double>(rest->found.points), 0.5 * static_cast<double>(all->found.points), 8.0);
    EXPECT_FALSE(mark_jaggedness(Image<float>(side, side, 0.5F), {k, Image<float>(side * k, side * k, 0.5F), {}, {}, whole.ground}));
}

TEST(NamedEdges, TheCutOffIsALineOfLightOnTheRoadAndNoShadowOrSilhouette) {
    const auto beam = [](double x, double y) { return std::exp(0.1 * (y - 80.0) + 0.02 * (x - 80.0)); };
    EdgeReference reference{k, {}, drawn(side, side, k, beam), drawn(side, side, k, beam), Image<Ground>(side * k, side * k, Ground::road)};
    // A beam that is rounded up to whole texels of 5 pixels: each stair is a straight line's, level within the texel.
    const auto texels = [&](double x, double y) { return beam(5.0 * std::floor(x / 5.0) + 2.5, y); };
    const auto smooth = cut_off_jaggedness(drawn(side, side, 1, beam), reference, 1.0);
    const auto stairs = cut_off_jaggedness(drawn(side, side, 1, texels), reference, 1.0);
    ASSERT_TRUE(smooth && stairs);
    EXPECT_LT(smooth->found.rms_px, 0.02);
    EXPECT_LT(smooth->floor_px, 0.02);
    // The line is at y = 80 - 0.2 (x - 80) + const; a stair of 5 pixels strays by +-2, -+1, 0 pixels times 0.2, across it.
    EXPECT_NEAR(stairs->found.rms_px, 0.2 * std::sqrt(2.0) * std::cos(std::atan(0.2)), 0.02);
    EXPECT_EQ(smooth->found.points, 160U);
    for (int y = 0; y < side * k; ++y) // a shadow over the right half
        for (int x = side * k / 2; x < side * k; ++x)
            reference.illuminance_lx.at(x, y) *= 0.5F;
    const auto left = cut_off_jaggedness(drawn(side, side, 1, beam), reference, 1.0);
    ASSERT_TRUE(left);
    EXPECT_NEAR(static_cast<double>(left->found.points), 78.0, 2.0);
    EXPECT_FALSE(cut_off_jaggedness(drawn(side, side, 1, beam), reference, 1e6));
    EXPECT_THROW(cut_off_jaggedness(Image<float>(8, 8, 1.0F), reference, 1.0), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
