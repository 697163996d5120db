// One depth map of a lamp as it is to be drawn: from where, with which projection, of what.
#pragma once

#include "renderer/gl/shadows/shadow_casters.h"

#include <glm/mat3x3.hpp>

namespace fernlicht::gl {

/// Every depth map from one place is a homography of the directions from there: x and y in the texture over w, depth = near / w, which
/// falls along every ray. A plain map has w = z along the lamp's axis; a warped one has a w that leans.
struct MapPlan {
    Pose from;                          ///< in the world
    glm::dmat3 texture_from_lamp{1.0};  ///< lamp space (x right, y up, z forward) to x, y, w; w >= z on what the lamp lights
    double spread = 0.0;                ///< what a look-up's point is raised by, per unit of w
    std::vector<std::uint32_t> pieces;  ///< drawn; ascending
    std::vector<Caster> bodies;         ///< of these pieces, in their order
    std::vector<glm::dvec3> to_cover{}; ///< in lamp space; empty: what texture_from_lamp was made for follows from the lamp's axes alone
    double most_raise = 0.0;            ///< over to_cover, as a tangent seen from the lamp
};

/// A map that is kept may raise what is looked up in it by so much more than the one that would be drawn.
inline constexpr double shadow_kept_slack = 1.25;

/// Over a window of tangents; the outermost texels lie outside it. w = z.
glm::dmat3 window_homography(const ShadowWindow& window, int width, int height);

/// What a point that faces anywhere is to be raised by, per unit of w, so that the surface behind it lies farther away in all texels that a
/// look-up weighs: three halves of the most that a texel spans on the plane of its depth (docs/decisions/0005).
double spread_of(const glm::dmat3& texture_from_lamp, int width, int height);

/// (x, y, w, raise) in the map of positions relative to `ego_m`; column vectors.
glm::dmat4 texture_from_ego(const MapPlan& plan, const glm::dvec3& ego_m);

/// Most by which a shadow's edge can have moved, as a tangent seen from the lamp, since it was drawn as `then`, with casters at rest;
/// infinite where that is not known.
double edge_shift(const MapPlan& then, const MapPlan& now);

} // namespace fernlicht::gl
