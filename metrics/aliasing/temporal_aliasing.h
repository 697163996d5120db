// What aliasing does over time: the brightness that a point of the scene gains and loses from frame to frame though nothing about it
// changes.
#pragma once

#include "scenarios/values/image.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace fernlicht {

/// Where a point of the scene is seen: the pixel (y * width + x) that shows it in each frame, one entry a frame.
using PixelTrack = std::vector<std::int32_t>;

struct FlickerBand {
    double hertz = 0.0;
    double contrast_percent = 0.0; ///< r.m.s. over tracks, of this frequency alone
};

struct TemporalAliasing {
    std::size_t tracks = 0;
    std::optional<double> crawl_percent; ///< r.m.s. contrast below 4 Hz, where eyes see a pattern that moves; nullopt: not told apart from
                                         ///< light that changes
    double flicker_percent = 0.0;        ///< from 4 Hz up to half the frame rate, where they see it flicker (Kulikowski and Tolhurst 1973)
    /// Of flicker: what points of the scene meet as they pass a pattern that stands still on the screen. An eye that follows the screen
    /// sees it stand, one that follows the road sees it flicker. nullopt: not told apart.
    std::optional<double> standing_percent;
    /// Both in multiples of the contrast that an eye just sees: sqrt(sum (modulation * sensitivity)^2), r.m.s. over tracks.
    double visible = 0.0;
    std::vector<FlickerBand> spectrum;
};

/// The brightness of one point in each frame, and the luminance that contrast is taken to, cd/m2.
struct TrackSamples {
    std::vector<double> values;
    double level = 0.0;
};

inline constexpr double crawl_below_hz = 4.0;

/// Gratings whose contrast goes up and down. Kelly (1979), Motion and vision II, J. Opt. Soc. Am. 69, 1340-1349, with a = 2 pi u and
/// v = f / u: S = (6.1 + 7.3 |log10(v / 3)|^3) v a^2 exp(-2 a (v + 2) / 45.9). Measured by day: an eye adapted to a road at night sees less
/// of fast flicker. u > 0 in cycles per degree, f > 0 in Hz; 0 at f = 0. Throws std::invalid_argument for others.
double flicker_sensitivity(double cycles_per_degree, double hertz);

/// `aliasing`: what of each frame is not there; `levels`: the luminance that contrast is taken to (aliasing_picture and level_picture of
/// SpatialAliasing). Along each track the residue less its weighted mean, under a Hann window, goes through a discrete Fourier
/// transform. Sensitivity is flicker_sensitivity() at a quarter of pixels_per_degree, half way to the display's limit. What is carried
/// along by the scene, and a scene that stands still, reads exactly 0. What stands on the screen is told by taking from each pixel its mean
/// over the other frames: what is left of flicker, 1 + 1 / (frames - 1) times as strong in its square, is what does not stand. At least 8
/// frames of one size, tracks of as many entries within them. Throws std::invalid_argument otherwise.
TemporalAliasing measure_temporal_aliasing(const std::vector<Image<double>>& aliasing, const std::vector<Image<double>>& levels,
                                           const std::vector<PixelTrack>& tracks, double rate_hz, double pixels_per_degree);

/// The same of brightness itself, without a reference: each track less its straight line over time, which light does that comes nearer.
/// Slower changes of light are not told apart from crawl, so there is none, and no spectrum below 4 Hz; what stands on the screen is not
/// told apart either. As many values in each, at least 8. Throws std::invalid_argument otherwise.
TemporalAliasing measure_flicker(const std::vector<TrackSamples>& tracks, double rate_hz, double pixels_per_degree);

} // namespace fernlicht
