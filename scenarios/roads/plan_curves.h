// The curves of reference lines that have no elementary closed form, each in its own frame: start at the origin, u forward, v left.
#pragma once

#include "scenarios/roads/plan.h"

namespace fernlicht {

/// Clothoid: curvature linear in the arc length. Fresnel integrals by Gauss-Legendre steps of at most a quarter radian, so that every
/// curvature is treated alike: straight, nearly straight, changing sign, tightly wound.
/// Against quadruple precision: within 1e-13 of the length. `spiral.steps_m` is used when filled, else recomputed.
PlanPoint spiral_point(const Spiral& spiral, double length_m, double ds_m);
/// Local positions at the beginnings of the steps. The number of steps is bounded: see max_spiral_turn_rad.
std::vector<glm::dvec2> spiral_steps(const Spiral& spiral, double length_m);
inline constexpr double max_spiral_turn_rad = 1e4; ///< max |curvature| times length that a reader may accept

/// Cubic v(u); ds is the arc length from u = 0, inverted by Newton's method between knots.
PlanPoint poly3_point(const Poly3& poly, double length_m, double ds_m);
std::vector<Poly3::Knot> poly3_knots(const Poly3& poly, double length_m);

/// Cubics u(p), v(p) with p = ds/length or p = ds as the file says; the heading is the curve's tangent.
PlanPoint param_poly3_point(const ParamPoly3& poly, double length_m, double ds_m);
double param_poly3_length(const ParamPoly3& poly, double length_m);

} // namespace fernlicht
