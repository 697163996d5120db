// From a road network to triangles that light can fall on.
#pragma once

#include "scenarios/roads/road_network.h"
#include "scenarios/roads/road_surface.h"
#include "scenarios/values/scene.h"

#include <cstdint>
#include <functional>

namespace fernlicht {

/// What lies beside a road from so far out on: a material of the scene.
using GroundMaterial = std::function<std::uint32_t(const Road& road, bool left, double s_m, double out_m)>;

/// The material of a ditch beside a road from s to s, 1.5 to 5 m out; nullopt: none. Its surface kind is no ground's, so that views show it
/// and maps measure the ground as it would be without it.
using DitchMaterial = std::function<std::optional<std::uint32_t>(const Road& road, bool left, double from_s_m, double to_s_m)>;

struct RoadMeshOptions {
    double chord_error_m = 0.005; ///< greatest distance between the surface and its triangles
    double chunk_length_m = 60.0; ///< a mesh's extent along the road
    double verge_width_m = 30.0;  ///< terrain beside the outermost lane on each side
    bool textures = true;         ///< pictures of asphalt, concrete, grass and worn paint (mesh_materials.h); mean reflectances stay
    std::uint64_t seed = 1;       ///< of the textures
    RoadSurface surface = {};
    /// Objects that are left out, because there are to be none or somebody else builds them. Empty: none are.
    std::function<bool(const RoadObject&)> leave_out = {};
    bool signals = true;        ///< false: left out, because somebody else builds them
    GroundMaterial ground = {}; ///< empty: verge and terrain
    DitchMaterial ditch = {};   ///< empty: none anywhere
};

/// Surface with marks as materials of their own strips (no overlapping geometry), verge and terrain, objects, signal boards with posts.
/// Meshes are called "road 12 s 120-180", "left of road 12 s 120-180" (ground), "trees, road 12 s 120-180", "signal 44".
/// A road's surface has no cracks or T-junctions, within its chunks and between them, and keeps the chord error except where the
/// surface itself jumps (a ramp of 2 cm then). Lane heights rise from record to record; kerbs are vertical faces.
/// In junctions roads lie over one another at one height: what is level with another road's paved surface is asphalt, so that it does
/// not matter which of the two is seen; marks of connecting roads are lost there. Nothing is thrown; the reader has judged the network.
/// Every vertex has its place in a texture (mesh_builder.h: texture_position).
Scene build_scene(const RoadNetwork& network, const RoadMeshOptions& options = {});

/// Where an object stands that is no outline: upright on the road's surface at its place, x along its heading.
Pose standing(const RoadNetwork& network, const Road& road, const RoadObject& object);
/// How far the ground beside a road lies below its edge, so many metres out.
double ground_drop_m(double out_m);

/// The materials that build_scene uses, untextured, by name: asphalt, concrete, kerb, marking-white, marking-yellow, verge, terrain, board,
/// board-back, post, delineator, object, trunk, leaves; with wheel tracks then asphalt-track-0 to 4, the bare lane first.
std::vector<Material> road_materials(const RoadSurface& surface = {});

} // namespace fernlicht
