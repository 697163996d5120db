#include "metrics/display/display_colour.h"
#include "metrics/display/seen_display.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fernlicht {
namespace {

constexpr double deg = std::numbers::pi / 180.0;

/// By hand: tan 20 degrees = 0.3639702; / 768 = 4.739196e-4 rad, twice that 3.25841'; 2.1 mm / 2.5 m = 8.4e-4 rad = 2.88771';
/// 768 * 2.1 mm / 0.7279405 = 2.21556 m.
TEST(SeenSize, OfTheProjectorByHand) {
    const SeenSize seen = seen_size(40.0 * deg, 768, 2.1, 2.5);
    EXPECT_NEAR(seen.scene_pixel_arcmin, 3.25841, 1.0e-4);
    EXPECT_NEAR(seen.display_pixel_arcmin, 2.88771, 1.0e-4);
    EXPECT_NEAR(seen.magnification(), 0.88624, 1.0e-4);
    EXPECT_NEAR(seen.life_size_m, 2.21556, 1.0e-4);
}

TEST(SeenSize, IsLifeSizeFromThereAndHalfFromTwiceAsFar) {
    for (const double fov : {0.01 * deg, 40.0 * deg, 120.0 * deg, 179.0 * deg})
        for (const int rows : {64, 768, 16384}) {
            const double from_m = seen_size(fov, rows, 0.27, 1.0).life_size_m;
            EXPECT_NEAR(seen_size(fov, rows, 0.27, from_m).magnification(), 1.0, 1.0e-12) << fov << ' ' << rows;
        }
    EXPECT_NEAR(seen_size(40.0 * deg, 768, 0.27, 2.0 * seen_size(40.0 * deg, 768, 0.27, 1.0).life_size_m).magnification(), 0.5, 1.0e-6);
    EXPECT_NEAR(seen_size(40.0 * deg, 1, 0.27, 1.0).scene_pixel_arcmin, 40.0 * 60.0, 1.0e-9); // one row sees it all
}

/// 30 cycles a degree are a minute of arc to half a period. Of Larson, Rushmeier and Piatko's fit: 17.25 atan(0.35) + 25.72 = 31.53 at
/// 1 cd/m2, 5.31 at 0.01.
TEST(SeenSize, TheEyeResolvesHalfAPeriod) {
    EXPECT_NEAR(resolved_arcmin(1.0), 30.0 / 31.5276, 1.0e-4);
    EXPECT_NEAR(resolved_arcmin(0.01), 5.65, 0.01);
    EXPECT_NEAR(resolved_arcmin(1.0e-6), 9.975, 0.001);
    for (double l = 1.0e-3; l < 1.0e4; l *= 1.5)
        EXPECT_GT(resolved_arcmin(l), resolved_arcmin(1.5 * l));
}

TEST(SeenSize, MeanLuminanceIsThatOfTheCodes) {
    DisplayProfile profile = srgb_display();
    profile.black_cdm2 = 0.5;
    Image<glm::u16vec3> codes(2, 1);
    codes.at(0, 0) = {255, 255, 255};
    EXPECT_NEAR(mean_shown_cdm2(profile, codes), 0.5 + 40.0, 1.0e-9); // white 80 cd/m2, and black
    codes.at(0, 0) = {188, 0, 0};                                     // sRGB 188: 0.502886 of the light
    EXPECT_NEAR(mean_shown_cdm2(profile, codes), 0.5 + 0.5 * 0.2126 * 80.0 * 0.502886, 1.0e-4);
    profile.bits = 16;
    codes.at(0, 0) = codes.at(1, 0) = {65535, 65535, 65535};
    EXPECT_NEAR(mean_shown_cdm2(profile, codes), 80.5, 1.0e-9);
}

} // namespace
} // namespace fernlicht
