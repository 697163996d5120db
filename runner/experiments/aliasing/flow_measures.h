// One aliasing of many moments, and what is measured over time along paths by optical flow: with a reference, or without.
#pragma once

#include "metrics/aliasing/optical_flow.h"
#include "metrics/aliasing/spatial_aliasing.h"
#include "runner/experiments/aliasing/aliasing_result.h"

#include <cstddef>
#include <vector>

namespace fernlicht {

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
