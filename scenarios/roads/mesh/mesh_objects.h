// What stands beside and over a road: objects and signals.
// Simple solids that stand on the ground: posts, boxes, extruded outlines, trees.
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

/// A cylinder of 12 sides about the pose's up axis from its position upwards, with a lid.
void append_post(MeshBuilder& builder, RoadMaterial material, const Pose& foot, double radius_m, double height_m);

/// Length along the pose's x, width along y, the pose in the middle of the bottom face. Materials may differ on the face towards +x.
void append_box(MeshBuilder& builder, const Pose& foot, const glm::dvec3& size_m, RoadMaterial material, RoadMaterial front);

/// A corner of an outline in the pose's frame: where its wall stands, and how high it is.
struct Corner {
    glm::dvec3 base_m{0.0};
    double height_m = 0.0;
};

/// Walls between the corners, and a roof over them if the outline is closed. Open outlines are walls seen from both sides. Outlines
/// that cross themselves or have more than 2000 corners get no roof.
void append_extrusion(MeshBuilder& builder, RoadMaterial material, const Pose& foot, const std::vector<Corner>& outline, bool closed);

/// A trunk and a crown of two eight-sided cones, base to base: 0.25 of the height free below the crown (a bush: none).
void append_tree(MeshBuilder& builder, const Pose& foot, double height_m, double crown_radius_m, bool bush);

/// A delineator post as beside German roads: 0.12 m wide, 1 m high, reflecting bands from 0.68 to 0.86 m on both faces along x.
void append_delineator(MeshBuilder& builder, const Pose& foot, double height_m);

/// Corner indices of the triangles of a simple polygon in plan, by clipping ears; empty if it crosses itself.
std::vector<std::array<std::size_t, 3>> triangulated(const std::vector<glm::dvec3>& polygon);

} // namespace fernlicht
