// What the tests of shadow methods light: a road with posts, and where the edges of their shadows lie.
#pragma once

#include "renderer/renderer.h"
#include "renderer/twin.h"
#include "tests/lamps.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

namespace fernlicht::tests {

/// The same light everywhere within 30 degrees to the sides, 8 up and 14 down.
inline std::shared_ptr<const LampFile> evenly_bright() {
    return file_of(table_of(steps(-30.0, 30.0, 1.0), steps(-14.0, 8.0, 1.0), [](double, double) { return 10000.0; }));
}

inline LitLamp lamp_at(const char* name, const glm::dvec3& place, const std::shared_ptr<const LampFile>& file) {
    return {.name = name, .file = file, .pose = {place, axes_from_angles(0.0, -0.01, 0.0)}, .intensity_factor = 1.0};
}

inline void add_sheet(Scene& scene, const char* name, std::uint32_t material, const glm::dvec3& at, const glm::vec3& a,
                      const glm::vec3& b) {
    Mesh mesh{name, at, {}, {}, {}};
    const glm::vec3 n = glm::normalize(glm::cross(a, b));
    for (const glm::vec3& p : {glm::vec3(0.0F), a, a + b, b})
        mesh.vertices.push_back({p, n, {}});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.batches = {{material, 0, 6}};
    scene.meshes.push_back(std::move(mesh));
}

/// Of a width, upright, facing the car; its left side at y.
struct Post {
    double x = 0.0, y = 0.0, width = 0.3, height = 1.5;
};

/// A road, posts, and a wall across the road.
inline Scene road_with(const std::vector<Post>& posts, double wall_x = 0.0) {
    Scene scene{.materials = {{"road", SurfaceKind::road, glm::vec3(0.1F)}, {"board", SurfaceKind::board, glm::vec3(0.4F)}}};
    add_sheet(scene, "road", 0, {-5.0, -30.0, 0.0}, {300.0F, 0.0F, 0.0F}, {0.0F, 60.0F, 0.0F});
    for (const Post& post : posts)
        add_sheet(scene, "post", 1, {post.x, post.y, 0.0}, {0.0F, static_cast<float>(-post.width), 0.0F},
                  {0.0F, 0.0F, static_cast<float>(post.height)});
    if (wall_x > 0.0)
        add_sheet(scene, "wall", 1, {wall_x, 20.0, 0.0}, {0.0F, -40.0F, 0.0F}, {0.0F, 0.0F, 4.0F});
    return scene;
}

/// A road in waves, whose crests the light grazes: crests shade what lies behind them, and must not shade themselves.
inline Scene road_in_waves(double height_m, double length_m) {
    Scene scene{.materials = {{"road", SurfaceKind::road, glm::vec3(0.1F)}}};
    Mesh mesh{"waves", {0.0, 0.0, 0.0}, {}, {}, {}};
    const double k = 2.0 * pi / length_m;
    for (int i = 0; i <= 200; ++i) {
        const double x = -5.0 + i, z = 0.5 * height_m * (std::cos(k * x) - 1.0);
        const glm::vec3 normal(glm::normalize(glm::dvec3(0.5 * height_m * k * std::sin(k * x), 0.0, 1.0)));
        for (const double y : {-4.0, 4.0})
            mesh.vertices.push_back({glm::vec3(glm::dvec3(x, y, z)), normal, {}});
        const auto a = static_cast<std::uint32_t>(2 * i);
        if (i < 200)
            mesh.indices.insert(mesh.indices.end(), {a, a + 2, a + 3, a, a + 3, a + 1});
    }
    mesh.batches = {{0, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

/// From where a driver sits, along the road.
inline View driver_view(int width_px, int height_px) {
    return {.position_m = {1.5, 0.35, 1.2},
            .pitch_rad = radians(-3.0),
            .vertical_fov_rad = radians(30.0),
            .width_px = width_px,
            .height_px = height_px};
}

} // namespace fernlicht::tests
