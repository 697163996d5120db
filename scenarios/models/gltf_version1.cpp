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
void to_index(Json& name, const Indices& indices) {
    if (!name.is_string())
        return;
    const auto known = indices.find(name.get<std::string>());
    name = known == indices.end() ? indices.size() : known->second;
}

void by_index(Json& object, const char* key, const Indices& indices) {
    if (object.is_object() && object.contains(key))
        to_index(object[key], indices);
}

void all_by_index(Json& object, const char* key, const Indices& indices) {
    if (object.is_object() && object.contains(key) && object[key].is_array())
        for (Json& name : object[key])
            to_index(name, indices);
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
    std::map<std::string, Indices> named;
    Json fresh = {{"asset", {{"version", "2.0"}}}};
    for (const char* kind :
         {"buffers", "bufferViews", "accessors", "images", "samplers", "textures", "materials", "meshes", "nodes", "scenes"})
        fresh[kind] = listed(root, kind, named[kind]);
    for (Json& view : fresh["bufferViews"])
        by_index(view, "buffer", named["buffers"]);
    for (Json& accessor : fresh["accessors"]) {
        by_index(accessor, "bufferView", named["bufferViews"]);
        if (accessor.is_object() && accessor.contains("byteStride")) { // of the accessor in 1.0, of the buffer view in 2.0
            accessor["stride1"] = accessor["byteStride"];
            accessor.erase("byteStride");
        }
    }
    for (Json& texture : fresh["textures"]) {
        by_index(texture, "source", named["images"]);
        by_index(texture, "sampler", named["samplers"]);
    }
    for (Json& material : fresh["materials"])
        material = upgraded_material(material, named["textures"]);
    for (Json& mesh : fresh["meshes"])
        if (mesh.is_object() && mesh.contains("primitives") && mesh["primitives"].is_array())
            for (Json& primitive : mesh["primitives"]) {
                by_index(primitive, "indices", named["accessors"]);
                by_index(primitive, "material", named["materials"]);
                if (primitive.is_object() && primitive.contains("attributes") && primitive["attributes"].is_object())
                    for (Json& attribute : primitive["attributes"])
                        to_index(attribute, named["accessors"]);
            }
    for (Json& node : fresh["nodes"]) {
        all_by_index(node, "children", named["nodes"]);
        all_by_index(node, "meshes", named["meshes"]); // several in 1.0; read as they are
    }
    for (Json& scene : fresh["scenes"])
        all_by_index(scene, "nodes", named["nodes"]);
    if (old.contains("scene"))
        fresh["scene"] = old["scene"];
    by_index(fresh, "scene", named["scenes"]);
    for (const char* kind : {"animations", "skins", "cameras"})
        if (old.contains(kind) && old[kind].is_object() && !old[kind].empty())
            fresh[kind] = Json::array({Json::object()});
    notes.push_back("glTF 1.0: of its materials the diffuse colour or texture was taken; techniques, programs and shaders are left out");
    return fresh;
}

} // namespace fernlicht
