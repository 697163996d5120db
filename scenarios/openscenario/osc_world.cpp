#include "scenarios/openscenario/osc_world.h"

#include "scenarios/openscenario/osc_path.h"
#include "scenarios/roads/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht::osc {
namespace {

glm::dmat3 turned(const glm::dmat3& axes, double yaw_rad) { return axes * axes_from_angles(yaw_rad, 0.0, 0.0); }

} // namespace

const Lane* lane_of(const Road& road, int id, double s_m) {
    for (const Lane& lane : section_at(road, s_m).lanes)
        if (lane.id == id)
            return &lane;
    return nullptr;
}

int nearest_lane(const Road& road, double s_m, double t_m) {
    if (const int on = lane_at(road, s_m, t_m); on != 0)
        return on;
    int best = 0;
    double nearest = HUGE_VAL;
    for (const Lane& lane : section_at(road, s_m).lanes) {
        if (lane.id == 0)
            continue;
        const LaneEdges edges = lane_edges(road, section_at(road, s_m), lane.id, s_m);
        const double width = std::abs(edges.outer_t_m - edges.inner_t_m);
        const double gap = std::abs(t_m - 0.5 * (edges.inner_t_m + edges.outer_t_m)) - 0.5 * width;
        if (width > 0.0 && gap < nearest) {
            nearest = gap;
            best = lane.id;
        }
    }
    return best;
}

double Spot::heading_rad() const { return std::atan2(pose.forward().y, pose.forward().x); }
bool Spot::with_s() const { return std::cos(relative_heading_rad) >= 0.0; }

double lane_direction_rad(const Road& road, int lane, double s_m) {
    const Lane* found = lane_of(road, lane, s_m);
    return found && lane != 0 && !travels_with_s(road, *found) ? pi : 0.0;
}

World::World(const Storyboard& storyboard, const RoadNetwork& network) : storyboard_(&storyboard), network_(&network), finder_(network) {
    parameters = storyboard.parameters;
    variables = storyboard.variables;
    for (const Entity& entity : storyboard.entities) {
        index_[entity.name] = entities_.size();
        entities_.emplace_back();
        entities_.back().entity = &entity;
    }
}

std::size_t World::index_of(const std::string& name) const {
    const auto found = index_.find(name);
    if (found == index_.end())
        throw PlaceError{fmt::format("found '{}'", printable(name)), "an entity of the scenario"};
    return found->second;
}
EntityState& World::entity(const std::string& name) { return entities_[index_of(name)]; }
const EntityState& World::entity(const std::string& name) const { return entities_[index_of(name)]; }

Spot World::on_lane(std::size_t index, int lane, double s_m, double offset_m, double relative_heading_rad) const {
    const Road& road = network_->roads[index];
    Spot spot;
    spot.on_network = true;
    spot.road = index;
    spot.lane = lane;
    spot.s_m = std::clamp(s_m, 0.0, road.length_m);
    spot.offset_m = offset_m;
    spot.relative_heading_rad = relative_heading_rad;
    if (lane != 0 && !lane_of(road, lane, spot.s_m))
        throw PlaceError{fmt::format("found a position on lane {} of road '{}' at s = {:.6g} m", lane, printable(road.id), spot.s_m),
                         "a lane that the road has there"};
    spot.t_m = lane_centre_t(road, lane, spot.s_m) + offset_m;
    spot.pose = surface_pose(*network_, road, spot.s_m, spot.t_m);
    spot.pose.axes = turned(spot.pose.axes, relative_heading_rad);
    return spot;
}

Spot World::at_point(const glm::dvec3& position_m, bool has_z, double heading_rad, std::optional<double> pitch_rad,
                     std::optional<double> roll_rad, std::optional<std::size_t> preferred) const {
    Spot spot;
    spot.pose = {position_m, axes_from_angles(heading_rad, pitch_rad.value_or(0.0), roll_rad.value_or(0.0))};
    const auto place = finder_.find({position_m.x, position_m.y}, heading_rad, preferred);
    if (!place)
        return spot;
    const Road& road = network_->roads[place->road];
    spot.on_network = true;
    spot.road = place->road;
    spot.s_m = place->s_m;
    spot.t_m = place->t_m;
    spot.lane = nearest_lane(road, place->s_m, place->t_m);
    spot.offset_m = place->t_m - lane_centre_t(road, spot.lane, place->s_m);
    spot.relative_heading_rad = std::remainder(heading_rad - plan_point(road, place->s_m).heading_rad, 2.0 * pi);
    const Pose surface = surface_pose(*network_, road, spot.s_m, spot.t_m);
    if (!has_z)
        spot.pose.position_m.z = surface.position_m.z;
    if (!pitch_rad && !roll_rad)
        spot.pose.axes = turned(surface.axes, spot.relative_heading_rad);
    return spot;
}

namespace {

struct Placing {
    const World& world;
    const Storyboard& storyboard;
    const std::optional<Orientation>& orientation;

    std::size_t road(const std::string& id) const {
        const Road* found = world.network().find(id);
        if (!found)
            throw PlaceError{fmt::format("found a position on road '{}'", printable(id)),
                             fmt::format("a road of {}", storyboard.road_file.string())};
        return static_cast<std::size_t>(found - world.network().roads.data());
    }
    void check_s(std::size_t index, double s_m) const {
        const Road& road = world.network().roads[index];
        if (!(s_m >= -0.5 && s_m <= road.length_m + 0.5))
            throw PlaceError{fmt::format("found s = {:.6g} m on road '{}'", s_m, printable(road.id)),
                             fmt::format("s from 0 to {:.6g} m", road.length_m)};
    }

    /// Turns a spot that looks along its lane as the orientation asks.
    Spot oriented(Spot spot) const {
        if (!orientation)
            return spot;
        if (orientation->relative) {
            spot.relative_heading_rad += orientation->h_rad;
            spot.pose.axes = spot.pose.axes * axes_from_angles(orientation->h_rad, -orientation->p_rad, orientation->r_rad);
            return spot;
        }
        return world.at_point(spot.pose.position_m, true, orientation->h_rad, -orientation->p_rad, orientation->r_rad, spot.road);
    }

    Spot along_lane(std::size_t road_at, int lane, double s, double offset) const {
        return oriented(world.on_lane(road_at, lane, s, offset, lane_direction_rad(world.network().roads[road_at], lane, s)));
    }

    Spot operator()(const WorldPosition& p) const {
        std::optional<double> pitch, roll;
        if (p.p_rad || p.r_rad) {
            pitch = -p.p_rad.value_or(0.0); // OpenSCENARIO's pitch is positive with the nose down
            roll = p.r_rad.value_or(0.0);
        }
        return world.at_point({p.x_m, p.y_m, p.z_m.value_or(0.0)}, p.z_m.has_value(), p.h_rad.value_or(0.0), pitch, roll);
    }
    Spot operator()(const LanePosition& p) const {
        const std::size_t at = road(p.road);
        check_s(at, p.s_m);
        return along_lane(at, p.lane, p.s_m, p.offset_m);
    }
    Spot operator()(const RoadPosition& p) const {
        const std::size_t at = road(p.road);
        check_s(at, p.s_m);
        const Road& on = world.network().roads[at];
        const double s = std::clamp(p.s_m, 0.0, on.length_m);
        const int lane = nearest_lane(on, s, p.t_m);
        return along_lane(at, lane, s, p.t_m - lane_centre_t(on, lane, s));
    }
    const Spot& spot_of(const std::string& entity) const {
        const EntityState& state = world.entity(entity);
        if (!state.placed)
            throw NoPlaceYet{
                {fmt::format("found a position relative to '{}', which has no place", printable(entity)), "an entity that has one by then"},
                entity};
        return state.spot;
    }
    /// A place `ds` on from an entity along its road's reference line, over the borders of roads; offset and lane kept.
    Spot onwards(const Spot& from, double ds_m) const { return move_along(world, from, ds_m, false, nullptr).spot; }
    Spot operator()(const RelativeLanePosition& p) const {
        const Spot there = onwards(spot_of(p.entity), p.ds_m);
        const Road& on = world.network().roads[there.road];
        // The driver's left is the higher lane when he travels with s.
        int lane = there.lane + p.lanes * (there.with_s() ? 1 : -1);
        if (there.lane != 0 && (lane == 0 || (lane > 0) != (there.lane > 0)))
            lane += lane <= 0 && there.lane > 0 ? -1 : lane >= 0 && there.lane < 0 ? 1 : 0;
        const double heading = orientation ? (there.with_s() ? 0.0 : pi) : lane_direction_rad(on, lane, there.s_m);
        return oriented(world.on_lane(there.road, lane, there.s_m, p.offset_m, heading));
    }
    Spot operator()(const RelativeRoadPosition& p) const {
        const Spot there = onwards(spot_of(p.entity), p.ds_m);
        const Road& on = world.network().roads[there.road];
        const double t = there.t_m + p.dt_m;
        const int lane = nearest_lane(on, there.s_m, t);
        return oriented(world.on_lane(there.road, lane, there.s_m, t - lane_centre_t(on, lane, there.s_m), there.with_s() ? 0.0 : pi));
    }
    Spot operator()(const RelativePosition& p) const {
        const Spot& from = spot_of(p.entity);
        const glm::dvec3 by(p.dx_m, p.dy_m, p.dz_m);
        const glm::dvec3 at = p.in_world ? from.pose.position_m + by : to_parent(from.pose, by);
        double heading = from.heading_rad();
        if (orientation)
            heading = orientation->h_rad + (orientation->relative ? heading : 0.0);
        else if (p.in_world)
            heading = 0.0;
        return world.at_point(at, p.dz_m != 0.0, heading, {}, {}, from.on_network ? std::optional(from.road) : std::nullopt);
    }
    Spot operator()(const RoutePosition& p) const {
        if (!p.current_entity.empty())
            return oriented(spot_of(p.current_entity));
        // The route's first waypoint says where it begins and which way; along it roads are followed with the least turn.
        const Spot start = world.spot(p.route->waypoints.front());
        const Spot there = onwards(start, p.s_m);
        const Road& on = world.network().roads[there.road];
        const double s = there.s_m;
        const int lane = p.lane ? *p.lane : p.t_m ? nearest_lane(on, s, *p.t_m) : there.lane;
        const double offset = p.t_m ? *p.t_m - lane_centre_t(on, lane, s) : p.offset_m;
        return along_lane(there.road, lane, s, offset);
    }
    Spot operator()(const TrajectoryPosition& p) const {
        const Path path = build_path(*p.trajectory, world, {});
        const PathPoint point = path.at(p.s_m);
        const double left_x = -std::sin(point.heading_rad), left_y = std::cos(point.heading_rad);
        return oriented(world.at_point({point.x_m + p.t_m * left_x, point.y_m + p.t_m * left_y, point.z_m}, path.has_z, point.heading_rad));
    }
};

} // namespace

Spot World::spot(const Position& position) const { return std::visit(Placing{*this, *storyboard_, position.orientation}, position.place); }

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
