#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// sin(x)/x and (1 - cos(x))/x, both smooth through 0: an arc of any curvature, nearly straight ones included.
void unit_arc(double x, double& along, double& across) {
    if (std::abs(x) < 1e-2) {
        const double x2 = x * x; // next terms: x^8/9! and x^9/10!, below 1e-21
        along = 1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0));
        across = x / 2.0 * (1.0 - x2 / 12.0 * (1.0 - x2 / 30.0 * (1.0 - x2 / 56.0)));
    } else {
        along = std::sin(x) / x;
        const double half = std::sin(0.5 * x);
        across = 2.0 * half * half / x; // 1 - cos without cancellation
    }
}

PlanPoint curve_point(const Line&, double, double ds) { return {ds, 0.0, 0.0, 0.0, 1.0}; }

PlanPoint curve_point(const Arc& arc, double, double ds) {
    double along = 1.0, across = 0.0;
    unit_arc(arc.curvature_per_m * ds, along, across);
    return {ds * along, ds * across, arc.curvature_per_m * ds, arc.curvature_per_m, 1.0};
}

} // namespace

PlanPoint plan_point(const PlanElement& element, double ds_m) {
    const PlanPoint local = std::visit([&](const auto& shape) { return curve_point(shape, element.length_m, ds_m); }, element.shape);
    const double c = std::cos(element.heading_rad), s = std::sin(element.heading_rad);
    return {element.x_m + c * local.x_m - s * local.y_m, element.y_m + s * local.x_m + c * local.y_m,
            element.heading_rad + local.heading_rad, local.heading_rate_per_m, local.speed};
}

const PlanElement& element_at(const Road& road, double s_m) {
    const auto after = std::ranges::upper_bound(road.plan, s_m, {}, &PlanElement::s_m);
    return after == road.plan.begin() ? *after : *(after - 1);
}

PlanPoint plan_point(const Road& road, double s_m) {
    if (road.plan.empty())
        return {};
    const double s = std::clamp(s_m, 0.0, std::max(road.length_m, 0.0));
    const PlanElement& element = element_at(road, s);
    return plan_point(element, s - element.s_m);
}

Pose plan_pose(const Road& road, double s_m) {
    const PlanPoint point = plan_point(road, s_m);
    return {{point.x_m, point.y_m, 0.0}, axes_from_angles(point.heading_rad, 0.0, 0.0)};
}

void prepare(PlanElement& element) {
    if (auto* spiral = std::get_if<Spiral>(&element.shape))
        spiral->steps_m = spiral_steps(*spiral, element.length_m);
    else if (auto* poly = std::get_if<Poly3>(&element.shape))
        poly->knots = poly3_knots(*poly, element.length_m);
}

double drawn_length_m(const PlanElement& element) {
    const auto* poly = std::get_if<ParamPoly3>(&element.shape);
    return poly ? param_poly3_length(*poly, element.length_m) : element.length_m;
}

} // namespace fernlicht
