// The bodies of road users as meshes.
#pragma once

#include "scenarios/traffic/road_user.h"
#include "scenarios/values/files.h"
#include "scenarios/values/scene.h"

#include <span>

namespace fernlicht {

/// Adds the meshes of each road user in its own frame, with Mesh::body its index: of its model file, else a body of our own by kind and
/// size (scenarios/models/road_user_bodies.h) in one of six paints, by its name; `dressed`: with details. What users have in common is
/// added once, each file read once and added to `opened`. Nothing for no users. Throws InputError for a model that cannot be read.
void add_road_users(Scene& scene, std::span<const RoadUser> users, FilesRead& opened, bool dressed = false);

} // namespace fernlicht
