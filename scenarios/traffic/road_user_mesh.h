// The bodies of road users as meshes.
#pragma once

#include "scenarios/traffic/road_user.h"
#include "scenarios/values/scene.h"

#include <span>

namespace fernlicht {

/// Adds the meshes and materials of each road user in its own frame, with Mesh::body its index. Nothing for no users.
void add_road_users(Scene& scene, std::span<const RoadUser> users);

} // namespace fernlicht
