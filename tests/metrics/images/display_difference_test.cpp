#include "metrics/images/image_difference.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace fernlicht {
namespace {

TEST(DisplayDifference, TheSameHasNone) {
    const Image<Rgb8> picture(3, 2, {1, 2, 3});
    const DisplayDifference found = compare_displays(picture, picture);
    EXPECT_EQ(found.maximum, 0);
    EXPECT_EQ(found.rmse, 0.0);
    EXPECT_EQ(found.percent_different, 0.0);
    EXPECT_EQ(found.psnr_db, std::numeric_limits<double>::infinity());
}

// Of four pixels one differs by -3 and 4 in two channels: 25 over 12 values, rmse 1.4434, 20 log10(255 / 1.4434) = 44.943 dB.
TEST(DisplayDifference, ByHand) {
    Image<Rgb8> reference(2, 2, {10, 20, 30}), tested = reference;
    tested.at(1, 0) = {7, 24, 30};
    const DisplayDifference found = compare_displays(tested, reference);
    EXPECT_EQ(found.maximum, 4);
    EXPECT_EQ(found.maximum_x, 1);
    EXPECT_EQ(found.maximum_y, 0);
    EXPECT_DOUBLE_EQ(found.rmse, std::sqrt(25.0 / 12.0));
    EXPECT_NEAR(found.psnr_db, 44.943, 5e-4);
    EXPECT_DOUBLE_EQ(found.percent_different, 25.0);
    EXPECT_DOUBLE_EQ(found.mean_signed[0], -0.75);
    EXPECT_DOUBLE_EQ(found.mean_signed[1], 1.0);
    EXPECT_DOUBLE_EQ(found.mean_signed[2], 0.0);
}

TEST(DisplayDifference, BlackAndWhiteIsTheWholeRange) {
    const DisplayDifference found = compare_displays({2, 2, {255, 255, 255}}, {2, 2, {0, 0, 0}});
    EXPECT_EQ(found.maximum, 255);
    EXPECT_DOUBLE_EQ(found.rmse, 255.0);
    EXPECT_DOUBLE_EQ(found.psnr_db, 0.0);
}

TEST(DisplayDifference, LumaAndChannels) {
    const Image<Rgb8> picture(1, 1, {255, 0, 100});
    EXPECT_NEAR(static_cast<double>(luma_of(picture).at(0, 0)), 0.2126 * 255 + 0.0722 * 100, 1e-4);
    EXPECT_EQ(channel_of(picture, 0).at(0, 0), 255.0F);
    EXPECT_EQ(channel_of(picture, 1).at(0, 0), 0.0F);
    EXPECT_EQ(channel_of(picture, 2).at(0, 0), 100.0F);
}

TEST(DisplayDifference, WrongInputIsRefused) {
    EXPECT_THROW(compare_displays({2, 2}, {2, 3}), std::invalid_argument);
    EXPECT_THROW(compare_displays({}, {}), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
