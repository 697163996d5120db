#include "scenarios/drives/play/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

/// What is nearer is cut off: 0.1 m along the axis. Towards the corners of a view wider than 152 degrees that is far along the ray; there
/// the plane moves closer, so that nothing farther than 0.4 m from the eye is lost.
double near_plane_m(const glm::dvec2& half_extent) { return 0.1 * std::min(1.0, 4.0 / glm::length(glm::dvec3(half_extent, 1.0))); }

constexpr double map_half_height_m = 500.0;

Camera map_camera(const Moment& moment, const View& view) {
    Camera camera;
    camera.is_map = true;
    glm::dvec3 ahead{moment.ego.forward().x, moment.ego.forward().y, 0.0};
    ahead = glm::length(ahead) > 1e-9 ? glm::normalize(ahead) : glm::dvec3{1.0, 0.0, 0.0};
    camera.up = ahead;
    camera.right = {ahead.y, -ahead.x, 0.0};
    camera.axis = {0.0, 0.0, -1.0};
    camera.half_extent = {0.5 * (view.map_left_m + view.map_right_m), 0.5 * (view.map_ahead_m + view.map_behind_m)};
    camera.eye_m = ahead * (0.5 * (view.map_ahead_m - view.map_behind_m)) + camera.right * (0.5 * (view.map_right_m - view.map_left_m));
    glm::dmat4 projection(1.0);
    projection[0][0] = 1.0 / camera.half_extent.x;
    projection[1][1] = 1.0 / camera.half_extent.y;
    projection[2][2] = -0.5 / map_half_height_m; // higher is nearer, 0.5 at the car's height
    projection[3][2] = 0.5;
    camera.clip_from_ego = projection * view_matrix(camera.right, camera.up, camera.axis, camera.eye_m);
    return camera;
}

} // namespace

glm::dmat4 view_matrix(const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& forward, const glm::dvec3& eye) {
    glm::dmat4 m(1.0);
    for (int column = 0; column < 3; ++column)
        m[column] = {right[column], up[column], forward[column], 0.0};
    m[3] = {-glm::dot(right, eye), -glm::dot(up, eye), -glm::dot(forward, eye), 1.0};
    return m;
}

glm::dmat4 tangent_projection(double left, double right, double bottom, double top, double near) {
    glm::dmat4 m(0.0);
    m[0][0] = 2.0 / (right - left);
    m[2][0] = -(right + left) / (right - left);
    m[1][1] = 2.0 / (top - bottom);
    m[2][1] = -(top + bottom) / (top - bottom);
    m[3][2] = near; // depth = near / z
    m[2][3] = 1.0;  // w = z
    return m;
}

Camera camera_of(const Moment& moment, const View& view) {
    if (view.projection == Projection::map)
        return map_camera(moment, view);
    Camera camera;
    const glm::dmat3 axes = moment.ego.axes * axes_from_angles(view.yaw_rad, view.pitch_rad, view.roll_rad);
    camera.axis = axes[0];
    camera.right = view.mirrored ? axes[1] : -axes[1];
    camera.up = axes[2];
    camera.eye_m = moment.ego.axes * view.position_m;
    const double tangent = std::tan(0.5 * view.vertical_fov_rad);
    camera.half_extent = {tangent * view.width_px / view.height_px, tangent};
    camera.clip_from_ego = tangent_projection(-camera.half_extent.x, camera.half_extent.x, -camera.half_extent.y, camera.half_extent.y,
                                              near_plane_m(camera.half_extent)) *
                           view_matrix(camera.right, camera.up, camera.axis, camera.eye_m);
    return camera;
}

Ray pixel_ray(const Camera& camera, const View& view, double x_px, double y_px) {
    const double x = (2.0 * x_px / view.width_px - 1.0) * camera.half_extent.x,
                 y = (1.0 - 2.0 * y_px / view.height_px) * camera.half_extent.y;
    if (camera.is_map)
        return {camera.eye_m + camera.right * x + camera.up * y - camera.axis * map_half_height_m, camera.axis};
    return {camera.eye_m, glm::normalize(camera.axis + camera.right * x + camera.up * y)};
}

std::optional<glm::dvec3> seen_at(const Camera& camera, const View& view, const glm::dvec3& place_m) {
    const glm::dvec3 p = place_m - camera.eye_m;
    const double depth_m = glm::dot(p, camera.axis);
    const double x = (1.0 + glm::dot(p, camera.right) / depth_m / camera.half_extent.x) * 0.5 * view.width_px,
                 y = (1.0 - glm::dot(p, camera.up) / depth_m / camera.half_extent.y) * 0.5 * view.height_px;
    const bool seen = depth_m > 0.0 && x >= 0.0 && y >= 0.0 && x < view.width_px && y < view.height_px;
    return seen ? std::optional(glm::dvec3(x, y, depth_m)) : std::nullopt;
}

glm::dvec3 shown_at(const Camera& camera, const View& view, int x, int y, float depth_m) {
    const Ray ray = pixel_ray(camera, view, x + 0.5, y + 0.5);
    return ray.origin_m + ray.direction * (static_cast<double>(depth_m) / glm::dot(ray.direction, camera.axis));
}

glm::dvec2 map_pixel(const Camera& camera, const View& view, const Moment& moment, const glm::dvec3& world_m) {
    const glm::dvec3 p = world_m - moment.ego.position_m - camera.eye_m;
    return {(glm::dot(p, camera.right) / camera.half_extent.x + 1.0) * 0.5 * view.width_px,
            (1.0 - glm::dot(p, camera.up) / camera.half_extent.y) * 0.5 * view.height_px};
}

} // namespace fernlicht
