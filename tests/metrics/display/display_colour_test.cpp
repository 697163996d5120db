#include "metrics/display/display_colour.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace fernlicht {
namespace {

DisplayProfile example_device() {
    FilesRead opened;
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "device.yaml";
    write_file(path, "fernlicht_display: 1\nrgb_to_xyz:\n  - [0.170, 0.090, 0.043]\n  - [0.090, 0.180, 0.033]\n  - [0.008, 0.030, 0.240]\n"
                     "unit: W/(sr m2)\ntransfer: linear\n");
    return read_display_profile(path, opened);
}

/// The colour of the display's own white with this luminance.
glm::dvec3 grey_xyz(const DisplayProfile& profile, double cdm2) { return profile.xyz_from_rgb * glm::dvec3(cdm2 / profile.white_cdm2()); }

TEST(DisplayColour, GreyFor50OnTheExampleDevice) {
    const DisplayProfile profile = example_device();
    const glm::dvec3 shares = shares_for(profile, grey_xyz(profile, 50.0));
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(shares[i], 0.242, 5.0e-4);
    EXPECT_NEAR(shown_xyz(profile, glm::dvec3(1.0)).y, 207.0, 0.1);
    EXPECT_NEAR(shown_xyz(profile, glm::dvec3(0.2416)).y, 50.0, 0.01);
}

TEST(DisplayColour, ColoursOfTheDisplayComeBack) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    FilesRead opened;
    for (const char* name : {"srgb", "projector", "hdr-monitor"}) {
        const DisplayProfile profile = read_display_profile(
            std::filesystem::path(FERNLICHT_SOURCE_DIR "/scenarios/library/displays") / (std::string(name) + ".yaml"), opened);
        for (int n = 0; n < 1000; ++n) {
            const glm::dvec3 rgb(share(random), share(random), share(random));
            const glm::dvec3 black = grey_xyz(profile, profile.black_cdm2);
            const glm::dvec3 back = shares_for(profile, black + profile.xyz_from_rgb * rgb);
            for (int i = 0; i < 3; ++i)
                EXPECT_NEAR(back[i], rgb[i], 1.0e-12) << name;
            const glm::dvec3 code(encoded(profile, rgb.x), encoded(profile, rgb.y), encoded(profile, rgb.z));
            EXPECT_NEAR(shown_xyz(profile, code).y, (black + profile.xyz_from_rgb * rgb).y, 1.0e-9 * profile.peak_cdm2()) << name;
        }
    }
}

/// Whatever the colour, the luminance is the one asked for, cut to what the display has; the hue stays on the line to white.
TEST(DisplayColour, OutOfGamutKeepsTheLuminance) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-0.3, 2.0);
    const DisplayProfile profile = srgb_display();
    for (int n = 0; n < 20000; ++n) {
        const glm::dvec3 rgb(any(random), any(random), any(random)), xyz = profile.xyz_from_rgb * rgb, shares = shares_for(profile, xyz);
        for (int i = 0; i < 3; ++i)
            EXPECT_TRUE(shares[i] >= 0.0 && shares[i] <= 1.0);
        EXPECT_NEAR((profile.xyz_from_rgb * shares).y, std::clamp(xyz.y, 0.0, profile.white_cdm2()), 1.0e-9);
        const double grey = std::clamp(xyz.y / profile.white_cdm2(), 0.0, 1.0);
        const glm::dvec3 wanted = xyz.y > 0.0 ? rgb * (grey * profile.white_cdm2() / xyz.y) - grey : glm::dvec3(0.0), shown = shares - grey;
        if (grey > 0.0 && grey < 1.0)
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(wanted[i] * shown[(i + 1) % 3], wanted[(i + 1) % 3] * shown[i], 1.0e-9); // parallel
                EXPECT_GE(wanted[i] * shown[i], -1.0e-12);                                           // and the same way
            }
    }
    // By hand: full red twice as bright as the display's red. Y = 0.4252 of white; towards the grey 0.4252 until red is 1:
    // keep = (1 - 0.4252) / (2 - 0.4252) = 0.365, so green = blue = 0.4252 (1 - 0.365) = 0.27.
    const glm::dvec3 red = shares_for(profile, profile.xyz_from_rgb * glm::dvec3(2.0, 0.0, 0.0));
    EXPECT_NEAR(red.x, 1.0, 1.0e-12);
    EXPECT_NEAR(red.y, 0.4252 * (1.0 - 0.5748 / 1.5748), 1.0e-12);
    EXPECT_NEAR(red.z, red.y, 1.0e-12);
    DisplayProfile clipping = profile;
    clipping.gamut = GamutRule::clip;
    EXPECT_EQ(shares_for(clipping, profile.xyz_from_rgb * glm::dvec3(2.0, 0.0, 0.0)).y, 0.0);
}

TEST(DisplayColour, ToneMapperDecidesTheLuminanceAndBlackIsAdded) {
    FilesRead opened;
    const DisplayProfile profile = read_display_profile(FERNLICHT_SOURCE_DIR "/scenarios/library/displays/projector.yaml", opened);
    const ToneMapper mapper{ToneMapperKind::rational, 20.0, 100.0, {}};
    for (const double l : {0.01, 0.3, 5.0, 80.0, 1000.0}) {
        const glm::dvec3 code = display_code(profile, mapper, glm::dvec3(l));
        EXPECT_NEAR(shown_xyz(profile, code).y, 0.12 + toned(mapper, l) * 119.88, 1.0e-9) << l;
        // White of the scene is white of this display, whose matrix has one more digit than sRGB's.
        EXPECT_NEAR(code.x, code.y, 2.0e-4);
        EXPECT_NEAR(code.z, code.y, 2.0e-4);
    }
    EXPECT_EQ(display_code(profile, mapper, glm::dvec3(0.0)), glm::dvec3(0.0));
}

TEST(DisplayColour, PictureRoundsToTheNearestCode) {
    const ToneMapper mapper{ToneMapperKind::linear, 1.0, 100.0, {}};
    Image<glm::vec3> light(3, 1);
    light.pixels() = {glm::vec3(0.0F), glm::vec3(50.0F), glm::vec3(1000.0F)};
    const Image<glm::u16vec3> eight = display_picture(srgb_display(), mapper, light);
    EXPECT_EQ(eight.at(0, 0), glm::u16vec3(0));
    EXPECT_EQ(eight.at(1, 0), glm::u16vec3(188)); // 255 * 0.735357 = 187.5
    EXPECT_EQ(eight.at(2, 0), glm::u16vec3(255));
    DisplayProfile deep = srgb_display();
    deep.bits = 16;
    EXPECT_EQ(display_picture(deep, mapper, light).at(1, 0), glm::u16vec3(48192)); // 65535 * 0.7353570
}

} // namespace
} // namespace fernlicht
