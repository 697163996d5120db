#include "metrics/display/night_vision.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fernlicht {
namespace {

constexpr double pixel_deg = 0.05;

TEST(NightVision, AcuityIsThePublishedFit) {
    EXPECT_NEAR(acuity_cycles_per_deg(1.0), 17.25 * 0.336675 + 25.72, 1.0e-4); // atan(0.35)
    EXPECT_NEAR(acuity_cycles_per_deg(0.01), 5.31, 0.01);
    EXPECT_NEAR(acuity_cycles_per_deg(100.0), 17.25 * std::atan(3.15) + 25.72, 1.0e-12);
    EXPECT_EQ(acuity_cycles_per_deg(1.0e-9), acuity_cycles_per_deg(1.0e-3));
    EXPECT_NEAR(acuity_cycles_per_deg(0.0), 3.0, 0.01);
}

TEST(NightVision, ConesGoWithTheLight) {
    EXPECT_EQ(cone_share(0.0), 0.0);
    EXPECT_EQ(cone_share(0.004), 0.0);
    EXPECT_EQ(cone_share(5.5), 1.0);
    EXPECT_EQ(cone_share(1.0e6), 1.0);
    EXPECT_NEAR(cone_share(1.0), 0.7670, 1.0e-4); // S/P 1: Lmes = Lp, so m = 0.7670 + 0.3334 lg Lp
    EXPECT_NEAR(cone_share(0.1), 0.4336, 1.0e-4);
    double last = -1.0;
    for (double l = 1.0e-5; l < 20.0; l *= 1.01) {
        EXPECT_GE(cone_share(l), last);
        last = cone_share(l);
    }
}

TEST(NightVision, RodsSeeBlueBrighterAndRedDarker) {
    EXPECT_NEAR(rod_luminance_cdm2(glm::dvec3(3.0)), 3.0, 1.0e-12);
    // By hand: red has X 0.4124, Y 0.2126, Z 0.0193: 0.2126 (1.33 * 1.5623 - 1.68) / 2.573 = 0.0329.
    EXPECT_NEAR(rod_luminance_cdm2({1.0, 0.0, 0.0}), 0.0329, 1.0e-4);
    EXPECT_GT(rod_luminance_cdm2({0.0, 0.0, 1.0}), 2.0 * 0.0722);
    EXPECT_EQ(rod_luminance_cdm2(glm::dvec3(0.0)), 0.0);
}

TEST(NightVision, AdaptsToOneDegreeAround) {
    Image<glm::vec3> light(101, 101, glm::vec3(0.0F));
    light.at(50, 50) = glm::vec3(441.0F); // 21 x 21 pixels are 1.05 degrees
    const Image<float> adapted = adaptation_cdm2(light, pixel_deg);
    EXPECT_NEAR(adapted.at(50, 50), 1.0F, 1.0e-4F);
    EXPECT_NEAR(adapted.at(60, 40), 1.0F, 1.0e-4F);
    EXPECT_EQ(adapted.at(61, 50), 0.0F);
    light = Image<glm::vec3>(30, 20, glm::vec3(2.0F));
    EXPECT_NEAR(adaptation_cdm2(light, pixel_deg).at(0, 0), 2.0F, 1.0e-5F); // cut at the edge, not darker there
}

TEST(NightVision, BrightPicturesKeepTheirBytes) {
    Image<glm::vec3> light(64, 48);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            light.at(x, y) = glm::vec3(20.0F + static_cast<float>(x), 30.0F, 10.0F + static_cast<float>(y));
    EXPECT_EQ(colours_at_night(light, pixel_deg), light);
    EXPECT_EQ(sharpness_at_night(light, pixel_deg), light); // 50 cycles a degree: sigma 0.007 degrees, 0.14 pixels
    EXPECT_TRUE(sharpness_at_night(Image<glm::vec3>(), pixel_deg).empty());
}

TEST(NightVision, DarkRedIsGreyAndDarker) {
    const Image<glm::vec3> dark(40, 40, glm::vec3(0.004F, 0.0F, 0.0F));
    const glm::vec3 seen = colours_at_night(dark, pixel_deg).at(20, 20);
    EXPECT_EQ(seen.x, seen.y);
    EXPECT_EQ(seen.y, seen.z);
    EXPECT_NEAR(seen.x, 0.004F * 0.0329F, 1.0e-6F);
}

/// A grating of the finest period that the eye resolves keeps a tenth of its contrast; one three times as coarse nearly all of it.
TEST(NightVision, GratingsAtTheLimitKeepATenth) {
    const double mean_cdm2 = 0.01, finest = acuity_cycles_per_deg(mean_cdm2), fine_pixel_deg = 0.01;
    for (const auto& [coarser, kept] : {std::pair(1.0, 0.1), std::pair(3.0, std::pow(0.1, 1.0 / 9.0))}) {
        const int width = 400;
        Image<glm::vec3> light(width, 200);
        for (int y = 0; y < 200; ++y)
            for (int x = 0; x < width; ++x)
                light.at(x, y) = glm::vec3(
                    static_cast<float>(mean_cdm2 * (1.0 + 0.5 * std::sin(2.0 * std::numbers::pi * x * fine_pixel_deg * finest / coarser))));
        const Image<glm::vec3> seen = sharpness_at_night(light, fine_pixel_deg);
        float most = 0.0F, least = 1.0F;
        for (int x = 100; x < 300; ++x) {
            most = std::max(most, seen.at(x, 100).x);
            least = std::min(least, seen.at(x, 100).x);
        }
        EXPECT_NEAR(static_cast<double>((most - least) / (most + least)) / 0.5, kept, 0.06) << coarser;
    }
}

} // namespace
} // namespace fernlicht
