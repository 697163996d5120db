// One moment of a drive as the reference sees it: from the driver's seat and from above, with what each pixel shows of the road.
#pragma once

#include "renderer/reference/reference.h"
#include "renderer/renderer.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/play/extent_fold.h"
#include "runner/play/stage.h"

namespace fernlicht {

/// A view of a moment with its reference. `geometry` is drawn by a rasteriser: depth and ids.
struct ReferenceShot {
    View view;
    ReferenceImage reference;
    Frame geometry;
    Image<float> road_m2; ///< of road surface in the pixel; below 0: the pixel shows none
};

/// m2 of road surface that each pixel of a perspective view shows, by the distances between what neighbouring pixels show; 0 where no
/// neighbour shows the same mesh, -1 where it is no road (carriageway with its marks; not verge and terrain). The frame has depth and ids.
Image<float> road_areas_m2(const Scene& scene, const Moment& moment, const View& view, const Frame& frame);

/// True for meshes of carriageway.
bool is_road(const Scene& scene, std::uint32_t id);

/// The driver's view at another size, with the same field of view upwards.
View resized(View view, int width_px, int height_px);

} // namespace fernlicht
