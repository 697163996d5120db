// Simple solids that stand on the ground: posts, boxes, extruded outlines, trees.
#pragma once

#include "scenarios/roads/mesh/mesh_builder.h"
#include "scenarios/roads/mesh/mesh_materials.h"

#include <vector>

namespace fernlicht {

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
