#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

struct Jet {
    double value = 0.0, slope = 0.0, curve = 0.0; ///< value and its first two derivatives
};

Jet jet_at(const Cubic* piece, double s) {
    return piece ? Jet{piece->at(s), piece->slope(s), 2.0 * piece->c + 6.0 * piece->d * (s - piece->s0)} : Jet{};
}

struct Height {
    double h = 0.0, by_s = 0.0, by_t = 0.0;
};

/// Right of the first piece the profile goes on with the slope it begins with; left of the last it is as the reader has ended it.
Height height_over(const ShapeProfile& profile, double t) {
    if (profile.over_t.empty())
        return {};
    const Cubic* piece = piece_at(profile.over_t, t);
    if (!piece) {
        const Cubic& first = profile.over_t.front();
        return {first.a + first.b * (t - first.s0), 0.0, first.b};
    }
    return {piece->at(t), 0.0, piece->slope(t)};
}

/// Between two profiles the height is linear in s; before the first and after the last it stays.
Height shape_height(const std::vector<ShapeProfile>& shapes, double s, double t) {
    const auto after = std::ranges::upper_bound(shapes, s, {}, &ShapeProfile::s_m);
    if (after == shapes.begin())
        return height_over(*after, t);
    const Height here = height_over(*(after - 1), t);
    if (after == shapes.end())
        return here;
    const Height next = height_over(*after, t);
    const double span = after->s_m - (after - 1)->s_m, part = (s - (after - 1)->s_m) / span;
    return {here.h + part * (next.h - here.h), (next.h - here.h) / span, here.by_t + part * (next.by_t - here.by_t)};
}

} // namespace

SurfaceStrip strip_at(const Road& road, double s_m) {
    static const PlanElement nowhere{};
    return {road.plan.empty() ? &nowhere : &element_at(road, s_m), piece_at(road.elevation, s_m), piece_at(road.superelevation, s_m),
            road.shapes.empty() ? nullptr : &road.shapes};
}

SurfaceCut cut_at(const SurfaceStrip& strip, double s_m) {
    const PlanPoint plan = plan_point(*strip.element, s_m - strip.element->s_m);
    const Jet elevation = jet_at(strip.elevation, s_m), roll = jet_at(strip.superelevation, s_m);
    const double speed = std::max(plan.speed, 1e-9); // elevation is given over s, the plane is walked at `speed` per s
    const double gradient = elevation.slope / speed, steepness = std::sqrt(1.0 + gradient * gradient);
    const double c = std::cos(plan.heading_rad), s = std::sin(plan.heading_rad);

    // The frame of axes_from_angles(heading, atan(gradient), roll), without its inverse functions.
    const glm::dvec3 across{-s, c, 0.0};
    SurfaceCut cut{s_m, strip.shapes, {plan.x_m, plan.y_m, elevation.value}, glm::dvec3(c, s, gradient) / steepness, across, {}, {}, {}};
    cut.up = glm::dvec3(-gradient * c, -gradient * s, 1.0) / steepness;
    if (roll.value != 0.0) {
        const double cr = std::cos(roll.value), sr = std::sin(roll.value);
        cut.left = cr * across + sr * cut.up;
        cut.up = cr * cut.up - sr * across;
    }
    cut.advance = speed * steepness * cut.forward;
    // The cross-section turns with heading about the vertical, with pitch about the horizontal across, with roll about the tangent.
    cut.turning = glm::dvec3(0.0, 0.0, plan.heading_rate_per_m) - elevation.curve / speed / (steepness * steepness) * across +
                  roll.slope * cut.forward;
    return cut;
}

SurfacePoint surface_point(const SurfaceCut& cut, double t_m) {
    const Height height = cut.shapes ? shape_height(*cut.shapes, cut.s_m, t_m) : Height{};
    SurfacePoint point;
    const glm::dvec3 arm = t_m * cut.left + height.h * cut.up;
    point.position_m = cut.reference_m + arm;
    point.by_s = cut.advance + glm::cross(cut.turning, arm) + height.by_s * cut.up;
    point.by_t = cut.left + height.by_t * cut.up;
    // Beyond the centre of a bend lines of constant t run backwards; the surface is still the road's upper side.
    if (glm::dot(point.by_s, cut.forward) <= 1e-9 || glm::cross(point.by_s, point.by_t).z <= 0.0) {
        point.by_s = cut.forward;
        point.by_t = cut.left;
    }
    return point;
}

Pose pose_along(const SurfacePoint& point, const glm::dvec3& direction) {
    Pose pose;
    pose.position_m = point.position_m;
    pose.axes[0] = glm::normalize(direction);
    pose.axes[2] = glm::normalize(glm::cross(point.by_s, point.by_t));
    pose.axes[1] = glm::cross(pose.axes[2], pose.axes[0]);
    return pose;
}

Pose surface_pose(const RoadNetwork&, const Road& road, double s_m, double t_m) {
    const double s = std::clamp(s_m, 0.0, std::max(road.length_m, 0.0));
    const SurfacePoint point = surface_point(strip_at(road, s), s, t_m);
    return pose_along(point, point.by_s);
}

} // namespace fernlicht
