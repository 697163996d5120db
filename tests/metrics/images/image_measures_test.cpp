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
    const double whole = ssim(b, a, 255.0).mean, scales = *ssim_scales(b, a, 255.0).all;
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(ssim(b, a, 255.0).mean, whole);
    EXPECT_EQ(*ssim_scales(b, a, 255.0).all, scales);
}

TEST(MsSsim, OfTheSameAndOfOppositePictures) {
    const auto luma = luma_of(made_scene(170, 161));
    EXPECT_DOUBLE_EQ(*ssim_scales(luma, luma, 255.0).all, 1.0);
    const auto small = luma_of(made_scene(170, 160));
    EXPECT_FALSE(ssim_scales(small, small, 255.0).all);
    // Even pictures stay even at every scale and have contrast and structure of 1: only the coarsest scale's luminance counts, to 0.1333.
    EXPECT_NEAR(*ssim_scales({161, 161, 110.0F}, {161, 161, 100.0F}, 255.0).all, std::pow(22006.5025 / 22106.5025, 0.1333), 1e-12);
    // A chessboard of single pixels is grey from the second scale on: against its negative, contrast and structure of the finest scale are
    // near -1 and count as 0, and so does the product.
    Image<float> board(162, 162), negative(162, 162);
    for (int y = 0; y < 162; ++y)
        for (int x = 0; x < 162; ++x) {
            board.at(x, y) = (x + y) % 2 == 0 ? 200.0F : 50.0F;
            negative.at(x, y) = 250.0F - board.at(x, y);
        }
    EXPECT_LT(ssim(negative, board, 255.0).mean, -0.9);
    EXPECT_EQ(*ssim_scales(negative, board, 255.0).all, 0.0);
}

// The four finer scales see a chessboard of 2 x 2 pixels less and less: moved by noise of single pixels alone, MS-SSIM forgives more than
// SSIM.
TEST(MsSsim, ForgivesFineNoise) {
    const auto luma = luma_of(made_scene(176, 176)), noisy = luma_of(disturbed(made_scene(176, 176), 60, 9));
    EXPECT_GT(*ssim_scales(noisy, luma, 255.0).all, ssim(noisy, luma, 255.0).mean);
}

struct Pair {
    Lab one, other;
    double difference;
};

// Table 1 of Sharma, Wu and Dalal (2005), all 34 pairs, four decimals.
const Pair published[] = {{{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
                          {{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
                          {{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
                          {{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
                          {{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
                          {{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
                          {{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
                          {{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
                          {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
                          {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
                          {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
                          {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
                          {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
                          {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
                          {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
                          {{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
                          {{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
                          {{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
                          {{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
                          {{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
                          {{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
                          {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
                          {{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
                          {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
                          {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
                          {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
                          {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
                          {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
                          {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
                          {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
                          {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
                          {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
                          {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
                          {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}};

TEST(Ciede2000, AllPublishedPairsBothWaysAndLabOfKnownColours) {
    EXPECT_EQ(std::size(published), 34U);
    for (std::size_t i = 0; i < std::size(published); ++i) {
        EXPECT_NEAR(ciede2000(published[i].one, published[i].other), published[i].difference, 1e-4) << "pair " << i + 1;
        EXPECT_NEAR(ciede2000(published[i].other, published[i].one), published[i].difference, 1e-4) << "pair " << i + 1 << " turned round";
    }
    const Lab white = lab_of({255, 255, 255}), black = lab_of({0, 0, 0}), red = lab_of({255, 0, 0}), grey = lab_of({119, 119, 119});
    EXPECT_NEAR(white.l, 100.0, 1e-9);
    EXPECT_NEAR(white.a, 0.0, 1e-9);
    EXPECT_NEAR(white.b, 0.0, 1e-9);
    EXPECT_NEAR(black.l, 0.0, 1e-9);
    // sRGB red by hand: Y = 0.21264, its root 0.59688, L* = 53.24; the published (53.24, 80.09, 67.20) to their two digits.
    EXPECT_NEAR(red.l, 53.24, 0.005);
    EXPECT_NEAR(red.a, 80.09, 0.01);
    EXPECT_NEAR(red.b, 67.20, 0.01);
    EXPECT_NEAR(grey.l, 50.03, 0.005); // (119 / 255 + 0.055) / 1.055 to the 2.4 is 0.18447; 116 * 0.56926 - 16
}

TEST(Ciede2000, PictureByPixel) {
    Image<Rgb8> reference(4, 5, {0, 0, 0}), tested = reference;
    tested.at(3, 2) = {255, 255, 255};
    const auto map = ciede2000_map(tested, reference);
    const ColourDifference found = summary_of_colours(map);
    EXPECT_NEAR(found.maximum, 100.0, 1e-4); // 100 / S_L with L' = 50 in the middle: S_L = 1
    EXPECT_EQ(found.maximum_x, 3);
    EXPECT_EQ(found.maximum_y, 2);
    EXPECT_NEAR(found.mean, 5.0, 1e-5);
    EXPECT_EQ(found.median, 0.0);
    EXPECT_EQ(found.p95, 0.0); // the 19th of 20
    // More pairs than are remembered, each twice.
    Image<Rgb8> many(256, 64), others(256, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 256; ++x) {
            many.at(x, y) = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y / 2), 7};
            others.at(x, y) = {static_cast<std::uint8_t>(y / 2), 9, static_cast<std::uint8_t>(x)};
        }
    const auto all = ciede2000_map(many, others);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 256; ++x)
            ASSERT_EQ(all.at(x, y), static_cast<float>(ciede2000(lab_of(many.at(x, y)), lab_of(others.at(x, y))))) << x << ' ' << y;
    EXPECT_THROW(ciede2000_map({2, 2}, {2, 3}), std::invalid_argument);
    EXPECT_THROW(ciede2000_map({}, {}), std::invalid_argument);
}

} // namespace

} // namespace fernlicht
