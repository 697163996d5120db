#include "scenarios/traffic/road_user_mesh.h"

#include "scenarios/roads/mesh_builder.h"

#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

struct Paints {
    std::uint32_t paint, glass, tyre, reflector;
};

Material diffuse(const char* name, const glm::vec3& albedo) {
    Material material;
    material.name = name;
    material.kind = SurfaceKind::vehicle;
    material.albedo = albedo;
    return material;
}

Paints add_paints(Scene& scene) {
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(diffuse("car-paint", glm::vec3(0.25F, 0.26F, 0.28F)));
    scene.materials.push_back(diffuse("car-glass", glm::vec3(0.04F)));
    scene.materials.push_back(diffuse("tyre", glm::vec3(0.04F)));
    // Red rear reflectors: at least 300 mcd/lx at 20 minutes of observation (UN R150, class IA) from some 50 cm2, so 60 cd/(lx m2).
    Material reflector = diffuse("rear-reflector", glm::vec3(0.1F, 0.01F, 0.01F));
    reflector.retro_rl = 60.0F;
    reflector.retro_reference_rad = static_cast<float>(radians(0.33));
    reflector.retro_falloff_rad = static_cast<float>(radians(0.45));
    scene.materials.push_back(reflector);
    return {first, first + 1, first + 2, first + 3};
}

/// From low to high with its sides leaning in by the insets (rear, front, sides); no floor.
void append_cabin(MeshBuilder& builder, std::uint32_t sides, std::uint32_t roof, const glm::dvec3& low, const glm::dvec3& high,
                  double rear_m, double front_m, double side_m) {
    const glm::dvec3 b[4] = {{low.x, low.y, low.z}, {high.x, low.y, low.z}, {high.x, high.y, low.z}, {low.x, high.y, low.z}};
    const glm::dvec3 t[4] = {{low.x + rear_m, low.y + side_m, high.z},
                             {high.x - front_m, low.y + side_m, high.z},
                             {high.x - front_m, high.y - side_m, high.z},
                             {low.x + rear_m, high.y - side_m, high.z}};
    for (int i = 0; i < 4; ++i) {
        const int k = (i + 1) % 4;
        builder.quad(sides, {b[i], b[k], t[k], t[i]});
    }
    builder.quad(roof, {t[0], t[1], t[2], t[3]});
}

void append_body(MeshBuilder& builder, const Paints& paints, const RoadUser& user) {
    const double rear = user.rear_m, front = rear + user.size_m.x, half = 0.5 * user.size_m.y, top = user.size_m.z;
    const bool cars = user.kind == RoadUserKind::car;
    const double waist = cars ? 0.6 * top : top;
    append_cabin(builder, paints.paint, paints.paint, {rear, -half, 0.2}, {front, half, waist}, 0.0, cars ? 0.1 : 0.0, 0.0);
    builder.quad(paints.paint, {glm::dvec3(rear, half, 0.2), {front, half, 0.2}, {front, -half, 0.2}, {rear, -half, 0.2}});
    if (cars)
        append_cabin(builder, paints.glass, paints.paint, {rear + 0.25, -half + 0.08, waist}, {front - 1.3, half - 0.08, top}, 0.5, 0.8,
                     0.12);
    if (user.size_m.y < 1.0)
        return;
    for (const double x : {0.0, 0.6 * user.size_m.x})
        for (const double y : {-half, half - 0.2})
            append_cabin(builder, paints.tyre, paints.tyre, {x - 0.3, y, 0.0}, {x + 0.3, y + 0.2, 0.2}, 0.0, 0.0, 0.0);
    for (const double y : {-half + 0.1, half - 0.2})
        builder.quad(paints.reflector,
                     {glm::dvec3(rear - 0.01, y + 0.1, 0.5), {rear - 0.01, y, 0.5}, {rear - 0.01, y, 0.55}, {rear - 0.01, y + 0.1, 0.55}});
}

} // namespace

void add_road_users(Scene& scene, std::span<const RoadUser> users) {
    if (users.empty())
        return;
    const Paints paints = add_paints(scene);
    for (std::size_t i = 0; i < users.size(); ++i) {
        MeshBuilder builder(users[i].name, glm::dvec3(0.0));
        append_body(builder, paints, users[i]);
        const std::size_t before = scene.meshes.size();
        std::move(builder).add_to(scene);
        if (scene.meshes.size() > before)
            scene.meshes.back().body = static_cast<int>(i);
    }
}

} // namespace fernlicht
