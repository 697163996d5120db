// What stands beside and over a road: objects and signals.
#pragma once

#include "scenarios/roads/mesh/mesh_builder.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/mesh_surface.h"

#include <vector>

namespace fernlicht {

/// Objects of one road: trees, posts, delineators, extruded outlines and boxes. All stand upright (world z) at their heading, turned
/// by their own pitch and roll; a size of 0 gets a default for trees and posts, 0.1 m for a box's length or width.
/// Left out: what lies flat on the road (crosswalks, parking spaces, painted marks, patches: they would lie in the surface and
/// flicker), boxes without height, and bridges and tunnels, whose own surfaces OpenDRIVE does not describe.
/// One mesh for each kind of object and chunk: "tree, road 12 s 120-180".
void append_objects(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan, const RoadMeshOptions& options);

/// Signals of one road, one mesh each ("signal 44"): a retroreflecting board with a dull back, facing the traffic it is for, on a post
/// of 76 mm behind it; over paved lanes without post. The bottom edge is at zOffset, or 2 m up where that is not above 0;
/// boards without size are 0.6 m square. Traffic lights are dark housings, 0.3 m by 0.9 m, without light of their own.
void append_signals(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan);

/// Corner indices of the triangles of a simple polygon in plan, by clipping ears; empty if it crosses itself.
std::vector<std::array<std::size_t, 3>> triangulated(const std::vector<glm::dvec3>& polygon);

} // namespace fernlicht
