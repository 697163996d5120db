// From a road network to triangles that light can fall on.
#pragma once

#include "scenarios/roads/road_network.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

struct RoadMeshOptions {
    double chord_error_m = 0.005; ///< greatest distance between the surface and its triangles
    double chunk_length_m = 60.0; ///< a mesh's extent along the road
    double verge_width_m = 30.0;  ///< terrain beside the outermost lane on each side
};

/// Surface with marks as materials of their own strips (no overlapping geometry), verge and terrain, objects, signal boards with posts.
Scene build_scene(const RoadNetwork& network, const RoadMeshOptions& options = {});

/// The materials that build_scene uses, by name: asphalt, concrete, marking-white, marking-yellow, verge, terrain, kerb, post, board, object ...
std::vector<Material> road_materials();

} // namespace fernlicht
