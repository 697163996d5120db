#include "metrics/display/tone_fit.h"
#include "scenarios/display/tone_mapper.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

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

TEST(ToneCurve, ACurveThatIsNotFoundYetIsLinear) {
    ToneMapper open;
    open.kind = ToneMapperKind::histogram;
    ASSERT_TRUE(open.is_open());
    EXPECT_EQ(toned(open, 25.0), 0.25);
    EXPECT_EQ(*untoned(open, 0.25), 25.0);
    EXPECT_EQ(contrast_kept(open, 25.0), 1.0);
}

TEST(ToneCurve, FiguresByHand) {
    // s = 20, L_max = 100: 20 * 10 / (200 - 10 + 100) = 0.6897; logarithmic with s = 9: ln(1 + 0.9) / ln 10.
    EXPECT_NEAR(toned({ToneMapperKind::rational, 20.0, 100.0, {}}, 10.0), 200.0 / 290.0, 1.0e-15);
    EXPECT_NEAR(toned({ToneMapperKind::logarithmic, 9.0, 100.0, {}}, 10.0), std::log10(1.9), 1.0e-15);
    EXPECT_NEAR(contrast_kept({ToneMapperKind::rational, 20.0, 100.0, {}}, 10.0), 1.0 / 2.9, 1.0e-15);
    // Black of 1 % of white under light of 1 % of white: half of the contrast is left.
    EXPECT_NEAR(contrast_kept({ToneMapperKind::linear, 1.0, 99.0, {}}, 1.0, 0.01), 0.5, 1.0e-12);
}

TEST(ToneFit, SShowsTheLuminanceAsAsked) {
    for (const double l : {0.01, 0.5, 10.0})
        EXPECT_NEAR(toned({ToneMapperKind::rational, fitted_s(l, 100.0, 0.18), 100.0, {}}, l), 0.18, 1.0e-14);
    EXPECT_EQ(fitted_s(50.0, 100.0, 0.18), 1.0); // linear shows it with 0.5 already
    EXPECT_EQ(fitted_s(100.0, 100.0, 0.18), 1.0);
    EXPECT_EQ(fitted_s(0.0, 100.0, 0.18), 1.0);
}

TEST(ToneFit, HistogramOfFourPixels) {
    LuminanceHistogram histogram;
    Image<float> picture(2, 2);
    picture.pixels() = {0.0F, 1.0F, 100.0F, 5000.0F};
    histogram.add(picture);
    EXPECT_EQ(histogram.pixels(), 4U);
    EXPECT_EQ(histogram.most_cdm2(), 5000.0);
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

} // namespace
} // namespace fernlicht
