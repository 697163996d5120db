#include "scenarios/roads/cubics.h"
#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

struct Jet {
    double value = 0.0, slope = 0.0, curve = 0.0; ///< value and its first two derivatives
};

Jet jet_at(const std::vector<Cubic>& pieces, double s) {
    const Cubic* piece = piece_at(pieces, s);
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
    const auto after =
        std::upper_bound(shapes.begin(), shapes.end(), s, [](double at, const ShapeProfile& profile) { return at < profile.s_m; });
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

Pose surface_pose(const RoadNetwork&, const Road& road, double s_m, double t_m) {
    const double s = std::clamp(s_m, 0.0, std::max(road.length_m, 0.0));
    const PlanPoint plan = plan_point(road, s);
    const Jet elevation = jet_at(road.elevation, s), roll = jet_at(road.superelevation, s);
    const double speed = std::max(plan.speed, 1e-9); // elevation is given over s, the plane is walked at `speed` per s
    const double gradient = elevation.slope / speed, pitch = std::atan(gradient);
    const glm::dmat3 axes = axes_from_angles(plan.heading_rad, pitch, roll.value);
    const Height height = road.shapes.empty() ? Height{} : shape_height(road.shapes, s, t_m);

    // The cross-section turns with heading about the vertical, with pitch about the horizontal across, with roll about the tangent.
    const glm::dvec3 arm = axes * glm::dvec3(0.0, t_m, height.h);
    const glm::dvec3 across{-std::sin(plan.heading_rad), std::cos(plan.heading_rad), 0.0};
    const glm::dvec3 turning = plan.heading_rate_per_m * glm::dvec3(0.0, 0.0, 1.0) -
                               elevation.curve / speed / (1.0 + gradient * gradient) * across + roll.slope * axes[0];
    const glm::dvec3 base_by_s = axes[0] * (speed * std::sqrt(1.0 + gradient * gradient));
    glm::dvec3 by_s = base_by_s + glm::cross(turning, arm) + height.by_s * axes[2];
    const glm::dvec3 by_t = axes * glm::dvec3(0.0, 1.0, height.by_t);
    // Beyond the centre of a bend lines of constant t run backwards; the surface is still the road's upper side.
    if (glm::dot(by_s, axes[0]) <= 1e-9)
        by_s = axes[0];

    Pose pose;
    pose.position_m = glm::dvec3(plan.x_m, plan.y_m, elevation.value) + arm;
    pose.axes[0] = glm::normalize(by_s);
    pose.axes[2] = glm::normalize(glm::cross(by_s, by_t));
    pose.axes[1] = glm::cross(pose.axes[2], pose.axes[0]);
    return pose;
}

} // namespace fernlicht
