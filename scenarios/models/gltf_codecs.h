// What the module fernlicht-gltf does: it alone is linked with Draco, meshoptimizer and libwebp.
// Each throws std::invalid_argument with a reason for bytes that are damaged, and before it takes memory beyond what it may.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// A mesh of KHR_draco_mesh_compression.
struct DracoMesh {
    struct Attribute {
        std::uint32_t id = 0; ///< Draco's unique id
        std::size_t width = 0;
        bool normalized = false;   ///< integers as -1..1 or 0..1
        std::vector<float> values; ///< `width` a vertex
    };
    std::vector<Attribute> attributes; ///< asked for by id, width and normalized
    std::size_t most_vertices = 0, most_triangles = 0;
    std::vector<std::uint32_t> indices; ///< by three, each a vertex
    std::size_t vertices = 0;
};
extern "C" using DecodeDraco = void(std::string_view bytes, DracoMesh& mesh);

/// A buffer view of EXT_meshopt_compression. `mode` and `filter` as the extension names them.
struct MeshoptView {
    std::string_view bytes;
    std::size_t count = 0, stride = 0;
    std::string mode, filter;
};
/// `decoded` becomes count x stride bytes.
extern "C" using DecodeMeshopt = void(const MeshoptView& view, std::string& decoded);

/// Rows from the top, 4 bytes a pixel.
struct WebpPicture {
    std::size_t most_pixels = 0;
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};
extern "C" using DecodeWebp = void(std::string_view bytes, WebpPicture& picture);

} // namespace fernlicht
