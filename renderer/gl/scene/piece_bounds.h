// Bounds of a piece of a scene, for deciding what can shade what.
#pragma once

#include "renderer/gl/scene/scene_buffers.h"

namespace fernlicht::gl {

/// Corners of an upright box round triangles (three places each) that lies along the world's axes or along their longest edge. Bit 0 of a
/// corner's place in the array says which end along the box, bit 1 which side, bit 2 bottom or top.
Corners box_round(const std::vector<glm::dvec3>& triangles);

/// A box round each body: triangles that share a place belong to one. `triangles` holds three places each.
std::vector<Corners> boxes_round_bodies(const std::vector<glm::dvec3>& triangles);

} // namespace fernlicht::gl
