// Small scenes whose light is known in closed form.
#pragma once

#include "renderer/reference/reference.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <initializer_list>

namespace fernlicht {

/// A quadrilateral a b c d, counter-clockwise as seen from its lit side.
inline void add_quad(Mesh& mesh, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const glm::vec3 normal(glm::normalize(glm::cross(b - a, d - a)));
    const glm::vec2 uv[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    int k = 0;
    for (const glm::dvec3& p : {a, b, c, d})
        mesh.vertices.push_back({glm::vec3(p), normal, uv[k++]});
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U})
        mesh.indices.push_back(first + i);
}

/// All of a mesh of one material.
inline Mesh finished(Mesh mesh, std::uint32_t material) {
    mesh.batches = {{material, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
    return mesh;
}

/// The same candela in every direction of the forward half-space.
inline LitLamp even_lamp(double cd, const Pose& pose) {
    auto file = std::make_shared<LampFile>();
    file->table.h_deg = {-180.0, 180.0};
    file->table.v_deg = {-90.0, 90.0};
    file->table.cd = {cd, cd, cd, cd};
    return {"lamp", file, pose, 1.0, LampColour{}, 0.0};
}

/// A lamp that looks along a direction of the world.
inline Pose looking(glm::dvec3 position_m, double yaw_deg, double pitch_deg) {
    return {position_m, axes_from_angles(radians(yaw_deg), radians(pitch_deg), 0.0)};
}

/// A camera with a narrow, square view.
inline View camera(glm::dvec3 position_m, double yaw_deg, double pitch_deg, double fov_deg, int px) {
    View view{.position_m = position_m, .yaw_rad = radians(yaw_deg), .pitch_rad = radians(pitch_deg), .vertical_fov_rad = radians(fov_deg)};
    view.width_px = view.height_px = px;
    return view;
}

/// A map of px x px pixels over 2 half x 2 half metres about a place.
inline View map_about(glm::dvec2 centre_m, double half_m, int px) {
    View view{.projection = Projection::map,
              .map_ahead_m = centre_m.x + half_m,
              .map_behind_m = half_m - centre_m.x,
              .map_left_m = half_m + centre_m.y,
              .map_right_m = half_m - centre_m.y};
    view.width_px = view.height_px = px;
    return view;
}

/// A closed cube of 2 m about (0, 0, 0), seen from within, of one material.
inline Scene closed_room(const Material& material) {
    Mesh room{"room", {}, {}, {}, {}};
    add_quad(room, {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1});
    add_quad(room, {-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1});
    add_quad(room, {-1, -1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1});
    add_quad(room, {-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1});
    add_quad(room, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1});
    add_quad(room, {1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1});
    return Scene{.materials = {material}, .meshes = {finished(room, 0)}};
}

/// A level square of ground about (0, 0, 0), `half_m` to each side.
inline Scene level_ground(double half_m, const Material& material) {
    Mesh ground{"ground", {}, {}, {}, {}};
    add_quad(ground, {-half_m, -half_m, 0}, {half_m, -half_m, 0}, {half_m, half_m, 0}, {-half_m, half_m, 0});
    return Scene{.materials = {material}, .meshes = {finished(ground, 0)}};
}

inline Material lambert(double albedo, SurfaceKind kind = SurfaceKind::road) {
    return {.name = "lambert", .kind = kind, .albedo = glm::vec3(static_cast<float>(albedo))};
}

/// Solid angle of a polygon seen from a point, sr: a fan of triangles by van Oosterom and Strackee 1983. Even light of I candela that falls
/// on a polygon is I times that, in lumen.
inline double solid_angle(const glm::dvec3& eye, const std::vector<glm::dvec3>& polygon) {
    double sum = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const glm::dvec3 a = glm::normalize(polygon[0] - eye), b = glm::normalize(polygon[i - 1] - eye),
                         c = glm::normalize(polygon[i] - eye);
        sum += 2.0 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))), 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
    }
    return sum;
}

inline constexpr Wanted everything{.illuminance = true, .target = true, .luminance = true};
inline constexpr Wanted lux{.illuminance = true};

} // namespace fernlicht
