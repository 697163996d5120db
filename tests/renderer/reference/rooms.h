// Small scenes whose light is known in closed form.
#pragma once

#include "renderer/reference/reference.h"
#include "tests/lamps.h"
#include "tests/renderer/views.h"

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

struct Quad {
    glm::dvec3 a, b, c, d; ///< counter-clockwise as seen from its lit side
};

/// A mesh of one material.
inline Mesh quads(const char* name, std::uint32_t material, const glm::dvec3& origin_m, std::initializer_list<Quad> all) {
    Mesh mesh{name, origin_m, {}, {}, {}};
    for (const auto& [a, b, c, d] : all)
        add_quad(mesh, a, b, c, d);
    return finished(std::move(mesh), material);
}

inline Material lambert(double albedo, SurfaceKind kind = SurfaceKind::road, double emission_cdm2 = 0.0) {
    return {.name = "lambert",
            .kind = kind,
            .albedo = glm::vec3(static_cast<float>(albedo)),
            .emission_cdm2 = glm::vec3(static_cast<float>(emission_cdm2))};
}

/// The same candela in every direction of the forward half-space.
inline LitLamp even_lamp(double cd, const Pose& pose) {
    return {"lamp", tests::file_of(tests::even_table(cd)), pose, 1.0, LampColour{}, 0.0};
}

/// A lamp that looks along a direction of the world.
inline Pose looking(glm::dvec3 position_m, double yaw_deg, double pitch_deg) {
    return {position_m, axes_from_angles(radians(yaw_deg), radians(pitch_deg), 0.0)};
}

/// A camera with a narrow view, square unless the height is told.
inline View camera(glm::dvec3 position_m, double yaw_deg, double pitch_deg, double fov_deg, int width_px, int height_px = 0) {
    return {.position_m = position_m,
            .yaw_rad = radians(yaw_deg),
            .pitch_rad = radians(pitch_deg),
            .vertical_fov_rad = radians(fov_deg),
            .width_px = width_px,
            .height_px = height_px > 0 ? height_px : width_px};
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
    return {.materials = {material},
            .meshes = {quads("room", 0, {},
                             {{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}},
                              {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}},
                              {{-1, -1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1}},
                              {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}},
                              {{-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}},
                              {{1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}}})}};
}

/// A level square of ground about (0, 0, 0), `half_m` to each side.
inline Scene level_ground(double half_m, const Material& material) {
    return {.materials = {material},
            .meshes = {quads("ground", 0, {}, {{{-half_m, -half_m, 0}, {half_m, -half_m, 0}, {half_m, half_m, 0}, {-half_m, half_m, 0}}})}};
}

/// A ground of 1 m x 1 m and a plate of the same size 1 m above that faces it.
inline Scene plates(double ground_albedo, double plate_albedo, double plate_cdm2) {
    Scene scene = level_ground(0.5, lambert(ground_albedo));
    scene.materials.push_back(lambert(plate_albedo, SurfaceKind::object, plate_cdm2));
    scene.meshes.push_back(quads("plate", 1, {0.0, 0.0, 1.0}, {{{-0.5, -0.5, 0}, {-0.5, 0.5, 0}, {0.5, 0.5, 0}, {0.5, -0.5, 0}}}));
    return scene;
}
/// How much of it they see of each other (Howell's catalogue, C-11, X = Y = 1).
inline const double plates_factor =
    2.0 / pi * (0.5 * std::log(4.0 / 3.0) + 2.0 * std::sqrt(2.0) * std::atan(1.0 / std::sqrt(2.0)) - 2.0 * std::atan(1.0));

/// Black ground under a plate of 2 m x 2 m, 2 m above.
inline Scene hidden_sky(double half_m) {
    Scene scene = level_ground(half_m, lambert(0.0));
    scene.materials.push_back(lambert(0.0, SurfaceKind::object));
    scene.meshes.push_back(quads("plate", 1, {0.0, 0.0, 2.0}, {{{-1, -1, 0}, {-1, 1, 0}, {1, 1, 0}, {1, -1, 0}}}));
    return scene;
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

/// Five standard errors: 1 in 10 000 of Student's t with 15 degrees of freedom; seeds are fixed. `bias`: of the truth; by default what
/// floats round when they store the result.
inline void expect_estimate(const Estimate& estimate, double truth, double bias = 1e-6, int x = 0, int y = 0) {
    EXPECT_NEAR(estimate.mean.at(x, y), truth, 5.0 * static_cast<double>(estimate.standard_error.at(x, y)) + bias * truth) << x << " " << y;
}

inline constexpr FrameOutputs everything{.illuminance = true, .target = true, .luminance = true};
inline constexpr FrameOutputs lux{.illuminance = true};

} // namespace fernlicht
