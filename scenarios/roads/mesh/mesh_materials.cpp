#include "scenarios/roads/mesh/mesh_materials.h"

#include "scenarios/roads/mesh/road_mesh.h"

#include <cmath>
#include <string_view>
#include <utility>

namespace fernlicht {

namespace {

// EN 1436's 30 m geometry: light arrives 1.24 degrees and is seen 2.29 degrees above the surface [M], so 1.05 degrees between them.
constexpr double en1436_illumination_deg = 1.24;
constexpr double en1436_observation_deg = 2.29;

double luminance_of(const glm::vec3& rgb) { // Y of linear sRGB, IEC 61966-2-1
    return 0.2126 * static_cast<double>(rgb.r) + 0.7152 * static_cast<double>(rgb.g) + 0.0722 * static_cast<double>(rgb.b);
}

Material diffuse(const char* name, SurfaceKind kind, const glm::vec3& albedo) { return {.name = name, .kind = kind, .albedo = albedo}; }

/// A surface whose R_L in EN 1436's geometry is `total_mcd` (mcd/m2/lx) in all: the diffuse part has rho sin(1.24 deg) / pi of it,
/// since E on the surface is E_perp times that sine; the retroreflecting part has what is left.
Material road_surface(const char* name, SurfaceKind kind, const glm::vec3& albedo, double total_mcd) {
    const double diffuse_rl = luminance_of(albedo) * std::sin(radians(en1436_illumination_deg)) / pi;
    Material material = diffuse(name, kind, albedo);
    material.retro_rl = static_cast<float>(std::max(0.0, total_mcd * 1e-3 - diffuse_rl));
    material.retro_reference_rad = static_cast<float>(radians(en1436_observation_deg - en1436_illumination_deg));
    return material;
}

/// Sheeting by its coefficient R' at an observation angle of 0.33 degrees (EN 12899-1's 20 minutes, entrance 5 degrees).
Material sheeting(const char* name, const glm::vec3& albedo, float ra) {
    Material material = diffuse(name, SurfaceKind::board, albedo);
    material.retro_rl = ra;
    material.retro_reference_rad = static_cast<float>(radians(0.33));
    // RA2 falls from 180 at 0.33 degrees to a few per cent of it at 2 degrees [M: EN 12899-1's tables]; one exponential through both.
    material.retro_falloff_rad = static_cast<float>(radians(0.45));
    return material;
}

} // namespace

std::vector<Material> road_materials() {
    std::vector<Material> all(static_cast<std::size_t>(RoadMaterial::count));
    const auto set = [&](RoadMaterial which, Material material) { all[index_of(which)] = std::move(material); };
    using enum RoadMaterial;
    // Dry asphalt 10..20 mcd/m2/lx [M]; rho 0.08 alone gives 0.55 of them.
    set(asphalt, road_surface("asphalt", SurfaceKind::road, glm::vec3(0.08F), 15.0));
    set(concrete, road_surface("concrete", SurfaceKind::road, glm::vec3(0.25F, 0.25F, 0.24F), 20.0)); // brighter than asphalt [M]
    set(kerb, road_surface("kerb", SurfaceKind::road, glm::vec3(0.30F), 20.0));                       // granite or concrete stone [M]
    // EN 1436 classes R2..R5 are 100, 150, 200, 300 [M]: white in service R3; yellow lies about a fifth lower.
    set(marking_white, road_surface("marking-white", SurfaceKind::marking, glm::vec3(0.50F), 150.0));
    set(marking_yellow, road_surface("marking-yellow", SurfaceKind::marking, glm::vec3(0.45F, 0.35F, 0.05F), 120.0));
    // Grass: about 0.12 in the visible [M]; blades have a weak opposition peak, here 5 mcd/m2/lx [estimate].
    set(verge, road_surface("verge", SurfaceKind::verge, glm::vec3(0.105F, 0.130F, 0.060F), 5.0));
    set(terrain, road_surface("terrain", SurfaceKind::terrain, glm::vec3(0.105F, 0.130F, 0.060F), 5.0));
    // RA2: R' >= 180 cd/lx/m2 for white at 0.33 / 5 degrees [S: photometric class RA2 of EN 12899-1].
    set(board, sheeting("board", glm::vec3(0.40F), 180.0F));
    set(board_back, diffuse("board-back", SurfaceKind::object, glm::vec3(0.20F)));
    set(post, diffuse("post", SurfaceKind::object, glm::vec3(0.30F)));             // galvanised steel [estimate]
    set(delineator, diffuse("delineator", SurfaceKind::object, glm::vec3(0.70F))); // white plastic [estimate]
    set(object, diffuse("object", SurfaceKind::object, glm::vec3(0.30F)));
    set(trunk, diffuse("trunk", SurfaceKind::object, glm::vec3(0.12F, 0.09F, 0.06F)));   // bark [estimate]
    set(leaves, diffuse("leaves", SurfaceKind::object, glm::vec3(0.06F, 0.12F, 0.04F))); // green canopy, about 0.1 [M]
    return all;
}

RoadMaterial lane_material(const std::string& lane_type) {
    using enum RoadMaterial;
    static constexpr std::pair<std::string_view, RoadMaterial> rows[]{{"none", verge},       {"median", verge}, {"sidewalk", concrete},
                                                                      {"walking", concrete}, {"curb", kerb},    {"tram", concrete},
                                                                      {"rail", terrain}};
    for (const auto& [type, material] : rows)
        if (lane_type == type)
            return material;
    return asphalt;
}

RoadMaterial marking_material(const std::string& colour) {
    return colour == "yellow" || colour == "orange" ? RoadMaterial::marking_yellow : RoadMaterial::marking_white;
}

} // namespace fernlicht
