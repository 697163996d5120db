#include "metrics/images/ssim.h"

#include "metrics/images/image_difference.h"
#include "tests/metrics/images/made_pictures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <tbb/global_control.h>
#include <tuple>

namespace fernlicht {
namespace {

using tests::disturbed, tests::made_scene, tests::shifted;

TEST(Ssim, OfTheSameAndOfEvenPicturesByHand) {
    const auto luma = luma_of(made_scene(30, 20));
    EXPECT_DOUBLE_EQ(ssim(luma, luma, 255.0).mean, 1.0);
    EXPECT_DOUBLE_EQ(ssim(luma, luma, 255.0).minimum, 1.0);
    // Even pictures of 100 and 110 have no structure: (2 100 110 + 6.5025) / (100^2 + 110^2 + 6.5025), times C2 / C2.
    const Ssim found = ssim({16, 16, 110.0F}, {16, 16, 100.0F}, 255.0);
    EXPECT_NEAR(found.mean, 22006.5025 / 22106.5025, 1e-12);
    Image<float> reference(40, 30, 50.0F), tested = reference;
    tested.at(31, 7) = 250.0F;
    const Ssim other_found = ssim(tested, reference, 255.0);
    EXPECT_EQ(std::tuple(other_found.minimum_x, other_found.minimum_y), std::tuple(31, 7));
    EXPECT_LT(other_found.minimum, 0.5);
    EXPECT_THROW(ssim({2, 2}, {2, 3}, 1.0), std::invalid_argument);
    EXPECT_THROW(ssim({}, {}, 1.0), std::invalid_argument);
    EXPECT_THROW(ssim({2, 2}, {2, 2}, 0.0), std::invalid_argument);
    EXPECT_THROW(ssim({2, 2, std::numeric_limits<float>::quiet_NaN()}, {2, 2}, 1.0), std::invalid_argument);
}

// What OpenCV 4.6.0's quality module (QualitySSIM::compute) says of the same pictures, channel by channel. It works in floats, whose
// differences of large squares leave some 1e-5 in a mean.
TEST(Ssim, IsOpenCVsOnEachChannel) {
    struct Case {
        const char* name;
        Image<Rgb8> tested, reference;
        double expected[3];
    };
    const auto scene = made_scene(64, 48), odd = made_scene(37, 91);
    const Case cases[] = {{"disturbed by 4", disturbed(scene, 4, 1), scene, {0.949415474936, 0.992574733042, 0.988372534766}},
                          {"disturbed by 60", disturbed(scene, 60, 2), scene, {0.207083860137, 0.733385147595, 0.540168617191}},
                          {"shifted", shifted(scene), scene, {0.900124609053, 0.561266642665, 0.228246247460}},
                          {"odd sizes", disturbed(odd, 20, 3), odd, {0.513784127846, 0.780257405448, 0.731722716416}}};
    for (const Case& c : cases)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(ssim(channel_of(c.tested, channel), channel_of(c.reference, channel), 255.0).mean, c.expected[channel], 2e-5)
                << c.name << ", channel " << channel;
}

TEST(Ssim, AnyNumberOfThreadsGivesTheSameBytes) {
    const auto a = luma_of(made_scene(200, 170)), b = luma_of(disturbed(made_scene(200, 170), 25, 4));
    const double whole = ssim(b, a, 255.0).mean, scales = *ms_ssim(b, a, 255.0);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(ssim(b, a, 255.0).mean, whole);
    EXPECT_EQ(*ms_ssim(b, a, 255.0), scales);
}

TEST(MsSsim, OfTheSameAndOfOppositePictures) {
    const auto luma = luma_of(made_scene(170, 161));
    EXPECT_DOUBLE_EQ(*ms_ssim(luma, luma, 255.0), 1.0);
    const auto small = luma_of(made_scene(170, 160));
    EXPECT_FALSE(ms_ssim(small, small, 255.0));
    // Even pictures stay even at every scale and have contrast and structure of 1: only the coarsest scale's luminance counts, to 0.1333.
    EXPECT_NEAR(*ms_ssim({161, 161, 110.0F}, {161, 161, 100.0F}, 255.0), std::pow(22006.5025 / 22106.5025, 0.1333), 1e-12);
    // A chessboard of single pixels is grey from the second scale on: against its negative, contrast and structure of the finest scale are
    // near -1 and count as 0, and so does the product.
    Image<float> board(162, 162), negative(162, 162);
    for (int y = 0; y < 162; ++y)
        for (int x = 0; x < 162; ++x) {
            board.at(x, y) = (x + y) % 2 == 0 ? 200.0F : 50.0F;
            negative.at(x, y) = 250.0F - board.at(x, y);
        }
    EXPECT_LT(ssim(negative, board, 255.0).mean, -0.9);
    EXPECT_EQ(*ms_ssim(negative, board, 255.0), 0.0);
}

// The four finer scales see a chessboard of 2 x 2 pixels less and less: moved by noise of single pixels alone, MS-SSIM forgives more than
// SSIM.
TEST(MsSsim, ForgivesFineNoise) {
    const auto luma = luma_of(made_scene(176, 176)), noisy = luma_of(disturbed(made_scene(176, 176), 60, 9));
    EXPECT_GT(*ms_ssim(noisy, luma, 255.0), ssim(noisy, luma, 255.0).mean);
}

} // namespace
} // namespace fernlicht
