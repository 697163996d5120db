// Writes small glTF files for tests: one mesh of triangles in glTF's axes (y up, z forward), with whatever JSON a test adds.
#pragma once

#include <array>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fernlicht::test {

using Json = nlohmann::json;

template <class T> void append_bytes(std::string& bytes, const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(T)); }

/// Positions and indices in one buffer, `scene` with one node.
struct WrittenGltf {
    std::string buffer;
    Json json = {{"asset", {{"version", "2.0"}}}};

    explicit WrittenGltf(const std::vector<std::array<float, 3>>& positions, const std::vector<std::uint32_t>& indices) {
        for (const auto& p : positions)
            append_bytes(buffer, p);
        const std::size_t vertex_bytes = buffer.size();
        for (const std::uint32_t i : indices)
            append_bytes(buffer, i);
        json["bufferViews"] = {{{"buffer", 0}, {"byteLength", vertex_bytes}},
                               {{"buffer", 0}, {"byteOffset", vertex_bytes}, {"byteLength", buffer.size() - vertex_bytes}}};
        json["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", positions.size()}, {"type", "VEC3"}},
                             {{"bufferView", 1}, {"componentType", 5125}, {"count", indices.size()}, {"type", "SCALAR"}}};
        json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
        json["nodes"] = {{{"mesh", 0}}};
        json["scenes"] = {{{"nodes", {0}}}};
        json["scene"] = 0;
    }

    /// A triangle of 1 m: from the origin to the left (glTF's x) and forward (z), facing up.
    static WrittenGltf triangle() { return WrittenGltf({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {0, 1, 2}); }

    void write_glb(const std::filesystem::path& path) const {
        Json whole = json;
        whole["buffers"] = {{{"byteLength", buffer.size()}}};
        std::string text = whole.dump(), binary = buffer, out = "glTF";
        text.append((4 - text.size() % 4) % 4, ' ');
        binary.append((4 - binary.size() % 4) % 4, '\0');
        append_bytes(out, std::uint32_t{2});
        append_bytes(out, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
        append_bytes(out, static_cast<std::uint32_t>(text.size()));
        out += "JSON" + text;
        append_bytes(out, static_cast<std::uint32_t>(binary.size()));
        out += std::string("BIN\0", 4) + binary;
        std::ofstream(path, std::ios::binary) << out;
    }
    /// A .gltf and its .bin beside it.
    void write_gltf(const std::filesystem::path& path) const {
        Json whole = json;
        const std::string name = path.stem().string() + ".bin";
        whole["buffers"] = {{{"byteLength", buffer.size()}, {"uri", name}}};
        std::ofstream(path) << whole.dump(1);
        std::ofstream(path.parent_path() / name, std::ios::binary) << buffer;
    }
};

template <class T> std::string bytes_of(const std::vector<T>& values) {
    return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// A view of these bytes at the end of the buffer, on a boundary of 4.
inline std::size_t add_view(WrittenGltf& file, const std::string& bytes) {
    file.buffer.append((4 - file.buffer.size() % 4) % 4, '\0');
    file.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", file.buffer.size()}, {"byteLength", bytes.size()}});
    file.buffer += bytes;
    return file.json["bufferViews"].size() - 1;
}

inline std::size_t add_accessor(WrittenGltf& file, const std::string& bytes, int component, std::size_t count, const char* type,
                                bool normalized = false) {
    file.json["accessors"].push_back({{"bufferView", add_view(file, bytes)},
                                      {"componentType", component},
                                      {"count", count},
                                      {"type", type},
                                      {"normalized", normalized}});
    return file.json["accessors"].size() - 1;
}

inline Json& attributes(WrittenGltf& file) { return file.json["meshes"][0]["primitives"][0]["attributes"]; }

/// Two triangles of 1 m x 1 m on the ground, texture coordinates from 0 to 1, of material 0.
inline WrittenGltf square() {
    WrittenGltf file({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {0, 1, 2, 0, 2, 3});
    attributes(file)["TEXCOORD_0"] = add_accessor(file, bytes_of<float>({0, 0, 0, 1, 1, 1, 1, 0}), 5126, 4, "VEC2");
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    file.json["materials"] = {{{"name", "leaf"}}};
    return file;
}

inline void give_picture(WrittenGltf& file, const std::string& picture, const char* extension = nullptr) {
    file.json["images"] = {{{"name", "leaves"}, {"mimeType", "image/webp"}, {"bufferView", add_view(file, picture)}}};
    file.json["textures"] = Json::array({extension ? Json{{"extensions", {{extension, {{"source", 0}}}}}} : Json{{"source", 0}}});
    file.json["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}};
}

} // namespace fernlicht::test
