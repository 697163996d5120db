#include "scenarios/models/model.h"

#include "scenarios/values/version.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using OrderedJson = nlohmann::ordered_json;

template <class T> void put(std::string& bytes, const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(T)); }

class GlbWriting {
  public:
    explicit GlbWriting(const Model& model, const std::vector<std::string>& pictures) : model_(model), pictures_(pictures) {
        json_["asset"] = {{"version", "2.0"}, {"generator", std::string("fernlicht ") + program_version}};
        json_["scene"] = 0;
        for (const char* key : {"scenes", "nodes", "meshes", "materials", "accessors", "bufferViews"})
            json_[key] = OrderedJson::array();
    }

    std::string written() {
        add_pictures();
        for (const Material& material : model_.materials)
            add_material(material);
        OrderedJson nodes = OrderedJson::array();
        for (const Mesh& mesh : model_.meshes)
            nodes.push_back(add_mesh(mesh));
        for (const Mount& mount : model_.mounts)
            nodes.push_back(add_mount(mount));
        json_["scenes"].push_back({{"nodes", nodes}});
        json_["buffers"] = {{{"byteLength", binary_.size()}}};
        std::string text = json_.dump(-1, ' ', false, OrderedJson::error_handler_t::replace), out = "glTF";
        text.append((4 - text.size() % 4) % 4, ' ');
        put(out, std::uint32_t{2});
        put(out, static_cast<std::uint32_t>(28 + text.size() + binary_.size()));
        put(out, static_cast<std::uint32_t>(text.size()));
        out += "JSON" + text;
        put(out, static_cast<std::uint32_t>(binary_.size()));
        return out + std::string("BIN\0", 4) + binary_;
    }

  private:
    std::size_t add_view(const std::string& bytes) {
        json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
        binary_ += bytes;
        binary_.append((4 - binary_.size() % 4) % 4, '\0');
        return json_["bufferViews"].size() - 1;
    }
    std::size_t add_accessor(const std::string& bytes, int component, std::size_t count, const char* type) {
        json_["accessors"].push_back({{"bufferView", add_view(bytes)}, {"componentType", component}, {"count", count}, {"type", type}});
        return json_["accessors"].size() - 1;
    }

    void add_pictures() {
        textures_.assign(model_.textures.size(), -1);
        for (std::size_t i = 0; i < std::min(pictures_.size(), textures_.size()); ++i) {
            if (pictures_[i].empty())
                continue;
            json_["images"].push_back({{"name", model_.textures[i].name},
                                       {"mimeType", pictures_[i].starts_with("\x89PNG") ? "image/png" : "image/jpeg"},
                                       {"bufferView", add_view(pictures_[i])}});
            json_["textures"].push_back({{"source", json_["images"].size() - 1}});
            textures_[i] = static_cast<int>(json_["textures"].size()) - 1;
        }
    }

    void add_material(const Material& material) {
        OrderedJson entry = {{"name", material.name}};
        const glm::vec3& a = material.albedo;
        OrderedJson pbr = {{"baseColorFactor", {a.r, a.g, a.b, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
        if (material.texture >= 0 && textures_[static_cast<std::size_t>(material.texture)] >= 0)
            pbr["baseColorTexture"] = {{"index", textures_[static_cast<std::size_t>(material.texture)]}};
        entry["pbrMetallicRoughness"] = std::move(pbr);
        if (material.retro_rl > 0.0F)
            entry["extras"] = {{"retro_rl", material.retro_rl},
                               {"retro_reference_rad", material.retro_reference_rad},
                               {"retro_falloff_rad", material.retro_falloff_rad},
                               {"retro_rgb", {material.retro_rgb.r, material.retro_rgb.g, material.retro_rgb.b}}};
        json_["materials"].push_back(std::move(entry));
    }

    std::size_t add_mesh(const Mesh& mesh) {
        std::string positions, normals, uvs;
        glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
        for (const Vertex& vertex : mesh.vertices) {
            const glm::vec3 p(to_gltf_axes(vertex.position_m));
            put(positions, p);
            put(normals, glm::vec3(to_gltf_axes(vertex.normal)));
            put(uvs, vertex.uv);
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const std::size_t count = mesh.vertices.size();
        const std::size_t position = add_accessor(positions, 5126, count, "VEC3");
        json_["accessors"][position]["min"] = {low.x, low.y, low.z};
        json_["accessors"][position]["max"] = {high.x, high.y, high.z};
        const std::size_t normal = add_accessor(normals, 5126, count, "VEC3"), uv = add_accessor(uvs, 5126, count, "VEC2");
        OrderedJson primitives = OrderedJson::array();
        for (const Batch& batch : mesh.batches) {
            std::string indices;
            for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i)
                put(indices, mesh.indices[i]);
            primitives.push_back({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}},
                                  {"indices", add_accessor(indices, 5125, batch.count, "SCALAR")},
                                  {"material", batch.material}});
        }
        json_["meshes"].push_back({{"name", mesh.name}, {"primitives", std::move(primitives)}});
        const glm::dvec3 at = to_gltf_axes(mesh.origin_m);
        json_["nodes"].push_back({{"name", mesh.name}, {"mesh", json_["meshes"].size() - 1}, {"translation", {at.x, at.y, at.z}}});
        return json_["nodes"].size() - 1;
    }

    std::size_t add_mount(const Mount& mount) {
        const glm::dvec3 at = to_gltf_axes(mount.pose.position_m);
        // Columns: glTF's x is our left, y our up, z our forward.
        const glm::dquat turn =
            glm::quat_cast(glm::dmat3(to_gltf_axes(mount.pose.left()), to_gltf_axes(mount.pose.up()), to_gltf_axes(mount.pose.forward())));
        json_["nodes"].push_back(
            {{"name", mount.name}, {"translation", {at.x, at.y, at.z}}, {"rotation", {turn.x, turn.y, turn.z, turn.w}}});
        return json_["nodes"].size() - 1;
    }

    const Model& model_;
    const std::vector<std::string>& pictures_;
    OrderedJson json_;
    std::string binary_;
    std::vector<int> textures_; ///< of the file, by texture of the model
};

} // namespace

std::string glb_of(const Model& model, const std::vector<std::string>& pictures) { return GlbWriting(model, pictures).written(); }

} // namespace fernlicht
