#include "metrics/aliasing/optical_flow.h"
#include "metrics/aliasing/spatial_aliasing.h"
#include "metrics/aliasing/temporal_aliasing.h"
#include "tests/metrics/aliasing/analytic_pictures.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <tuple>

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

/// Of rows of pixels, all at one level.
TemporalAliasing measured(const std::vector<Image<double>>& residues, const std::vector<PixelTrack>& tracks, double level = 1.0) {
    return measure_temporal_aliasing(residues, std::vector(residues.size(), Image<double>(residues[0].width(), 1, level)), tracks, rate_hz,
                                     ppd);
}

TEST(TemporalAliasing, WhatStandsStillReadsExactlyNothing) {
    const TemporalAliasing found = measured(std::vector(12, Image<double>(64, 1, 0.1)), tracks_along_x(64, 12, 0.0));
    EXPECT_EQ(std::tuple(found.tracks, found.crawl_percent, found.flicker_percent, found.visible), std::tuple(64U, 0.0, 0.0, 0.0));
}

TEST(TemporalAliasing, WhatTheSceneCarriesAlongReadsNothing) {
    std::vector<Image<double>> residues;
    for (int t = 0; t < 12; ++t) {
        residues.emplace_back(64, 1);
        for (int x = 0; x < 64; ++x)
            residues.back().at(x, 0) = std::sin(1.7 * (x - 2 * t));
    }
    EXPECT_LT(measured(residues, tracks_along_x(64, 12, 2.0)).flicker_percent, 1e-12);
    EXPECT_GT(measured(residues, tracks_along_x(64, 12, 0.0)).flicker_percent, 60.0);
}

TEST(TemporalAliasing, AFlickerReadsItsContrastAndItsFrequency) {
    constexpr int frames = 32;
    for (const double hertz : {2.0, 9.0}) {
        std::vector<Image<double>> residues;
        for (int t = 0; t < frames; ++t)
            residues.emplace_back(8, 1, 0.04 * std::cos(2.0 * pi * hertz * t / rate_hz + 0.3));
        const TemporalAliasing found = measured(residues, tracks_along_x(8, frames, 0.0), 2.0);
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
    const TemporalAliasing found = measured(residues, tracks);
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
    const std::vector<PixelTrack> tracks = tracks_along_x(width, frames, 1.37);
    const auto found = [&](double stands, double changes) {
        std::vector<Image<double>> residues;
        for (std::uint64_t t = 0; t < frames; ++t) {
            residues.emplace_back(width, 1);
            for (std::uint64_t x = 0; x < width; ++x)
                residues.back().pixels()[x] = stands * noise(x) + changes * noise(width * (t + 1) + x);
        }
        return measured(residues, tracks);
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

/// Waves in many directions, all below 0.16 cycles per pixel: what any display shows without aliasing. Brightness 0.05 to 0.35 cd/m2.
double waves(double x, double y) {
    double sum = 0.0;
    for (int i = 0; i < 9; ++i) {
        const double f = 0.03 + 0.015 * i, angle = 0.7 * i * i;
        sum += std::cos(2.0 * pi * f * (x * std::cos(angle) + y * std::sin(angle)) + 1.3 * i);
    }
    return 0.2 + 0.15 * sum / 9.0;
}

Image<float> moved(double dx, double dy, int width = 160, int height = 128) {
    return drawn(width, height, 1, [&](double x, double y) { return waves(x - dx, y - dy); });
}

/// Off the known motion, of pixels at least 16 from the edges.
FlowError error_of(const Flow& flow, double dx, double dy) {
    const int width = flow.dx_px.width(), height = flow.dx_px.height();
    Image<std::uint8_t> inside(width, height);
    for (int y = 16; y < height - 16; ++y)
        for (int x = 16; x < width - 16; ++x)
            inside.at(x, y) = 1;
    return flow_error({{flow,
                        Image<std::uint8_t>(width, height, 1),
                        {Image<float>(width, height, static_cast<float>(dx)), Image<float>(width, height, static_cast<float>(dy))},
                        inside}});
}

TEST(OpticalFlow, FindsAKnownMotionWithinATenthOfAPixel) {
    for (const auto& [dx, dy] : {std::pair(0.0, 0.0), std::pair(0.37, -0.21), std::pair(2.6, 1.3), std::pair(-6.25, 3.5)}) {
        const FlowError dis = error_of(optical_flow(moved(0.0, 0.0), moved(dx, dy)), dx, dy);
        EXPECT_LT(dis.mean_px, 0.1) << dx;
        EXPECT_EQ(dis.far_percent, 0.0) << dx;
        EXPECT_NEAR(dis.known_motion_px, std::hypot(dx, dy), 1e-5);
        EXPECT_LT(error_of(optical_flow(moved(0.0, 0.0), moved(dx, dy), FlowMethod::farneback), dx, dy).mean_px, 0.1) << dx;
    }
}

TEST(OpticalFlow, GivesTheSameBytesWhateverTheNumberOfThreads) {
    const int before = cv::getNumThreads();
    const Image<float> a = moved(0.0, 0.0), b = moved(1.7, 0.6);
    for (const FlowMethod method : {FlowMethod::dis, FlowMethod::farneback}) {
        cv::setNumThreads(1);
        const Flow one = optical_flow(a, b, method);
        cv::setNumThreads(2);
        const Flow two = optical_flow(a, b, method);
        EXPECT_EQ(std::tuple(one.dx_px, one.dy_px), std::tuple(two.dx_px, two.dy_px));
    }
    cv::setNumThreads(before);
}

TEST(OpticalFlow, WhatIsHiddenIsNotFoundAgain) {
    // A square that moves by 8 pixels over a ground that stands.
    const auto scene = [](double dx) {
        return drawn(160, 128, 1, [dx](double x, double y) {
            const bool square = std::abs(x - 70.0 - dx) < 20.0 && std::abs(y - 64.0) < 20.0;
            return square ? 2.0 * waves(x - dx + 300.0, y) : waves(x, y);
        });
    };
    const Image<float> a = scene(0.0), b = scene(8.0);
    const Image<std::uint8_t> found = found_again(optical_flow(a, b), optical_flow(b, a), 0.5);
    int hidden = 0, ground = 0;
    for (int y = 50; y < 78; ++y) {
        for (int x = 91; x < 97; ++x) // what the square comes to stand before
            hidden += found.at(x, y);
        for (int x = 20; x < 26; ++x)
            ground += found.at(x, y);
    }
    EXPECT_LT(hidden, 28 * 6 / 4);
    EXPECT_GT(ground, 28 * 6 * 9 / 10);
}

TEST(OpticalFlow, TheDarkHalfOfAPictureIsNotFollowed) {
    // Above row 64 a black sky, without and with a slow glow; below, waves that move.
    for (const double glow : {0.0, 1e-3}) {
        std::vector<Image<float>> frames;
        for (int t = 0; t < 3; ++t)
            frames.push_back(
                drawn(160, 128, 1, [&](double x, double y) { return y < 64.0 ? glow * y / 64.0 : waves(x - 1.2 * t, y - 0.4 * t); }));
        const FlowPaths found = paths_by_flow(frames, 1, 2);
        EXPECT_EQ(found.started, 80U * 64U);
        EXPECT_NEAR(static_cast<double>(found.flat), 30.0 * 80, 80.0) << "32 rows, without those two whose 9 x 9 pixels see the ground";
        EXPECT_GT(found.paths.size(), 80U * 64U * 2 / 5);
        for (const Path& path : found.paths)
            EXPECT_GT(path[1].y, 59.0);
        EXPECT_NEAR(found.median_motion_px, std::hypot(1.2, 0.4), 0.1) << "the ground's, not the sky's";
    }
}

TEST(OpticalFlow, StepsOfRoundingAreNoContrast) {
    // A slow slope in both directions, rounded to steps of 0.01 cd/m2, has edges that stand; waves of six steps have contrast of their own.
    const auto rounded = [](double value) { return 0.01 * std::round(value / 0.01); };
    const Image<float> steps(160, 128, 0.01F);
    const Image<float> slope = drawn(160, 128, 1, [&](double x, double y) {
        return rounded(0.05 + 2e-4 * x + 1e-4 * y + 0.004 * std::sin(0.09 * x) * std::cos(0.11 * y));
    });
    const Image<float> lit = drawn(160, 128, 1, [&](double x, double y) { return rounded(waves(x, y)); });
    const auto share = [](const Image<std::uint8_t>& found) {
        return static_cast<double>(std::ranges::count(found.pixels(), 1)) / static_cast<double>(found.size());
    };
    EXPECT_GT(share(has_contrast(slope)), 0.1);
    EXPECT_LT(share(has_contrast(slope, steps)), 0.02);
    EXPECT_GT(share(has_contrast(lit, steps)), 0.9);
}

/// Sixteen frames, followed by flow; measured without a reference.
TemporalAliasing flicker_of(const std::vector<Image<float>>& frames) {
    return measure_flicker(samples_along(paths_by_flow(frames, frames.size() / 2, 2).paths, frames), rate_hz, ppd);
}

/// A disc that is brighter within, its edge one step (point samples) or a ramp of 4 pixels.
Image<float> drawn_disc(double dx, double ramp_px) {
    return drawn(160, 128, 1, [=](double x, double y) {
        const double from_edge = 40.0 - std::hypot(x - 60.0 - dx, y - 64.0);
        const double inside = ramp_px > 0.0 ? 0.5 + 0.5 * std::sin(pi * std::clamp(from_edge / ramp_px, -0.5, 0.5)) : from_edge > 0.0;
        return (0.2 + 0.8 * inside) * (1.0 + 0.2 * (waves(x - dx, y) - 0.2) / 0.15);
    });
}

TEST(OpticalFlow, AMovingBandLimitedPatternHardlyFlickersAndAnAliasedEdgeDoes) {
    std::vector<Image<float>> pattern, smooth, aliased, still;
    for (int t = 0; t < 16; ++t) {
        pattern.push_back(moved(0.618 * t, 0.27 * t));
        smooth.push_back(drawn_disc(0.618 * t, 4.0));
        aliased.push_back(drawn_disc(0.618 * t, 0.0));
        still.push_back(drawn_disc(0.0, 0.0));
    }
    const TemporalAliasing found = flicker_of(pattern);
    RecordProperty("pattern_flicker_percent", std::to_string(found.flicker_percent));
    EXPECT_GT(found.tracks, 2000U);
    EXPECT_FALSE(found.crawl_percent);
    EXPECT_EQ(found.spectrum.front().hertz, 4.0); // of 2, 4 ... 16
    EXPECT_LT(found.flicker_percent, 1.0);        // of a contrast of 25 %: motion is known to some hundredths of a pixel
    const double without = flicker_of(smooth).flicker_percent, with = flicker_of(aliased).flicker_percent;
    RecordProperty("smooth_flicker_percent", std::to_string(without));
    RecordProperty("aliased_flicker_percent", std::to_string(with));
    EXPECT_GT(with, 4.0 * without);
    EXPECT_EQ(flicker_of(still).flicker_percent, 0.0);
}

TEST(OpticalFlow, RefusesWhatDoesNotFit) {
    const Image<float> small(16, 64, 1.0F), fits(64, 64, 1.0F);
    EXPECT_THROW(optical_flow(small, small), std::invalid_argument);
    EXPECT_THROW(optical_flow(fits, Image<float>(64, 65, 1.0F)), std::invalid_argument);
    EXPECT_THROW(optical_flow(fits, Image<float>(64, 64, std::nanf(""))), std::invalid_argument);
    EXPECT_THROW(paths_by_flow({fits, fits}, 2, 2), std::invalid_argument);
    EXPECT_THROW(measure_flicker({{std::vector<double>(7, 1.0), 1.0}}, rate_hz, ppd), std::invalid_argument);
    const Flow none = optical_flow(Image<float>(64, 64), Image<float>(64, 64)); // two dark pictures: nothing moves
    EXPECT_EQ(none.dx_px, Image<float>(64, 64));
}

} // namespace
} // namespace fernlicht
