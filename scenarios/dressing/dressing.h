// Houses, trees, barriers and parked cars in place of a road's plain objects, and what belongs beside such a road.
#pragma once

#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/roads/road_network.h"
#include "scenarios/roads/route.h"
#include "scenarios/roads/signal_faces.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

struct DressingSettings {
    bool textures = true;
    std::uint64_t seed = 1;
    /// The smallest angle of a pixel in any view. Where the route comes no nearer than an error over it, the coarser level of detail
    /// stands: its silhouette is within a pixel of the finer one's from everywhere on the route.
    double pixel_rad = 0.7e-3;
    std::map<std::pair<std::string, std::string>, SignalFace> faces = {}; ///< of signals; those that are not here are white
};

/// Whether add_dressing() builds this object: buildings, trees and bushes, crash barriers, and cars, vans, trucks and buses that stand as
/// boxes. Objects with an outline of their own are none of these.
bool is_dressed(const RoadObject& object);

/// Has build_scene() leave to add_dressing() what that builds, and lay gravel, meadows and fields beside roads. The scene's
/// materials are then not complete before add_dressing(), which is to be called next. `mirrored`: of a network seen in a mirror.
void dress_ground(RoadMeshOptions& options, bool mirrored = false);

/// Adds all dressed objects of the network, each in the box of its plain shape and a mesh (two for a tree) of its own, named by name and
/// id; crash barriers a mesh each 60 m. Besides, where lanes leave room: a hedge or a fence before every other house, pedestrians on
/// sidewalks. Nothing of that stands on what vehicles may use. Everything is drawn from the seed, road, object's id and place.
void add_dressing(Scene& scene, const RoadNetwork& network, const Route& route, const DressingSettings& settings);

/// Names of meshes of `scene`, from the `first` on, that stand between a lamp of a car on the route (0.65 m up, 0.6 m to either side) and
/// the own lane 10 to 150 m before it: where they do, readings of illuminance are theirs as well. By rays every 8 m of the route and 10 m
/// of the lane, to its centre and 1.5 m beside it.
std::vector<std::string> shades_of_lane(const Scene& scene, const Route& route, std::size_t first = 0);

} // namespace fernlicht
