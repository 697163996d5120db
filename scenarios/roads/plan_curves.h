// The curves of reference lines that have no elementary closed form, each in its own frame: start at the origin, u forward, v left.
// Gauss's rule of five points: exact for polynomials up to degree 9.
#pragma once

#include "scenarios/roads/plan.h"

#include <array>

namespace fernlicht {

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
