// Where the points of a scene that stands still go in the picture while the car drives, from depth and the car's poses, and which pixels
// show road and marks: without any estimate.
#pragma once

#include "metrics/aliasing/jaggedness.h"
#include "metrics/aliasing/optical_flow.h"
#include "metrics/aliasing/temporal_aliasing.h"
#include "renderer/renderer.h"
#include "scenarios/drives/play/frame.h"

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

} // namespace fernlicht
