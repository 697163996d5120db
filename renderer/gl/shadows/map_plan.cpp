#include "renderer/gl/shadows/map_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace fernlicht::gl {
namespace {

/// Rigid, from positions relative to `ego_m`.
glm::dmat4 lamp_space_from_ego(const Pose& pose, const glm::dvec3& ego_m) {
    const glm::dvec3 axes[3] = {-pose.left(), pose.up(), pose.forward()}, at = pose.position_m - ego_m;
    glm::dmat4 m(1.0);
    for (int column = 0; column < 3; ++column)
        m[column] = {axes[0][column], axes[1][column], axes[2][column], 0.0};
    m[3] = {-glm::dot(axes[0], at), -glm::dot(axes[1], at), -glm::dot(axes[2], at), 1.0};
    return m;
}

} // namespace

glm::dmat3 window_homography(const ShadowWindow& window, int width, int height) {
    const double across = (width - 2.0) / width / (window.right - window.left), up = (height - 2.0) / height / (window.top - window.bottom);
    return {{across, 0.0, 0.0}, {0.0, up, 0.0}, {1.0 / width - window.left * across, 1.0 / height - window.bottom * up, 1.0}};
}

double spread_of(const glm::dmat3& texture_from_lamp, int width, int height) {
    const glm::dmat3 lamp_from_texture = glm::inverse(texture_from_lamp);
    const glm::dvec3 across = lamp_from_texture[0] / static_cast<double>(width), up = lamp_from_texture[1] / static_cast<double>(height);
    // Along the diagonal, too, where the two are not at right angles: of a square texel it is the square root of 2.
    const double diagonal = std::max(glm::length(across + up), glm::length(across - up)) / std::sqrt(2.0);
    return 1.5 * std::max({glm::length(across), glm::length(up), diagonal});
}

glm::dmat4 texture_from_ego(const MapPlan& plan, const glm::dvec3& ego_m) {
    glm::dmat4 texture_from_lamp(0.0);
    for (int column = 0; column < 3; ++column)
        texture_from_lamp[column] = glm::dvec4(plan.texture_from_lamp[column], plan.spread * plan.texture_from_lamp[column].z);
    return texture_from_lamp * lamp_space_from_ego(plan.from, ego_m);
}

double edge_shift(const MapPlan& then, const MapPlan& now) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const glm::dvec3 moved = now.from.position_m - then.from.position_m;
    const glm::dvec3 m(std::abs(glm::dot(moved, now.from.left())), std::abs(glm::dot(moved, now.from.up())),
                       std::abs(glm::dot(moved, now.from.forward())));
    double most = 0.0;
    for (const Caster& body : now.bodies) {
        // (X - m_x) / (Z - m_z) - X / Z = (X / Z * m_z - m_x) / (Z - m_z), and so for Y
        const double nearest = body.nearest_m - m.z;
        if (nearest <= 0.0)
            return unknown;
        const double aside = std::max(std::abs(body.left), std::abs(body.right)),
                     above = std::max(std::abs(body.bottom), std::abs(body.top));
        most = std::max(most, std::hypot(aside * m.z + m.x, above * m.z + m.y) / nearest);
    }
    return most;
}

} // namespace fernlicht::gl
