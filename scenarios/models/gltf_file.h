// A glTF file taken apart: its JSON, the bytes that its buffers hold, and the tree of its nodes, walked once with every node's place.
#pragma once

#include "scenarios/values/files.h"

#include <functional>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace fernlicht {

/// A value of a glTF file's JSON and the way to it: every refusal names file, way, what was found and what was expected.
/// Points into the JSON and the path it was made from; both must outlive it.
class GltfEntry {
  public:
    GltfEntry(const nlohmann::json& value, const std::filesystem::path& file, std::string way)
        : value_(&value), file_(&file), way_(std::move(way)) {}

    const nlohmann::json& value() const { return *value_; }
    const std::string& way() const { return way_; }
    [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;
    [[noreturn]] void refuse(const std::string& expected) const; ///< found: a description of the value itself

    bool is_object() const;
    std::optional<GltfEntry> find(std::string_view key) const; ///< nullopt: not given. Refuses where this is no object
    GltfEntry require(std::string_view key) const;
    std::vector<GltfEntry> list(std::string_view key) const; ///< empty where it is not given
    std::size_t list_size(std::string_view key) const;
    GltfEntry at(std::string_view key, std::size_t index) const; ///< a member of a list that is long enough

    std::string text() const;
    std::string text_or(std::string_view key, const std::string& otherwise) const;
    double number() const; ///< finite
    double number_or(std::string_view key, double otherwise) const;
    bool flag_or(std::string_view key, bool otherwise) const;
    /// Exactly so many finite numbers.
    std::vector<double> numbers(std::size_t count) const;
    std::size_t whole(std::size_t most) const;
    std::size_t whole_or(std::string_view key, std::size_t otherwise, std::size_t most) const;
    std::optional<GltfEntry> extension(std::string_view name) const; ///< of this object
    /// An index into a list of `count`; `what` names it: "accessors".
    std::size_t index(std::size_t count, std::string_view what) const;

  private:
    const nlohmann::json* value_;
    const std::filesystem::path* file_;
    std::string way_;
};

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
