// From a view on a car to clip space; the one place that follows OpenGL's conventions.
#pragma once

#include "scenarios/drives/play/moment.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>

namespace fernlicht {

/// Everything relative to the car's origin, along the world's axes.
struct Camera {
    glm::dmat4 clip_from_ego{1.0}; ///< depth 0..1 reversed: 1 is near; y down, so that row 0 is the top of the picture
    glm::dvec3 eye_m{0.0};
    glm::dvec3 axis{1.0, 0.0, 0.0}; ///< viewing direction
    glm::dvec3 right{0.0}, up{0.0}; ///< unit, of the picture
    bool is_map = false;
    glm::dvec2 half_extent{0.0}; ///< map: metres from the centre to the right and top edge; perspective: tangents
};

Camera camera_of(const Moment& moment, const View& view);

/// The ray (perspective) or line (map) through a pixel's centre: origin and unit direction, relative to the car's origin.
struct Ray {
    glm::dvec3 origin_m, direction;
};
Ray pixel_ray(const Camera& camera, const View& view, double x_px, double y_px);

/// Where a perspective view shows a place relative to the car's origin: pixel coordinates (centres at .5) and depth in metres; nullopt
/// behind the eye and outside the picture.
std::optional<glm::dvec3> seen_at(const Camera& camera, const View& view, const glm::dvec3& place_m);
/// What a pixel's centre shows at this depth in a perspective view, relative to the car's origin.
glm::dvec3 shown_at(const Camera& camera, const View& view, int x, int y, float depth_m);

/// Pixel coordinates of a world point in a map view (centres at .5).
glm::dvec2 map_pixel(const Camera& camera, const View& view, const Moment& moment, const glm::dvec3& world_m);

/// From positions along the world's axes to a frame (x right, y up, z forward) that stands at `eye_m`.
glm::dmat4 view_matrix(const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& forward, const glm::dvec3& eye_m);

/// Infinite reversed-depth projection for a window of tangents; depth is near / z.
glm::dmat4 tangent_projection(double left, double right, double bottom, double top, double near_m);

} // namespace fernlicht
