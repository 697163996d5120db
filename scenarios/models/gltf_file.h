// A glTF file taken apart: its JSON and the bytes that its buffers hold.
// The tree of a glTF file's nodes, walked once with every node's place.
#pragma once

#include "scenarios/models/gltf_entry.h"
#include "scenarios/values/files.h"

#include <functional>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

namespace fernlicht {

struct GltfFile {
    std::filesystem::path path;
    nlohmann::json json;              ///< as of glTF 2.0, whatever the file's version
    std::string binary;               ///< of a .glb: its second chunk
    std::vector<std::string> buffers; ///< by index
    std::vector<std::string> notes;
    FilesRead opened;

    GltfEntry root() const { return {json, path, ""}; }
    /// The bytes that a `uri` means: data in base64, or a file beside or below this one. Throws InputError.
    std::string at_uri(const GltfEntry& uri);
};

/// Reads container, JSON and all buffers; indices between the JSON's parts are left to whoever follows them. Throws InputError.
GltfFile open_gltf(const std::filesystem::path& path);

/// A glTF 1.0 document in the words of 2.0: names become indices, the "diffuse" of materials a base colour. `notes` gets what is lost.
nlohmann::json upgraded_gltf1(const nlohmann::json& old, const std::filesystem::path& file, std::vector<std::string>& notes);

/// Calls visit(node, world from node) for each node of the file's scene (of all nodes without a parent where it has no scene), parents
/// first, in the file's axes. Throws InputError for cycles, nodes with two parents, and transforms that are not finite.
void walk_nodes(const GltfEntry& root, const std::function<void(const GltfEntry& node, const glm::dmat4& world)>& visit);

} // namespace fernlicht
