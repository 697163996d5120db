// The tree of a glTF file's nodes, walked once with every node's place.
#pragma once

#include "scenarios/models/gltf_file.h"

#include <functional>
#include <glm/mat4x4.hpp>

namespace fernlicht {

/// Calls visit(node, world from node) for each node of the file's scene (of all nodes without a parent where it has no scene), parents
/// first, in the file's axes. Throws InputError for cycles, nodes with two parents, and transforms that are not finite.
void walk_nodes(const GltfEntry& root, const std::function<void(const GltfEntry& node, const glm::dmat4& world)>& visit);

} // namespace fernlicht
