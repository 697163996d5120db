#include "scenarios/openscenario/osc_distances.h"

#include "scenarios/openscenario/osc_mover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::osc {
namespace {

std::array<glm::dvec2, 4> corners(const EntityState& state) {
    const BoundingBox& box = state.entity->box;
    std::array<glm::dvec2, 4> out;
    const double x[2] = {box.x_m - 0.5 * box.length_m, box.x_m + 0.5 * box.length_m};
    const double y[2] = {box.y_m - 0.5 * box.width_m, box.y_m + 0.5 * box.width_m};
    const int order[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 at = to_parent(state.spot.pose, {x[order[i][0]], y[order[i][1]], 0.0});
        out[i] = {at.x, at.y};
    }
    return out;
}

double to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double square = glm::dot(along, along);
    const double share = square > 0.0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + share * along));
}

/// Separating axes: the normals of both boxes.
bool apart(const std::array<glm::dvec2, 4>& a, const std::array<glm::dvec2, 4>& b) {
    for (const auto* box : {&a, &b})
        for (std::size_t i = 0; i < 2; ++i) {
            const glm::dvec2 edge = (*box)[i + 1] - (*box)[i], normal(-edge.y, edge.x);
            double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
            for (std::size_t k = 0; k < 4; ++k) {
                const double at[2] = {glm::dot(a[k], normal), glm::dot(b[k], normal)};
                for (std::size_t w = 0; w < 2; ++w) {
                    low[w] = std::min(low[w], at[w]);
                    high[w] = std::max(high[w], at[w]);
                }
            }
            if (high[0] < low[1] || high[1] < low[0])
                return true;
        }
    return false;
}

double between_boxes(const EntityState& from, const EntityState& to) {
    const auto a = corners(from), b = corners(to);
    if (!apart(a, b))
        return 0.0;
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            nearest = std::min({nearest, to_segment(a[i], b[k], b[(k + 1) % 4]), to_segment(b[i], a[k], a[(k + 1) % 4])});
    return nearest;
}

/// Gap between two intervals, with the sign of where the second lies.
double gap(double low_a, double high_a, double low_b, double high_b) {
    return low_b > high_a ? low_b - high_a : high_b < low_a ? high_b - low_a : 0.0;
}

/// Of the other's box in the first one's frame, along axis 0 or 1.
double gap_along(const EntityState& from, const EntityState& to, int axis) {
    const BoundingBox& box = from.entity->box;
    const double centre = axis == 0 ? box.x_m : box.y_m, half = 0.5 * (axis == 0 ? box.length_m : box.width_m);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const glm::dvec2& corner : corners(to)) {
        const double at = to_local(from.spot.pose, {corner.x, corner.y, from.spot.pose.position_m.z})[axis];
        low = std::min(low, at);
        high = std::max(high, at);
    }
    return gap(centre - half, centre + half, low, high);
}

/// Reference points' distance along the road less what the boxes take of it.
double gap_on_road(double ds, const EntityState& from, const EntityState& to) {
    const BoundingBox &a = from.entity->box, &b = to.entity->box;
    const double turned = std::cos(to.spot.heading_rad() - from.spot.heading_rad()) >= 0.0 ? 1.0 : -1.0;
    return gap(a.x_m - 0.5 * a.length_m, a.x_m + 0.5 * a.length_m, ds + turned * b.x_m - 0.5 * b.length_m,
               ds + turned * b.x_m + 0.5 * b.length_m);
}

} // namespace

std::optional<double> distance(const World& world, const EntityState& from, const Spot& to, const Measure& measure) {
    const glm::dvec3 apart = to.pose.position_m - from.spot.pose.position_m;
    if (measure.span == Span::straight)
        return measure.freespace ? std::max(0.0, glm::length(apart)) : std::hypot(apart.x, apart.y);
    if (measure.frame == Frame::entity || measure.frame == Frame::world || !from.spot.on_network || !to.on_network) {
        const glm::dvec3 local = measure.frame == Frame::world ? apart : to_local(from.spot.pose, to.pose.position_m);
        return measure.span == Span::longitudinal ? local.x : local.y;
    }
    if (measure.span == Span::longitudinal)
        return distance_along(world, from.spot, to);
    return (to.t_m - from.spot.t_m) * (from.spot.with_s() ? 1.0 : -1.0);
}

std::optional<double> distance(const World& world, const EntityState& from, const EntityState& to, const Measure& measure) {
    if (!measure.freespace)
        return distance(world, from, to.spot, measure);
    if (measure.span == Span::straight)
        return between_boxes(from, to);
    if (measure.frame == Frame::entity || measure.frame == Frame::world || !from.spot.on_network || !to.spot.on_network)
        return gap_along(from, to, measure.span == Span::longitudinal ? 0 : 1);
    if (measure.span == Span::lateral) {
        const double across = (to.spot.t_m - from.spot.t_m) * (from.spot.with_s() ? 1.0 : -1.0);
        const double half = 0.5 * from.entity->box.width_m, other = 0.5 * to.entity->box.width_m;
        return gap(-half, half, across - other, across + other);
    }
    const auto along = distance_along(world, from.spot, to.spot);
    return along ? std::optional(gap_on_road(*along, from, to)) : std::nullopt;
}

double longitudinal_gap(const World& world, const EntityState& from, const EntityState& to, bool freespace) {
    if (const auto along = distance(world, from, to, {Frame::road, Span::longitudinal, freespace}))
        return *along;
    return *distance(world, from, to, {Frame::entity, Span::longitudinal, freespace});
}

double way_to(const World& world, const EntityState& from, const Spot& to) {
    if (const auto along = distance_along(world, from.spot, to))
        return *along;
    const glm::dvec3 apart = to.pose.position_m - from.spot.pose.position_m;
    return std::copysign(std::hypot(apart.x, apart.y), to_local(from.spot.pose, to.pose.position_m).x);
}

bool touching(const EntityState& a, const EntityState& b) {
    const glm::dvec3 apart_m = a.spot.pose.position_m - b.spot.pose.position_m;
    return std::abs(apart_m.z) < std::max(a.entity->box.height_m, b.entity->box.height_m) && !apart(corners(a), corners(b));
}

} // namespace fernlicht::osc
