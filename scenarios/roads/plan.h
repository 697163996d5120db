// The reference line in the ground plane: arc length to position, heading and curvature, for each shape OpenDRIVE knows.
// The surface over it by s and t, with its tangents. For callers that ask often: the pieces that hold on a stretch are looked up once.
// The curves of reference lines that have no elementary closed form, each in its own frame: start at the origin, u forward, v left.
// Gauss's rule of five points: exact for polynomials up to degree 9.
#pragma once

#include "scenarios/roads/road_network.h"

#include <array>

namespace fernlicht {

/// A point of a reference line.
struct PlanPoint {
    double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;
    double heading_rate_per_m = 0.0; ///< change of heading per metre of s: the curvature where s is the arc length
    double speed = 1.0;              ///< metres on the curve per metre of s; other than 1 only for paramPoly3
};

/// Fills the caches of spirals and cubics, so that plan_point costs the same everywhere on the element.
void prepare(PlanElement& element);

/// The point `ds_m` after the element's start; a little beyond its end the formula goes on.
PlanPoint plan_point(const PlanElement& element, double ds_m);

/// The point of the road's reference line at s, clamped to the road. A road without elements lies at the origin.
PlanPoint plan_point(const Road& road, double s_m);

/// The element that holds at s. The road must have one.
const PlanElement& element_at(const Road& road, double s_m);

/// Length of the curve an element draws, by integration; equals length_m for everything but a badly written paramPoly3.
double drawn_length_m(const PlanElement& element);

/// The pieces of a road's geometry that hold at some s, into the road's own vectors.
struct SurfaceStrip {
    const PlanElement* element = nullptr;
    const Cubic *elevation = nullptr, *superelevation = nullptr; ///< nullptr: zero
    const std::vector<ShapeProfile>* shapes = nullptr;
};

SurfaceStrip strip_at(const Road& road, double s_m);

struct SurfacePoint {
    glm::dvec3 position_m{0.0};
    glm::dvec3 by_s{1.0, 0.0, 0.0}, by_t{0.0, 1.0, 0.0}; ///< derivatives of the position, by_s never backwards
};

/// The surface across the road at one s: all that does not depend on t, for callers that ask for many t.
struct SurfaceCut {
    double s_m = 0.0;
    const std::vector<ShapeProfile>* shapes = nullptr; ///< nullptr: flat
    glm::dvec3 reference_m{0.0};                       ///< the point at t = 0 of a flat cut
    glm::dvec3 forward{0.0}, left{0.0}, up{0.0};       ///< unit
    glm::dvec3 advance{0.0}, turning{0.0};             ///< derivatives by s of the reference point and of the frame's attitude
};

SurfaceCut cut_at(const SurfaceStrip& strip, double s_m);
SurfacePoint surface_point(const SurfaceCut& cut, double t_m);
inline SurfacePoint surface_point(const SurfaceStrip& strip, double s_m, double t_m) { return surface_point(cut_at(strip, s_m), t_m); }

/// x along `direction` (tangent to the surface, need not be unit), z the surface's normal, upwards.
Pose pose_along(const SurfacePoint& point, const glm::dvec3& direction);

/// Clothoid: curvature linear in the arc length. Fresnel integrals by Gauss-Legendre steps of at most a quarter radian, so that every
/// curvature is treated alike: straight, nearly straight, changing sign, tightly wound.
/// Against quadruple precision: within 1e-13 of the length. `spiral.steps_m` is used when filled, else recomputed.
PlanPoint curve_point(const Spiral& spiral, double length_m, double ds_m);
/// Local positions at the beginnings of the steps. The number of steps is bounded: see max_spiral_turn_rad.
std::vector<glm::dvec2> spiral_steps(const Spiral& spiral, double length_m);
inline constexpr double max_spiral_turn_rad = 1e4; ///< max |curvature| times length that a reader may accept

/// Cubic v(u); ds is the arc length from u = 0, inverted by Newton's method between knots.
PlanPoint curve_point(const Poly3& poly, double length_m, double ds_m);
std::vector<Poly3::Knot> poly3_knots(const Poly3& poly, double length_m);

/// Cubics u(p), v(p) with p = ds/length or p = ds as the file says; the heading is the curve's tangent.
PlanPoint curve_point(const ParamPoly3& poly, double length_m, double ds_m);
double param_poly3_length(const ParamPoly3& poly, double length_m);

/// Over 0 .. 1; the weights' sum is 1 (Abramowitz and Stegun, table 25.4).
inline constexpr std::array<double, 5> gauss_node{0.04691007703066800, 0.23076534494715846, 0.5, 0.76923465505284154, 0.95308992296933200};
inline constexpr std::array<double, 5> gauss_weight{0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                                    0.11846344252809454};

} // namespace fernlicht
