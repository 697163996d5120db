#include "metrics/images/image_difference.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <opencv2/core.hpp>
#include <random>

namespace fernlicht {
namespace {

using ::testing::HasSubstr;
using ::testing::Property;
using ::testing::ThrowsMessage;

Image<float> picture(int width, int height, const std::vector<float>& values) {
    Image<float> image(width, height);
    image.pixels() = values;
    return image;
}

TEST(ImageDifference, TheSameIsIdentical) {
    const auto image = picture(2, 2, {0.0F, 1.0F, 2.0F, 1e6F});
    const ImageDifference difference = compare_images(image, image, 0.0, 0.0);
    EXPECT_TRUE(difference.identical);
    EXPECT_EQ(difference.maximum, 0.0);
    EXPECT_EQ(difference.rmse, 0.0);
    EXPECT_EQ(difference.percent_over, 0.0);
    EXPECT_EQ(difference.psnr_db, std::numeric_limits<double>::infinity());
}

// Differences 0, -3, 4, 0 on a reference with peak 100: mse 25/4, rmse 2.5, psnr 20 log10(40) = 32.0412 dB.
TEST(ImageDifference, FiguresByHand) {
    const auto reference = picture(2, 2, {1.0F, 10.0F, 20.0F, 100.0F});
    const auto tested = picture(2, 2, {1.0F, 7.0F, 24.0F, 100.0F});
    const ImageDifference difference = compare_images(tested, reference, 0.0, 0.0);
    EXPECT_FALSE(difference.identical);
    EXPECT_DOUBLE_EQ(difference.maximum, 4.0);
    EXPECT_EQ(difference.maximum_x, 0);
    EXPECT_EQ(difference.maximum_y, 1);
    EXPECT_DOUBLE_EQ(difference.rmse, 2.5);
    EXPECT_NEAR(difference.psnr_db, 32.041199826559248, 1e-12);
    EXPECT_DOUBLE_EQ(difference.percent_over, 50.0);
}

// Differences 3 at 10 and 4 at 20; 1 + 0.2 * reference is 3 and 5, which is met and not passed.
TEST(ImageDifference, ThresholdIsAbsolutePlusRelativeAndMayBeMet) {
    const auto reference = picture(2, 1, {10.0F, 20.0F});
    const auto tested = picture(2, 1, {7.0F, 24.0F});
    EXPECT_DOUBLE_EQ(compare_images(tested, reference, 1.0, 0.2).percent_over, 0.0);
    EXPECT_DOUBLE_EQ(compare_images(tested, reference, 3.0, 0.0).percent_over, 50.0);
    EXPECT_DOUBLE_EQ(compare_images(tested, reference, 0.0, 0.1).percent_over, 100.0);
}

TEST(ImageDifference, BlackReferenceHasNoPeak) {
    const ImageDifference difference = compare_images(picture(1, 1, {1.0F}), picture(1, 1, {0.0F}), 0.0, 0.0);
    EXPECT_EQ(difference.psnr_db, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(difference.rmse, 1.0);
}

TEST(ImageDifference, TwoPercentOffIsSeen) {
    Image<float> reference(64, 48, 5.0F), tested(64, 48, 5.0F * 1.02F);
    const ImageDifference difference = compare_images(tested, reference, 1e-3, 1e-2);
    EXPECT_EQ(difference.percent_over, 100.0);
    EXPECT_NEAR(difference.psnr_db, 20.0 * std::log10(50.0), 1e-5);
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
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const auto good = picture(2, 2, {0.0F, 1.0F, 2.0F, 3.0F});
    EXPECT_THROW(compare_images(good, picture(4, 1, {0.0F, 1.0F, 2.0F, 3.0F}), 0.0, 0.0), std::invalid_argument);
    EXPECT_THROW(compare_images({}, {}, 0.0, 0.0), std::invalid_argument);
    EXPECT_THROW(compare_images(good, good, -1.0, 0.0), std::invalid_argument);
    EXPECT_THROW(compare_images(good, good, 0.0, std::nan("")), std::invalid_argument);
    EXPECT_THAT(
        [&] {
            compare_images(picture(2, 2, {0.0F, 1.0F, nan, nan}), good, 0.0, 0.0);
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr("tested picture: pixel 0, 1 is nan")));
    EXPECT_THAT(
        [&] {
            compare_images(good, picture(2, 2, {0.0F, infinity, 0.0F, 0.0F}), 0.0, 0.0);
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr("reference picture: pixel 1, 0 is inf")));
}

} // namespace
} // namespace fernlicht
