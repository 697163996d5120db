#include "scenarios/models/gltf_file.h"

#include "scenarios/values/errors.h"

#include <map>

namespace fernlicht {
namespace {

using Json = nlohmann::json;

/// Names of the parts of one kind, in the order of the new list.
using Indices = std::map<std::string, std::size_t>;

/// `kind` as a list, and where each name went.
Json listed(const GltfEntry& root, const char* kind, Indices& indices) {
    Json list = Json::array();
    const auto parts = root.find(kind);
    if (!parts)
        return list;
    if (!parts->is_object())
        parts->refuse("an object of named parts, as glTF 1.0 has them");
    for (const auto& [name, part] : parts->value().items()) {
        indices.emplace(name, list.size());
        list.push_back(part);
    }
    return list;
}

/// Puts an index where a name stands. A name that is not known becomes an index that does not exist, which is refused in its turn.
void by_index(Json& object, const char* key, const Indices& indices) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_string())
        return;
    const auto known = indices.find(object[key].get<std::string>());
    object[key] = known == indices.end() ? indices.size() : known->second;
}

void all_by_index(Json& object, const char* key, const Indices& indices) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_array())
        return;
    for (Json& name : object[key])
        if (name.is_string()) {
            const auto known = indices.find(name.get<std::string>());
            name = known == indices.end() ? indices.size() : known->second;
        }
}

/// The diffuse colour or texture of a technique's values, or of KHR_materials_common.
Json upgraded_material(const Json& old, const Indices& textures) {
    Json fresh = Json::object();
    if (old.is_object() && old.contains("name"))
        fresh["name"] = old["name"];
    const Json* values = nullptr;
    if (old.is_object() && old.contains("values"))
        values = &old["values"];
    if (const Json::json_pointer common("/extensions/KHR_materials_common/values"); old.is_object() && old.contains(common))
        values = &old[common];
    if (!values || !values->is_object() || !values->contains("diffuse"))
        return fresh;
    Json& pbr = fresh["pbrMetallicRoughness"] = Json::object();
    const Json& diffuse = (*values)["diffuse"];
    if (diffuse.is_string()) {
        pbr["baseColorTexture"]["index"] = diffuse;
        by_index(pbr["baseColorTexture"], "index", textures);
    } else {
        pbr["baseColorFactor"] = diffuse;
    }
    return fresh;
}

} // namespace

nlohmann::json upgraded_gltf1(const nlohmann::json& old, const std::filesystem::path& file, std::vector<std::string>& notes) {
    const GltfEntry root(old, file, "");
    Indices buffers, views, accessors, images, samplers, textures, materials, meshes, nodes, scenes;
    Json fresh = {{"asset", {{"version", "2.0"}}}};
    fresh["buffers"] = listed(root, "buffers", buffers);
    fresh["bufferViews"] = listed(root, "bufferViews", views);
    fresh["accessors"] = listed(root, "accessors", accessors);
    fresh["images"] = listed(root, "images", images);
    fresh["samplers"] = listed(root, "samplers", samplers);
    fresh["textures"] = listed(root, "textures", textures);
    fresh["materials"] = listed(root, "materials", materials);
    fresh["meshes"] = listed(root, "meshes", meshes);
    fresh["nodes"] = listed(root, "nodes", nodes);
    fresh["scenes"] = listed(root, "scenes", scenes);
    for (Json& view : fresh["bufferViews"])
        by_index(view, "buffer", buffers);
    for (Json& accessor : fresh["accessors"]) {
        by_index(accessor, "bufferView", views);
        if (accessor.is_object() && accessor.contains("byteStride")) { // of the accessor in 1.0, of the buffer view in 2.0
            accessor["stride1"] = accessor["byteStride"];
            accessor.erase("byteStride");
        }
    }
    for (Json& texture : fresh["textures"]) {
        by_index(texture, "source", images);
        by_index(texture, "sampler", samplers);
    }
    for (Json& material : fresh["materials"])
        material = upgraded_material(material, textures);
    for (Json& mesh : fresh["meshes"])
        if (mesh.is_object() && mesh.contains("primitives") && mesh["primitives"].is_array())
            for (Json& primitive : mesh["primitives"]) {
                by_index(primitive, "indices", accessors);
                by_index(primitive, "material", materials);
                if (primitive.is_object() && primitive.contains("attributes") && primitive["attributes"].is_object())
                    for (auto& [name, attribute] : primitive["attributes"].items())
                        by_index(primitive["attributes"], name.c_str(), accessors);
            }
    for (Json& node : fresh["nodes"]) {
        all_by_index(node, "children", nodes);
        all_by_index(node, "meshes", meshes); // several in 1.0; read as they are
    }
    for (Json& scene : fresh["scenes"])
        all_by_index(scene, "nodes", nodes);
    if (old.contains("scene"))
        fresh["scene"] = old["scene"];
    by_index(fresh, "scene", scenes);
    for (const char* kind : {"animations", "skins", "cameras"})
        if (old.contains(kind) && old[kind].is_object() && !old[kind].empty())
            fresh[kind] = Json::array({Json::object()});
    notes.push_back("glTF 1.0: of its materials the diffuse colour or texture was taken; techniques, programs and shaders are left out");
    return fresh;
}

} // namespace fernlicht
