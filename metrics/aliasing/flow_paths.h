// Points of a scene followed through a sequence of pictures by optical flow.
#pragma once

#include "metrics/aliasing/optical_flow.h"
#include "metrics/aliasing/temporal_aliasing.h"

namespace fernlicht {

/// Pixels with centres at whole numbers.
struct Place {
    double x = 0.0, y = 0.0;
};
/// Where a point is seen in each picture.
using Path = std::vector<Place>;

struct FlowPaths {
    std::vector<Path> paths;
    std::size_t started = 0;       ///< points that were to be followed
    std::size_t flat = 0;          ///< of them, those without contrast, which cannot be
    double median_motion_px = 0.0; ///< from one picture to the next, of the points followed
    double median_return_px = 0.0; ///< how far from the start going there and back ends, of the same
};

/// How far going there and back may end from the start.
inline constexpr double most_return_px = 0.5;

/// Every `stride`-th pixel each way of picture `from`, followed from one picture to the next in both directions of time. Left out is what
/// has_contrast() does not tell in picture `from`, which was rounded by `step_cdm2`, what found_again() does not find within most_return_px
/// at any step, and what leaves the picture: dark, hidden or wrong. Errors of the steps add up along a path. Throws std::invalid_argument
/// as optical_flow() and for `from` beyond the pictures.
FlowPaths paths_by_flow(const std::vector<Image<float>>& pictures, std::size_t from, int stride, FlowMethod method = FlowMethod::dis,
                        const Image<float>& step_cdm2 = {});

/// The pixels nearest to a path's places in pictures of that size, which it stays in.
PixelTrack track_of(const Path& path, int width, int height);

/// Brightness along each path at its places between pixels, by a sinc under a Hann window of 8 pixels to each side, which is within 1 % of
/// what a picture holds up to 0.4 cycles per pixel; the level is the r.m.s. over the 33 x 33 pixels around. Beyond its edges a picture is
/// mirrored. Paths have as many places as there are pictures, within them.
std::vector<TrackSamples> samples_along(const std::vector<Path>& paths, const std::vector<Image<float>>& pictures);

} // namespace fernlicht
