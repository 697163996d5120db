// Where the points of a scene that stands still go in the picture while the car drives, from depth and the car's poses, and which pixels
// show road and marks: without any estimate. What is measured over time along paths by optical flow, with a reference or without, and one
// aliasing of many moments.
#pragma once

#include "renderer/renderer.h"
#include "runner/experiments/aliasing/aliasing_result.h"

namespace fernlicht {

/// For every `stride`-th pixel each way of frame `from` that shows something: the pixels that show the same point in all frames. Points
/// that leave the picture or are hidden (another mesh, or depth off by more than a tenth) in any frame are left out. Frames have depth and
/// ids.
std::vector<PixelTrack> tracks_of(const std::vector<Moment>& moments, const View& view, const std::vector<Frame>& frames, std::size_t from,
                                  int stride);

struct KnownFlow {
    Flow flow;
    Image<std::uint8_t> known; ///< 1: shows something in frame `from` that is seen in `to`, too
};
/// For every pixel of frame `from`, where `to` shows the same point.
KnownFlow known_flow(const std::vector<Moment>& moments, const View& view, const std::vector<Frame>& frames, std::size_t from,
                     std::size_t to);

/// Which pixels show road and which its marks, drawn without any light. Throws DeviceError.
Image<Ground> ground_of(Device& device, const Scene& scene, const Moment& moment, const View& view);

Image<float> floats_of(const Image<double>& picture);

/// What one step of an 8-bit picture's values is worth at these luminances.
Image<float> display_step_cdm2(const Image<float>& displayed);

/// The share of points that must be followed: flicker of fewer says nothing of the picture.
inline constexpr double min_followed = 0.05;

/// Aliasing that is known of each frame, at the pixels nearest to the paths. nullopt where too few were followed.
std::optional<TemporalAliasing> aliasing_along(const FlowPaths& followed, const std::vector<Image<double>>& aliasing,
                                               const std::vector<Image<double>>& levels, double rate_hz, double pixels_per_degree);

/// Changes of brightness itself. nullopt where too few paths were followed.
std::optional<TemporalAliasing> flicker_along(const FlowPaths& followed, const std::vector<Image<float>>& pictures, double rate_hz,
                                              double pixels_per_degree);

/// Numbers: r.m.s. over the moments, at least one. Pictures and the worst place: of the one shown, which is used up.
SpatialAliasing over_moments(std::vector<SpatialAliasing>& found, std::size_t shown);

} // namespace fernlicht
