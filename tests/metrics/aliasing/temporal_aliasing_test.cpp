#include "metrics/aliasing/contrast_sensitivity.h"
#include "metrics/aliasing/spatial_aliasing.h"
#include "metrics/aliasing/temporal_aliasing.h"
#include "tests/metrics/aliasing/analytic_pictures.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fernlicht {
namespace {

/// One track for each pixel of a row of `width`, moving by `speed_px` a frame where it stays within.
std::vector<PixelTrack> tracks_along_x(int width, int frames, double speed_px) {
    std::vector<PixelTrack> tracks;
    for (int x = 0; x < width; ++x) {
        PixelTrack track;
        for (int t = 0; t < frames; ++t)
            track.push_back(static_cast<std::int32_t>(std::floor(x + 0.5 + speed_px * t)));
        if (track.back() < width)
            tracks.push_back(track);
    }
    return tracks;
}

TEST(TemporalAliasing, WhatStandsStillReadsExactlyNothing) {
    const Image<double> still(64, 1, 0.1);
    const TemporalAliasing found = measure_temporal_aliasing(std::vector(12, still), std::vector(12, Image<double>(64, 1, 1.0F)),
                                                             tracks_along_x(64, 12, 0.0), rate_hz, ppd);
    EXPECT_EQ(found.tracks, 64U);
    EXPECT_EQ(found.crawl_percent, 0.0);
    EXPECT_EQ(found.flicker_percent, 0.0);
    EXPECT_EQ(found.visible, 0.0);
}

TEST(TemporalAliasing, WhatTheSceneCarriesAlongReadsNothing) {
    std::vector<Image<double>> residues;
    for (int t = 0; t < 12; ++t) {
        residues.emplace_back(64, 1);
        for (int x = 0; x < 64; ++x)
            residues.back().at(x, 0) = std::sin(1.7 * (x - 2 * t));
    }
    const std::vector<Image<double>> levels(12, Image<double>(64, 1, 1.0F));
    EXPECT_LT(measure_temporal_aliasing(residues, levels, tracks_along_x(64, 12, 2.0), rate_hz, ppd).flicker_percent, 1e-12);
    EXPECT_GT(measure_temporal_aliasing(residues, levels, tracks_along_x(64, 12, 0.0), rate_hz, ppd).flicker_percent, 60.0);
}

TEST(TemporalAliasing, AFlickerReadsItsContrastAndItsFrequency) {
    constexpr int frames = 32;
    for (const double hertz : {2.0, 9.0}) {
        std::vector<Image<double>> residues;
        for (int t = 0; t < frames; ++t)
            residues.emplace_back(8, 1, 0.04 * std::cos(2.0 * pi * hertz * t / rate_hz + 0.3));
        const TemporalAliasing found = measure_temporal_aliasing(residues, std::vector(frames, Image<double>(8, 1, 2.0F)),
                                                                 tracks_along_x(8, frames, 0.0), rate_hz, ppd);
        const double expected = 100.0 * 0.02 / std::sqrt(2.0);
        // A Hann window gives the neighbours a quarter of the peak's power each; 2 % for the mean under the window at 2 Hz.
        EXPECT_NEAR((hertz < 4.0 ? *found.crawl_percent : found.flicker_percent) / expected, 1.0, 0.02);
        EXPECT_LT(hertz < 4.0 ? found.flicker_percent : *found.crawl_percent, 0.02 * expected);
        const auto peak = std::ranges::max_element(found.spectrum, {}, &FlickerBand::contrast_percent);
        EXPECT_EQ(peak->hertz, hertz);
        const double weighed = (4.0 * std::pow(flicker_sensitivity(5.0, hertz), 2) + std::pow(flicker_sensitivity(5.0, hertz - 1.0), 2) +
                                std::pow(flicker_sensitivity(5.0, hertz + 1.0), 2)) /
                               6.0;
        EXPECT_NEAR(found.visible / (0.02 * std::sqrt(weighed)), 1.0, 0.02);
    }
}

/// The integral of sin(t) / t from 0 to x, by Simpson's rule.
double sine_integral(double x) {
    const auto sinc = [](double t) { return t == 0.0 ? 1.0 : std::sin(t) / t; };
    const int steps = 2 * (8 + static_cast<int>(std::abs(x) * 8.0));
    const double h = x / steps;
    double sum = sinc(0.0) + sinc(x);
    for (int i = 1; i < steps; ++i)
        sum += (i % 2 == 1 ? 4.0 : 2.0) * sinc(h * i);
    return sum * h / 3.0;
}

TEST(TemporalAliasing, AMovingStepFlickersByItsClosedForm) {
    constexpr int width = 200, frames = 64;
    constexpr double speed_px = 0.6180339887498949; // no fraction: every position within a pixel comes up alike
    std::vector<Image<double>> residues;
    for (int t = 0; t < frames; ++t) {
        residues.emplace_back(width, 1);
        for (int x = 0; x < width; ++x) {
            const double from_edge = x + 0.5 - 60.25 - speed_px * t;
            residues.back().at(x, 0) = (from_edge > 0.0 ? 1.0 : 0.0) - 0.5 - sine_integral(pi * from_edge) / pi;
        }
    }
    const std::vector<PixelTrack> tracks = tracks_along_x(width, frames, speed_px);
    const TemporalAliasing found =
        measure_temporal_aliasing(residues, std::vector(frames, Image<double>(width, 1, 1.0F)), tracks, rate_hz, ppd);
    // A step less its part below 1/2 cycle per pixel has the spectrum 1 / (2 pi i f) beyond. A point at a distance from it is seen in
    // pixels up to half a pixel away, all alike often: its variance is the mean of the squares less the square of the mean, which is a box
    // filter. Summed over distances: 2 integral from 1/2 of (1 - sinc(f)^2) / (4 pi^2 f^2) df.
    double expected = 0.0;
    for (double f = 0.5005; f < 2000.0; f += 0.001) {
        const double sinc = std::sin(pi * f) / (pi * f);
        expected += 0.001 * 2.0 * (1.0 - sinc * sinc) / (4.0 * pi * pi * f * f);
    }
    const double measured =
        (std::pow(*found.crawl_percent, 2) + std::pow(found.flicker_percent, 2)) * 1e-4 * static_cast<double>(tracks.size());
    EXPECT_NEAR(measured / expected, 1.0, 0.05);
}

TEST(TemporalAliasing, AMovingPictureThatTheDisplayCanShowReadsNothing) {
    constexpr int k = 4, frames = 8;
    const auto texture = [](double x, double y) {
        return 1.0 + 0.3 * std::cos(2.0 * pi * (0.31 * x + 0.12 * y)) + 0.2 * std::cos(2.0 * pi * (0.07 * x - 0.38 * y) + 1.0);
    };
    std::vector<Image<double>> residues;
    std::vector<Image<double>> levels;
    for (int t = 0; t < frames; ++t) {
        const auto moved = [&](double x, double y) { return texture(x - 0.37 * t, y); };
        const SpatialAliasing found = measure_spatial_aliasing(drawn(96, 96, 1, moved), split_bands(drawn(96, 96, k, moved), k), ppd);
        residues.push_back(found.aliasing_picture);
        levels.push_back(found.level_picture);
    }
    std::vector<PixelTrack> tracks;
    for (std::int32_t y = 32; y < 64; ++y) // away from the edges, where the picture is mirrored
        for (int x = 32; x < 60; ++x) {
            tracks.emplace_back();
            for (int t = 0; t < frames; ++t)
                tracks.back().push_back(y * 96 + static_cast<std::int32_t>(std::floor(x + 0.5 + 0.37 * t)));
        }
    const TemporalAliasing found = measure_temporal_aliasing(residues, levels, tracks, rate_hz, ppd);
    // Of a contrast of 25 %: the low pass is flat within 0.2 % there.
    EXPECT_LT(*found.crawl_percent + found.flicker_percent, 0.05);
}

/// Between -1 and 1, alike for alike seeds (Steele, Lea and Flood 2014: SplitMix64).
double noise(std::uint64_t seed) {
    std::uint64_t z = seed * 0x9E3779B97F4A7C15U + 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) / static_cast<double>(1ULL << 52U) - 1.0;
}

TEST(TemporalAliasing, WhatStandsOnTheScreenIsToldApart) {
    constexpr int width = 4000, frames = 16;
    const std::vector<Image<double>> levels(frames, Image<double>(width, 1, 1.0));
    const std::vector<PixelTrack> tracks = tracks_along_x(width, frames, 1.37);
    const auto found = [&](double stands, double changes) {
        std::vector<Image<double>> residues;
        for (std::uint64_t t = 0; t < frames; ++t) {
            residues.emplace_back(width, 1);
            for (std::uint64_t x = 0; x < width; ++x)
                residues.back().pixels()[x] = stands * noise(x) + changes * noise(width * (t + 1) + x);
        }
        return measure_temporal_aliasing(residues, levels, tracks, rate_hz, ppd);
    };
    const TemporalAliasing stands = found(0.1, 0.0), changes = found(0.0, 0.1), both = found(0.1, 0.1);
    EXPECT_NEAR(*stands.standing_percent / stands.flicker_percent, 1.0, 1e-9);
    // Some 4000 tracks of 7 free values each: a standard error of 1 % of the square, whose root is a tenth.
    EXPECT_LT(*changes.standing_percent / changes.flicker_percent, 0.15);
    EXPECT_NEAR(*both.standing_percent / stands.flicker_percent, 1.0, 0.03);
    EXPECT_NEAR(both.flicker_percent / std::hypot(stands.flicker_percent, changes.flicker_percent), 1.0, 0.03);
}

TEST(TemporalAliasing, RefusesWhatDoesNotFit) {
    const std::vector<Image<double>> residues(8, Image<double>(4, 4));
    const std::vector<Image<double>> levels(8, Image<double>(4, 4));
    const auto measured = [&](const std::vector<PixelTrack>& tracks, double rate) {
        return measure_temporal_aliasing(residues, levels, tracks, rate, ppd);
    };
    EXPECT_EQ(measured({}, 30.0).tracks, 0U);
    EXPECT_THROW(measured({PixelTrack(7, 0)}, 30.0), std::invalid_argument);
    EXPECT_THROW(measured({PixelTrack(8, 16)}, 30.0), std::invalid_argument);
    EXPECT_THROW(measured({}, 0.0), std::invalid_argument);
    EXPECT_THROW(measure_temporal_aliasing({}, {}, {}, 30.0, ppd), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
