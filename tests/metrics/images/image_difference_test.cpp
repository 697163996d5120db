#include "metrics/images/image_difference.h"
#include "metrics/images/pixel_errors.h"
#include "tests/metrics/images/made_pictures.h"
#include "tests/trial.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <opencv2/core.hpp>
#include <random>
#include <stdexcept>
#include <tuple>

namespace fernlicht {
namespace {

using testing::ElementsAre, testing::HasSubstr;
using tests::picture;

// Differences 0, -3, 4, 0 on a reference with peak 100: mse 25/4, rmse 2.5, psnr 20 log10(40) = 32.0412 dB.
TEST(ImageDifference, FiguresByHandAndThresholdsThatMayBeMet) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto reference = picture(2, {1.0F, 10.0F, 20.0F, 100.0F}), tested = picture(2, {1.0F, 7.0F, 24.0F, 100.0F});
    const ImageDifference difference = compare_images(tested, reference, 0.0, 0.0);
    EXPECT_FALSE(difference.identical);
    EXPECT_DOUBLE_EQ(difference.maximum, 4.0);
    EXPECT_EQ(std::tuple(difference.maximum_x, difference.maximum_y), std::tuple(0, 1));
    EXPECT_DOUBLE_EQ(difference.rmse, 2.5);
    EXPECT_NEAR(difference.psnr_db, 32.041199826559248, 1e-12);
    EXPECT_DOUBLE_EQ(difference.percent_over, 50.0);
    // Differences 3 at 10 and 4 at 20; 1 + 0.2 * reference is 3 and 5, which is met and not passed.
    const auto other_reference = picture(2, {10.0F, 20.0F}), other_tested = picture(2, {7.0F, 24.0F});
    EXPECT_DOUBLE_EQ(compare_images(other_tested, other_reference, 1.0, 0.2).percent_over, 0.0);
    EXPECT_DOUBLE_EQ(compare_images(other_tested, other_reference, 3.0, 0.0).percent_over, 50.0);
    EXPECT_DOUBLE_EQ(compare_images(other_tested, other_reference, 0.0, 0.1).percent_over, 100.0);
    const ImageDifference same = compare_images(reference, reference, 0.0, 0.0),
                          black = compare_images(picture(1, {1.0F}), {1, 1}, 0.0, 0.0);
    EXPECT_TRUE(same.identical);
    EXPECT_EQ(std::tuple(same.maximum, same.rmse, same.percent_over, same.psnr_db), std::tuple(0.0, 0.0, 0.0, infinity));
    EXPECT_EQ(std::tuple(black.psnr_db, black.rmse), std::tuple(-infinity, 1.0)) << "a black reference has no peak";
}

// An implementation of others as the oracle. It adds up floats, hence the tolerance.
TEST(ImageDifference, AgreesWithOpenCv) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> light(0.0F, 100.0F), noise(-0.5F, 0.5F);
    Image<float> reference(97, 61), tested(97, 61);
    float peak = 0.0F;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        reference.pixels()[i] = light(random);
        tested.pixels()[i] = reference.pixels()[i] + noise(random);
        peak = std::max(peak, reference.pixels()[i]);
    }
    const cv::Mat a(tested.height(), tested.width(), CV_32F, tested.data());
    const cv::Mat b(reference.height(), reference.width(), CV_32F, reference.data());
    const ImageDifference difference = compare_images(tested, reference, 0.0, 0.0);
    EXPECT_NEAR(difference.psnr_db, cv::PSNR(a, b, static_cast<double>(peak)), 1e-6);
    EXPECT_NEAR(difference.maximum, cv::norm(a, b, cv::NORM_INF), 1e-12);
    EXPECT_NEAR(difference.rmse, cv::norm(a, b, cv::NORM_L2) / std::sqrt(static_cast<double>(reference.size())), 1e-7);
}

TEST(ImageDifference, RefusesWhatCannotBeCompared) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const auto good = picture(2, {0.0F, 1.0F, 2.0F, 3.0F});
    EXPECT_THROW(compare_images(good, picture(4, {0.0F, 1.0F, 2.0F, 3.0F}), 0.0, 0.0), std::invalid_argument);
    EXPECT_THROW(compare_images({}, {}, 0.0, 0.0), std::invalid_argument);
    EXPECT_THROW(compare_images(good, good, -1.0, 0.0), std::invalid_argument);
    EXPECT_THROW(compare_images(good, good, 0.0, std::nan("")), std::invalid_argument);
    const auto refusal = [](const Image<float>& tested, const Image<float>& reference) {
        return tests::refusal_of<std::invalid_argument>([&] { compare_images(tested, reference, 0.0, 0.0); });
    };
    EXPECT_THAT(refusal(picture(2, {0.0F, 1.0F, nan, nan}), good), HasSubstr("tested picture: pixel 0, 1 is nan"));
    EXPECT_THAT(refusal(good, picture(2, {0.0F, infinity, 0.0F, 0.0F})), HasSubstr("reference picture: pixel 1, 0 is inf"));
}

/// Every pixel of a ramp from 1 to 100 lx, `factor` times too bright; each shows 2 m2.
PixelErrors of_ramp(double factor, double standard_error = 0.0) {
    PixelErrorFold fold;
    for (int x = 0; x < 100; ++x)
        fold.add({factor * (1.0 + x), 1.0 + x, standard_error, 2.0, 3, x, 7});
    return fold.finish().value();
}

TEST(PixelErrors, TwoPerCentTooBrightShowsAsTwoPerCent) {
    const PixelErrors errors = of_ramp(1.02);
    for (const double error : {errors.error.median, errors.error.p95, errors.error.p99, errors.worst.error, errors.mean})
        EXPECT_NEAR(error, 0.02, 1e-8); // kept as float
    EXPECT_EQ(errors.pixels, 100U);
    EXPECT_DOUBLE_EQ(errors.area_m2.value(), 200.0);
    EXPECT_THAT(errors.percent_beyond, ElementsAre(100.0, 0.0, 0.0));
    EXPECT_FALSE(errors.below_floor());
    EXPECT_NEAR(of_ramp(0.98).mean, -0.02, 1e-12);
    EXPECT_NEAR(of_ramp(0.98).error.median, 0.02, 1e-8);
}

TEST(PixelErrors, WhatTheReferenceMayHaveDoneItselfIsNotClaimed) {
    PixelErrorFold fold;
    fold.add({1.02, 1.0, 0.02, 1.0, 0, 0, 0});  // one standard error
    fold.add({1.049, 1.0, 0.02, 1.0, 0, 1, 0}); // two and a half
    const PixelErrors errors = fold.finish().value();
    EXPECT_NEAR(errors.floor.p95, 0.04, 1e-8);
    EXPECT_NEAR(errors.error.median, 0.0345, 1e-8);
    EXPECT_THAT(errors.percent_beyond, ElementsAre(0.0, 0.0, 0.0)); // 4.9 % is not more than 1 % + 4 %
    fold.add({1.06, 1.0, 0.02, 2.0, 0, 2, 0});
    EXPECT_THAT(fold.finish()->percent_beyond, ElementsAre(50.0, 0.0, 0.0));
    EXPECT_TRUE(of_ramp(1.0, 0.01).below_floor());
    EXPECT_FALSE(of_ramp(1.0).below_floor()); // no error, and no noise either
}

TEST(PixelErrors, QuantilesAreThoseOfTheErrorsByHand) {
    PixelErrorFold fold;
    for (int x = 0; x <= 100; ++x) // errors of 0, 0.1, ... 10 %
        fold.add({10.0 * (1.0 + 0.001 * x), 10.0, 0.0, 1.0, 0, x, 0});
    const PixelErrors errors = fold.finish().value();
    EXPECT_NEAR(errors.error.median, 0.050, 1e-8);
    EXPECT_NEAR(errors.error.p95, 0.095, 1e-8);
    EXPECT_NEAR(errors.error.p99, 0.099, 1e-8);
    EXPECT_NEAR(errors.percent_beyond[0], 100.0 * 90.0 / 101.0, 1.1); // 1 % itself is a matter of rounding
    EXPECT_EQ(errors.worst.x, 100);
    EXPECT_DOUBLE_EQ(errors.worst.tested, 11.0);
}

TEST(PixelErrors, AreaCountsNotPixels) {
    PixelErrorFold fold;
    for (int x = 0; x < 9; ++x)
        fold.add({1.0, 1.0, 0.0, 1.0, 0, x, 0});
    fold.add({1.5, 1.0, 0.0, 91.0, 2, 9, 4});
    const PixelErrors errors = fold.finish().value();
    EXPECT_THAT(errors.percent_beyond, ElementsAre(91.0, 91.0, 91.0));
    EXPECT_EQ(errors.error.median, 0.0);
    EXPECT_EQ(std::tuple(errors.worst.picture, errors.worst.y), std::tuple(2, 4));
}

TEST(PixelErrors, InTheDarkErrorsAreAbsolute) {
    PixelErrorFold fold(ErrorRule{0.05, 2.0});
    fold.add({0.02, 0.049, 0.001, 1.0, 0, 0, 0});
    fold.add({0.0, 0.0, 0.0, 1.0, 0, 1, 0});
    PixelErrors errors = fold.finish().value();
    EXPECT_EQ(std::tuple(errors.pixels, errors.dark_pixels), std::tuple(0U, 2U));
    EXPECT_NEAR(errors.dark_worst.error, 0.029, 1e-12);
    EXPECT_NEAR(errors.dark_floor.p99, 0.99 * 0.002, 1e-8);
    EXPECT_EQ(errors.mean, 0.0);
    fold.add({0.1, 0.05, 0.0, 1.0, 0, 2, 0}); // at the limit it is light
    errors = fold.finish().value();
    EXPECT_EQ(errors.pixels, 1U);
    EXPECT_NEAR(errors.worst.error, 1.0, 1e-12);
}

TEST(PixelErrors, RefusesWhatIsNoNumber) {
    EXPECT_FALSE(PixelErrorFold().finish());
    PixelErrorFold fold;
    EXPECT_THROW(fold.add({std::numeric_limits<double>::quiet_NaN(), 1.0, 0.0, 1.0, 0, 0, 0}), std::invalid_argument);
    EXPECT_THROW(fold.add({1.0, std::numeric_limits<double>::infinity(), 0.0, 1.0, 0, 0, 0}), std::invalid_argument);
    EXPECT_THROW(fold.add({1.0, 1.0, -1e-9, 1.0, 0, 0, 0}), std::invalid_argument);
    EXPECT_THROW(fold.add({1.0, 1.0, 0.0, -1.0, 0, 0, 0}), std::invalid_argument);
    EXPECT_FALSE(fold.finish());
}

TEST(PixelErrors, WithoutAreasPixelsAreCounted) {
    PixelErrorFold fold;
    for (int x = 0; x < 9; ++x)
        fold.add({1.0, 1.0, 0.0, {}, 0, x, 0});
    fold.add({1.5, 1.0, 0.0, {}, 0, 9, 0});
    const PixelErrors errors = fold.finish().value();
    EXPECT_FALSE(errors.area_m2);
    EXPECT_EQ(errors.pixels, 10U);
    EXPECT_DOUBLE_EQ(errors.percent_beyond[2], 10.0);
    EXPECT_THROW(fold.add({1.0, 1.0, 0.0, 1.0, 0, 0, 0}), std::invalid_argument);
    PixelErrorFold road;
    road.add({1.0, 1.0, 0.0, 2.0, 0, 0, 0});
    EXPECT_THROW(road.add({1.0, 1.0, 0.0, {}, 0, 0, 0}), std::invalid_argument);
}

TEST(LightDecades, PeakIsFourAndTheDarkIsZero) {
    const Image<float> light = picture(6, {100.0F, 10.0F, 0.01F, 0.001F, 0.0F, -1.0F});
    const auto decades = decades_of(light, 100.0);
    EXPECT_NEAR(static_cast<double>(decades.at(0, 0)), 4.0, 1e-6);
    EXPECT_NEAR(static_cast<double>(decades.at(1, 0)), 3.0, 1e-6);
    for (int x = 2; x < 6; ++x)
        EXPECT_NEAR(static_cast<double>(decades.at(x, 0)), 0.0, 1e-6);
    EXPECT_EQ(peak_of(light), 100.0);
    EXPECT_EQ(peak_of(Image<float>()), 0.0);
    EXPECT_THROW(decades_of(light, 0.0), std::invalid_argument);
}

// Ten times the light is one decade more everywhere: structure is the same, at any level.
TEST(LightDecades, RatiosBecomeDifferences) {
    const Image<float> light = picture(3, {0.5F, 2.0F, 7.0F}), more = picture(3, {5.0F, 20.0F, 70.0F});
    for (int x = 0; x < 3; ++x)
        EXPECT_NEAR(static_cast<double>(decades_of(more, 1e3).at(x, 0) - decades_of(light, 1e3).at(x, 0)), 1.0, 1e-5);
}

constexpr int width = 100, height = 80;

/// `truth` with noise of this relative standard error, and the variance that says so.
struct Noisy {
    Image<float> mean{width, height}, variance{width, height};
    Noisy(double truth, double relative_error, unsigned seed) {
        std::mt19937_64 random(seed);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            double sum = 0.0; // of twelve uniform numbers: variance 1; the library's own normal distribution is not the same everywhere
            for (int k = 0; k < 12; ++k)
                sum += static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
            mean.data()[i] = static_cast<float>(truth * (1.0 + relative_error * sum));
            variance.data()[i] = static_cast<float>(truth * truth * relative_error * relative_error);
        }
    }
    Image<float> mixed{width, height};
    NoisyPicture picture() const { return {&mean, &variance, &mixed, 15}; }
};

NoisyDifference compared(const Noisy& a, const Noisy& b) { return compare_noisy(a.picture(), b.picture(), 1e-4, 1e-3, 1e-3); }

TEST(NoisyDifference, NoiseAloneAgrees) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const NoisyDifference difference = compared(Noisy(10.0, 0.05, seed), Noisy(10.0, 0.05, 1000 + seed));
        EXPECT_FALSE(difference.differs()) << seed << ": " << difference.worst_z << ", " << difference.sum_z;
        EXPECT_FALSE(difference.identical);
        EXPECT_EQ(difference.compared, static_cast<std::size_t>(width * height));
    }
}

// 1 % of light is 0.14 standard errors of a pixel's difference and 0.57 of a block's, seen in none; over 8000 pixels it is 12.7.
TEST(NoisyDifference, ALittleLightEverywhereIsSeenInTheSum) {
    const NoisyDifference difference = compared(Noisy(10.1, 0.05, 1), Noisy(10.0, 0.05, 2));
    EXPECT_TRUE(difference.differs());
    EXPECT_EQ(difference.blocks_over, 0U) << difference.worst_z;
    EXPECT_NEAR(difference.sum_z, std::sqrt(8000.0) * 0.01 / std::hypot(0.05 * 1.01, 0.05), 4.0) << "its own error is 1";
    EXPECT_NEAR(difference.sum_ratio, 1.01, 0.004);
    EXPECT_LT(compared(Noisy(10.0, 0.05, 2), Noisy(10.1, 0.05, 1)).sum_z, -8.0);
}

// 15 % less in 8 x 8 pixels: two standard errors of a pixel's difference, in each of four blocks sqrt(16) times that. The sum moves by
// 64 / 8000 of 15 %, 1.5 standard errors.
TEST(NoisyDifference, AZoneIsSeenByItsBlocks) {
    Noisy a(10.0, 0.05, 1);
    const Noisy b(10.0, 0.05, 2);
    for (int y = 40; y < 48; ++y)
        for (int x = 60; x < 68; ++x)
            a.mean.at(x, y) -= 1.5F;
    const NoisyDifference difference = compared(a, b);
    EXPECT_EQ(std::tuple(difference.blocks, difference.blocks_over), std::tuple(25U * 20U, 4U));
    EXPECT_TRUE((difference.worst_x == 60 || difference.worst_x == 64) && (difference.worst_y == 40 || difference.worst_y == 44));
    EXPECT_NEAR(difference.worst_z, 4.0 * 0.15 / (0.05 * std::sqrt(2.0)), 3.0);
    EXPECT_LT(std::abs(difference.sum_z), difference.sum_bound);
}

// 16 pixels with 15 degrees of freedom each, two pictures: 480; where one pixel of one picture has all the variance: 15.
TEST(NoisyDifference, WhereOnePixelDecidesItsOwnFreedomDoes) {
    const Noisy a(10.0, 0.05, 1), b(10.0, 0.05, 2);
    const double even = compared(a, b).worst_bound;
    EXPECT_NEAR(even, 4.97, 0.02) << "Student's t, 480 degrees of freedom, two-sided at 0.0005 / 500";
    Noisy one(10.0, 0.0, 1), none(10.0, 0.0, 2);
    one.variance.at(50, 50) = 0.25F;
    const NoisyDifference alone = compare_noisy(one.picture(), none.picture(), 1e-4, 1e-3, 1e-3);
    EXPECT_EQ(alone.compared, 9U) << "those around it are as noisy, for all that is known";
    EXPECT_EQ(alone.blocks, 1U + (50 % 4 == 0 || 50 % 4 == 3 ? 3U : 0U));
    EXPECT_NEAR(alone.worst_bound, 4.417, 0.002) << "the tails of t beyond 4.4166 with 15 degrees of freedom hold 0.0005, by quadrature";
}

// An edge of light along a column: of its pixels some met light by a few samples only, all of one value, so that they know no variance, and
// are 0.3 apart. Those above and below met both sides.
TEST(NoisyDifference, AVarianceThatIsTooSmallIsRaisedByItsNeighbours) {
    Noisy a(10.0, 0.0, 1), b(10.0, 0.0, 2);
    for (int y = 0; y < height; ++y) {
        a.mean.at(50, y) = y % 2 == 0 ? 5.3F : 5.0F;
        b.mean.at(50, y) = 5.0F;
        a.variance.at(50, y) = y % 2 == 0 ? 0.0004F : 0.3F; // 15 of its errors, by itself
        b.variance.at(50, y) = y % 2 == 0 ? 0.0004F : 0.3F;
    }
    EXPECT_FALSE(compared(a, b).differs()) << compared(a, b).worst_z;
    for (int y = 0; y < height; ++y) // where all say so little, it is a difference
        a.variance.at(50, y) = b.variance.at(50, y) = 0.0004F;
    EXPECT_TRUE(compared(a, b).differs());
}

TEST(NoisyDifference, MixedPixelsAreLeftOutAndCounted) {
    Noisy a(10.0, 0.05, 1);
    const Noisy b(10.0, 0.05, 2);
    a.mean.at(63, 7) += 100.0F;
    EXPECT_TRUE(compared(a, b).differs());
    EXPECT_EQ(compared(a, b).worst_x, 60);
    EXPECT_EQ(compared(a, b).worst_y, 4);
    a.mixed.at(63, 7) = 1.0F;
    EXPECT_FALSE(compared(a, b).differs());
    EXPECT_EQ(compared(a, b).left_out, 1U);
    EXPECT_EQ(compared(b, a).left_out, 1U) << "in either picture";
    EXPECT_EQ(compared(a, b).compared, static_cast<std::size_t>(width * height) - 1);
    EXPECT_TRUE(compared(a, b).enough());
    a.mixed = Image<float>(width, height, 2.0F);
    EXPECT_FALSE(compared(a, b).enough());
    EXPECT_FALSE(compared(a, b).differs());
}

TEST(NoisyDifference, PixelsWithoutVarianceMayRoundOnly) {
    Noisy a(10.0, 0.0, 1), b(10.0, 0.0, 2);
    EXPECT_TRUE(compared(a, b).identical);
    a.mean.at(1, 2) = 10.009F;
    EXPECT_FALSE(compared(a, b).differs());
    a.mean.at(1, 2) = 10.011F;
    EXPECT_TRUE(compared(a, b).differs());
    EXPECT_EQ(compared(a, b).exact_over, 1U);
}

TEST(NoisyDifference, RefusesWhatIsNoPair) {
    Noisy a(10.0, 0.05, 1), b(10.0, 0.05, 2);
    b.variance.at(0, 0) = -1.0F;
    EXPECT_THROW(compared(a, b), std::invalid_argument);
    b.variance.at(0, 0) = NAN;
    EXPECT_THROW(compared(a, b), std::invalid_argument);
    b.variance = Image<float>(3, 3);
    EXPECT_THROW(compared(a, b), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
