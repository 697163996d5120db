#include "scenarios/roads/road_network.h"

#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

/// t of the outer edge of a lane whose inner edge lies at `inner_t`. A width below zero counts as zero.
double outer_edge(const Lane& lane, double inner_t, double offset, double ds) {
    const double side = lane.id > 0 ? 1.0 : -1.0;
    if (!lane.widths.empty())
        return inner_t + side * std::max(0.0, value_at(lane.widths, ds));
    if (lane.borders.empty())
        return inner_t;
    const double border = offset + value_at(lane.borders, ds);
    return side * std::max(side * inner_t, side * border); // a border inside its inner neighbour leaves no width
}

} // namespace

bool travels_with_s(const Road& road, const Lane& lane) {
    const bool usual = (lane.id < 0) != road.left_hand_traffic;
    return usual != lane.reversed;
}

const LaneSection& section_at(const Road& road, double s_m) {
    static const LaneSection none{};
    if (road.sections.empty())
        return none;
    const auto after = std::ranges::upper_bound(road.sections, s_m, {}, &LaneSection::s_m);
    return after == road.sections.begin() ? *after : *(after - 1);
}

LaneEdges lane_edges(const Road& road, const LaneSection& section, int lane_id, double s_m) {
    const double offset = value_at(road.lane_offset, s_m), ds = s_m - section.s_m;
    LaneEdges edges{offset, offset};
    if (lane_id == 0)
        return edges;
    // Lanes run from the leftmost to the rightmost: left ones are met from the end of their part, right ones from its beginning.
    const auto found = [&](auto lane, auto end) { // outwards from the centre
        for (; lane != end; ++lane)
            if ((lane_id > 0 && lane->id > 0 && lane->id <= lane_id) || (lane_id < 0 && lane->id < 0 && lane->id >= lane_id)) {
                edges = {edges.outer_t_m, outer_edge(*lane, edges.outer_t_m, offset, ds)};
                if (lane->id == lane_id)
                    return true;
            }
        return false;
    };
    if (lane_id > 0 ? found(section.lanes.rbegin(), section.lanes.rend()) : found(section.lanes.begin(), section.lanes.end()))
        return edges;
    throw std::out_of_range(fmt::format("road '{}' has no lane {} at s = {}", road.id, lane_id, s_m));
}

namespace {

void flip(auto&... values) { ((values = 0.0 - values), ...); } // not -value: no negative zeros

void flip(std::vector<Cubic>& pieces) {
    for (Cubic& piece : pieces)
        flip(piece.a, piece.b, piece.c, piece.d);
}

void mirror(Line&) {}
void mirror(Arc& arc) { flip(arc.curvature_per_m); }
void mirror(Spiral& spiral) {
    flip(spiral.start_per_m, spiral.end_per_m);
    for (glm::dvec2& step : spiral.steps_m)
        flip(step.y);
}
void mirror(Poly3& curve) { flip(curve.a, curve.b, curve.c, curve.d); } // its knots tell arc length against u, which stays
void mirror(ParamPoly3& curve) { flip(curve.av, curve.bv, curve.cv, curve.dv); }

void mirror(PlanElement& element) {
    flip(element.y_m, element.heading_rad);
    std::visit([](auto& shape) { mirror(shape); }, element.shape);
}

/// h(-t): each piece from its other end, the lines that the profile goes on with beyond its ends as pieces of their own.
void mirror(ShapeProfile& profile) {
    constexpr double beyond_m = 1000.0; // no road is wider
    std::vector<Cubic> pieces;
    const std::vector<Cubic>& old = profile.over_t;
    if (old.empty())
        return;
    for (std::size_t i = old.size(); i-- > 0;) {
        const Cubic& piece = old[i];
        const double length = i + 1 < old.size() ? old[i + 1].s0 - piece.s0 : beyond_m;
        pieces.push_back({0.0 - (piece.s0 + length), piece.a + length * (piece.b + length * (piece.c + length * piece.d)),
                          0.0 - (piece.b + length * (2.0 * piece.c + length * 3.0 * piece.d)), piece.c + 3.0 * length * piece.d,
                          0.0 - piece.d});
    }
    pieces.push_back({0.0 - old.front().s0, old.front().a, 0.0 - old.front().b, 0.0, 0.0});
    profile.over_t = std::move(pieces);
}

void mirror(RoadMark& mark, bool on_centre_lane) {
    for (RoadMark::Stripe& stripe : mark.stripes)
        flip(stripe.t_m);
    // Named from left to right on the centre lane, elsewhere from the inner side to the outer.
    if (on_centre_lane && mark.kind == MarkKind::solid_broken)
        mark.kind = MarkKind::broken_solid;
    else if (on_centre_lane && mark.kind == MarkKind::broken_solid)
        mark.kind = MarkKind::solid_broken;
}

void mirror(Lane& lane) {
    for (RoadMark& mark : lane.marks)
        mirror(mark, lane.id == 0);
    lane.id = -lane.id;
    flip(lane.borders);
    for (std::optional<int>* link : {&lane.predecessor, &lane.successor})
        if (*link)
            *link = -**link;
}

void mirror(RoadObject& object) {
    flip(object.t_m, object.heading_rad, object.roll_rad);
    for (glm::dvec3& corner : object.outline_m)
        flip(corner.y);
    std::ranges::reverse(object.outline_m); // round it the same way as before
    std::ranges::reverse(object.outline_base_m);
}

void mirror(Road& road) {
    road.left_hand_traffic = !road.left_hand_traffic;
    for (PlanElement& element : road.plan)
        mirror(element);
    flip(road.superelevation);
    flip(road.lane_offset);
    for (ShapeProfile& profile : road.shapes)
        mirror(profile);
    for (LaneSection& section : road.sections) {
        for (Lane& lane : section.lanes)
            mirror(lane);
        std::ranges::reverse(section.lanes);
    }
    for (RoadObject& object : road.objects)
        mirror(object);
    for (RoadSignal& signal : road.signals)
        flip(signal.t_m, signal.heading_offset_rad);
}

} // namespace

RoadNetwork mirrored(RoadNetwork network) {
    flip(network.offset_m.y, network.offset_heading_rad);
    for (Road& road : network.roads)
        mirror(road);
    for (Junction& junction : network.junctions)
        for (Junction::Connection& connection : junction.connections)
            for (auto& [from, to] : connection.lane_links)
                from = -from, to = -to;
    return network;
}

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
