#include "scenarios/roads/mesh/far_ground.h"

#include "scenarios/roads/mesh/road_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <limits>

namespace fernlicht {
namespace {

constexpr double far_beyond_m = 2500.0, far_below_m = 0.5;
constexpr double far_tile_m = 500.0;     // small enough to be culled
constexpr double most_far_tiles = 250.0; // each way; larger then

} // namespace

void add_far_ground(Scene& scene) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Mesh& mesh : scene.meshes)
        for (const Vertex& vertex : mesh.vertices) {
            low = glm::min(low, mesh.origin_m + glm::dvec3(vertex.position_m));
            high = glm::max(high, mesh.origin_m + glm::dvec3(vertex.position_m));
        }
    if (!(low.x <= high.x))
        return;
    low -= far_beyond_m;
    high += far_beyond_m;
    const double z_m = low.z + far_beyond_m - far_below_m,
                 side_m = std::max(far_tile_m, std::max(high.x - low.x, high.y - low.y) / most_far_tiles);
    const std::vector<Material> known = road_materials();
    Material ground = *std::ranges::find(known, "terrain", &Material::name);
    ground.name = "far ground";
    ground.kind = SurfaceKind::object; // not in maps
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(std::move(ground));
    const auto half = static_cast<float>(0.5 * side_m);
    for (double x = low.x; x < high.x; x += side_m)
        for (double y = low.y; y < high.y; y += side_m) {
            Mesh tile;
            tile.name = fmt::format("far ground {:.0f} {:.0f}", x, y);
            tile.origin_m = glm::round(glm::dvec3(x + 0.5 * side_m, y + 0.5 * side_m, 0.0));
            const auto z = static_cast<float>(z_m);
            for (const auto& [dx, dy] : {std::pair(-half, -half), std::pair(half, -half), std::pair(half, half), std::pair(-half, half)})
                tile.vertices.push_back({{dx, dy, z}, {0.0F, 0.0F, 1.0F}});
            tile.indices = {0, 1, 2, 0, 2, 3};
            tile.batches = {{material, 0, 6}};
            tile.casts = false;
            scene.meshes.push_back(std::move(tile));
        }
}

} // namespace fernlicht
