// What aliasing does over time: the brightness that a point of the scene gains and loses from frame to frame though nothing about it
// changes.
#pragma once

#include "scenarios/values/image.h"

#include <cstdint>
#include <vector>

namespace fernlicht {

/// Where a point of the scene is seen: the pixel (y * width + x) that shows it in each frame, one entry a frame.
using Track = std::vector<std::int32_t>;

struct FlickerBand {
    double hertz = 0.0;
    double contrast_percent = 0.0; ///< r.m.s. over tracks, of this frequency alone
};

struct TemporalAliasing {
    std::size_t tracks = 0;
    double crawl_percent = 0.0;   ///< r.m.s. contrast below 4 Hz, where eyes see a pattern that moves
    double flicker_percent = 0.0; ///< from 4 Hz up to half the frame rate, where they see it flicker (Kulikowski and Tolhurst 1973)
    double visible =
        0.0; ///< both in multiples of the contrast that an eye just sees: sqrt(sum (modulation * sensitivity)^2), r.m.s. over tracks
    std::vector<FlickerBand> spectrum;
};

inline constexpr double crawl_below_hz = 4.0;

/// `aliasing`: what of each frame is not there; `levels`: the luminance that contrast is taken to (aliasing_picture and level_picture of
/// SpatialAliasing). Along each track the residue less its weighted mean, under a Hann window, goes through a discrete Fourier
/// transform. Sensitivity is flicker_sensitivity() at a quarter of pixels_per_degree, half way to the display's limit. What is carried
/// along by the scene, and a scene that stands still, reads exactly 0. At least 8 frames of one size, tracks of as many entries within
/// them. Throws std::invalid_argument otherwise.
TemporalAliasing measure_temporal_aliasing(const std::vector<Image<double>>& aliasing, const std::vector<Image<double>>& levels,
                                           const std::vector<Track>& tracks, double rate_hz, double pixels_per_degree);

} // namespace fernlicht
