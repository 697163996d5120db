#include "metrics/display/display_colour.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/values/files.h"
#include "tests/trial.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <tuple>

namespace fernlicht {
namespace {

/// Night pictures: most pixels near 0.05 cd/m2, a lit road of some cd/m2, few sources of thousands.
LuminanceHistogram night() {
    LuminanceHistogram histogram;
    std::mt19937 random(7);
    std::lognormal_distribution<double> dark(std::log(0.05), 1.2), road(std::log(2.0), 0.8), source(std::log(3000.0), 0.5);
    for (int i = 0; i < 70000; ++i)
        histogram.add(dark(random));
    for (int i = 0; i < 28000; ++i)
        histogram.add(road(random));
    for (int i = 0; i < 100; ++i)
        histogram.add(source(random));
    return histogram;
}

std::vector<ToneMapper> mappers() {
    std::vector<ToneMapper> all;
    for (const double l_max : {1.0e-6, 1.0, 100.0, 1.0e9}) {
        all.push_back({ToneMapperKind::linear, 1.0, l_max, {}});
        for (const double s : {1.0, 1.0 + 1.0e-9, 2.0, 20.0, 1.0e6}) {
            all.push_back({ToneMapperKind::rational, s, l_max, {}});
            all.push_back({ToneMapperKind::logarithmic, s, l_max, {}});
        }
    }
    for (const double range : {1.0e-2, 1.0e-3})
        for (const double l_max : {10.0, 100.0, 5000.0})
            all.push_back(histogram_mapper(night(), l_max, range));
    return all;
}

class ToneMappers : public testing::TestWithParam<ToneMapper> {};

TEST_P(ToneMappers, RiseFromNothingToWhite) {
    const ToneMapper& mapper = GetParam();
    EXPECT_EQ(toned(mapper, 0.0), 0.0);
    EXPECT_EQ(toned(mapper, -1.0), 0.0);
    EXPECT_EQ(toned(mapper, std::numeric_limits<double>::quiet_NaN()), 0.0);
    EXPECT_EQ(toned(mapper, mapper.l_max_cdm2), 1.0);
    EXPECT_EQ(toned(mapper, std::numeric_limits<double>::infinity()), 1.0);
    double last = 0.0;
    for (int i = -900; i <= 0; ++i) {
        const double now = toned(mapper, mapper.l_max_cdm2 * std::pow(10.0, i / 100.0));
        EXPECT_GT(now, last) << i;
        EXPECT_LE(now, 1.0);
        last = now;
    }
}

/// Relative rounding of the inverse: the curve's own, times how strongly the inverse reacts, d ln L / d ln d.
TEST_P(ToneMappers, RoundTripsWithinRounding) {
    const ToneMapper& mapper = GetParam();
    for (int i = -900; i < 0; ++i) {
        const double l = mapper.l_max_cdm2 * std::pow(10.0, i / 100.0), d = toned(mapper, l);
        const auto back = untoned(mapper, d);
        ASSERT_TRUE(back);
        const double logarithms = mapper.kind == ToneMapperKind::histogram ? 40.0 : 1.0; // exp of a logarithm up to 40
        EXPECT_NEAR(*back / l, 1.0, 16.0 * logarithms * 2.3e-16 / contrast_kept(mapper, l)) << l;
        EXPECT_NEAR(toned(mapper, *back), d, 16.0 * logarithms * 2.3e-16 * d) << l;
    }
    EXPECT_FALSE(untoned(mapper, 1.0 + 1.0e-12));
    EXPECT_FALSE(untoned(mapper, -1.0e-12));
    EXPECT_FALSE(untoned(mapper, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_EQ(*untoned(mapper, 0.0), 0.0);
    EXPECT_EQ(*untoned(mapper, 1.0), mapper.l_max_cdm2);
}

TEST_P(ToneMappers, ContrastKeptIsTheSlopeInLogarithms) {
    const ToneMapper& mapper = GetParam();
    for (int i = -80; i < -1; ++i) {
        const double l = mapper.l_max_cdm2 * std::pow(10.0, i / 10.0 + 0.013), h = 1.0e-5;
        if (mapper.kind == ToneMapperKind::histogram) // a step of the slope may lie within the difference
            continue;
        const double difference = (std::log(toned(mapper, l * std::exp(h))) - std::log(toned(mapper, l * std::exp(-h)))) / (2.0 * h);
        EXPECT_NEAR(contrast_kept(mapper, l), difference, 1.0e-8) << l;
    }
    EXPECT_EQ(contrast_kept(mapper, 2.0 * mapper.l_max_cdm2), 0.0);
}

INSTANTIATE_TEST_SUITE_P(, ToneMappers, testing::ValuesIn(mappers()),
                         [](const auto& test) { return std::string(name(test.param.kind)) + std::to_string(test.index); });

TEST(ToneCurve, FiguresByHandAndLinearUntilItIsFound) {
    ToneMapper open{.kind = ToneMapperKind::histogram};
    ASSERT_TRUE(open.is_open());
    EXPECT_EQ(toned(open, 25.0), 0.25);
    EXPECT_EQ(*untoned(open, 0.25), 25.0);
    EXPECT_EQ(contrast_kept(open, 25.0), 1.0);
    // s = 20, L_max = 100: 20 * 10 / (200 - 10 + 100) = 0.6897; logarithmic with s = 9: ln(1 + 0.9) / ln 10.
    EXPECT_NEAR(toned({ToneMapperKind::rational, 20.0, 100.0, {}}, 10.0), 200.0 / 290.0, 1.0e-15);
    EXPECT_NEAR(toned({ToneMapperKind::logarithmic, 9.0, 100.0, {}}, 10.0), std::log10(1.9), 1.0e-15);
    EXPECT_NEAR(contrast_kept({ToneMapperKind::rational, 20.0, 100.0, {}}, 10.0), 1.0 / 2.9, 1.0e-15);
    // Black of 1 % of white under light of 1 % of white: half of the contrast is left.
    EXPECT_NEAR(contrast_kept({ToneMapperKind::linear, 1.0, 99.0, {}}, 1.0, 0.01), 0.5, 1.0e-12);
}

TEST(ToneFit, OfOneLuminanceAndOfAHistogramOfFourPixels) {
    for (const double l : {0.01, 0.5, 10.0})
        EXPECT_NEAR(toned({ToneMapperKind::rational, fitted_s(l, 100.0, 0.18), 100.0, {}}, l), 0.18, 1.0e-14);
    EXPECT_EQ(fitted_s(50.0, 100.0, 0.18), 1.0); // linear shows it with 0.5 already
    EXPECT_EQ(fitted_s(100.0, 100.0, 0.18), 1.0);
    EXPECT_EQ(fitted_s(0.0, 100.0, 0.18), 1.0);
    LuminanceHistogram histogram;
    Image<float> picture(2, 2);
    picture.pixels() = {0.0F, 1.0F, 100.0F, 5000.0F};
    histogram.add(picture);
    EXPECT_EQ(std::tuple(histogram.pixels(), histogram.max_cdm2()), std::tuple(4U, 5000.0));
    EXPECT_NEAR(histogram.log_mean_cdm2(), std::cbrt(500000.0), 1.0e-9);
}

TEST(ToneFit, HistogramCurveRaisesNoContrastAndSpendsTheWholeDisplay) {
    const ToneMapper mapper = histogram_mapper(night(), 5000.0, 1.0e-2);
    ASSERT_EQ(mapper.kind, ToneMapperKind::histogram);
    EXPECT_NEAR(mapper.curve.front().ln_share, std::log(1.0e-2), 1.0e-9);
    EXPECT_EQ(mapper.curve.back(), (ToneKnot{std::log(5000.0), 0.0}));
    for (double ln = mapper.curve.front().ln_luminance; ln < std::log(5000.0); ln += 0.01) {
        EXPECT_LE(contrast_kept(mapper, std::exp(ln)), 1.0 + 1.0e-9);
        EXPECT_GT(contrast_kept(mapper, std::exp(ln)), 0.0);
    }
    // Where the pixels are contrast is kept, in the empty stretch between road and sources it is not.
    EXPECT_GT(contrast_kept(mapper, 0.05), 2.0 * contrast_kept(mapper, 200.0));
}

TEST(ToneFit, WhatFitsTheDisplayIsShownAsItIs) {
    LuminanceHistogram histogram;
    for (int i = 0; i < 1000; ++i)
        histogram.add(1.0 + 0.009 * i);
    EXPECT_EQ(histogram_mapper(histogram, 10.0, 1.0e-3).kind, ToneMapperKind::linear);
    EXPECT_EQ(histogram_mapper(LuminanceHistogram(), 10.0, 1.0e-3).kind, ToneMapperKind::linear);
}

DisplayProfile example_device() {
    FilesRead opened;
    return read_display_profile(tests::written("device.yaml",
                                               "fernlicht_display: 1\nrgb_to_xyz:\n  - [0.170, 0.090, 0.043]\n  - [0.090, 0.180, 0.033]\n"
                                               "  - [0.008, 0.030, 0.240]\nunit: W/(sr m2)\ntransfer: linear\n"),
                                opened);
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
            const glm::dvec3 rgb(share(random), share(random), share(random)), black = grey_xyz(profile, profile.black_cdm2);
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

TEST(AdaptedLuminance, FollowsByItsTimeConstants) {
    AdaptedLuminance eye(0.5, 10.0);
    EXPECT_EQ(eye.cdm2(), 0.0);
    eye.see(1.0, 0.1);
    EXPECT_EQ(eye.cdm2(), 1.0); // the first picture
    eye.see(100.0, 0.5);        // one time constant: 1 - 1/e of two decades
    EXPECT_NEAR(std::log10(eye.cdm2()), 2.0 * (1.0 - std::exp(-1.0)), 1.0e-12);
    AdaptedLuminance other(0.5, 10.0);
    other.see(100.0, 0.1);
    other.see(1.0, 10.0);
    EXPECT_NEAR(std::log10(other.cdm2()), 2.0 * std::exp(-1.0), 1.0e-12);
}

TEST(AdaptedLuminance, StepsDoNotMatter) {
    AdaptedLuminance one(0.5, 10.0), many(0.5, 10.0);
    one.see(1.0, 1.0);
    many.see(1.0, 1.0);
    one.see(30.0, 0.7);
    for (int i = 0; i < 70; ++i)
        many.see(30.0, 0.01);
    EXPECT_NEAR(one.cdm2(), many.cdm2(), 1.0e-12 * one.cdm2());
}

TEST(AdaptedLuminance, DarknessWithoutAnyLightChangesNothing) {
    AdaptedLuminance eye(0.5, 10.0);
    eye.see(3.0, 1.0);
    eye.see(0.0, 1.0);
    eye.see(std::nan(""), 1.0);
    EXPECT_EQ(eye.cdm2(), 3.0);
}

} // namespace
} // namespace fernlicht
