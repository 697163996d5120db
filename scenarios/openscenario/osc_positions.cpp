#include "scenarios/openscenario/osc_mover.h"
#include "scenarios/openscenario/osc_path.h"
#include "scenarios/openscenario/osc_world.h"
#include "scenarios/roads/plan.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht::osc {
namespace {

struct Placing {
    const World& world;
    const Storyboard& storyboard;

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
    Spot oriented(Spot spot, const std::optional<Orientation>& orientation) const {
        if (!orientation)
            return spot;
        if (orientation->relative) {
            spot.relative_heading_rad += orientation->h_rad;
            spot.pose.axes = spot.pose.axes * axes_from_angles(orientation->h_rad, -orientation->p_rad, orientation->r_rad);
            return spot;
        }
        return world.at_point(spot.pose.position_m, true, orientation->h_rad, -orientation->p_rad, orientation->r_rad, spot.road);
    }

    Spot along_lane(std::size_t road_at, int lane, double s, double offset, const std::optional<Orientation>& orientation) const {
        const Road& on = world.network().roads[road_at];
        return oriented(world.on_lane(road_at, lane, s, offset, lane_direction_rad(on, lane, s)), orientation);
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
        return along_lane(at, p.lane, p.s_m, p.offset_m, p.orientation);
    }
    Spot operator()(const RoadPosition& p) const {
        const std::size_t at = road(p.road);
        check_s(at, p.s_m);
        const Road& on = world.network().roads[at];
        const double s = std::clamp(p.s_m, 0.0, on.length_m);
        const int lane = nearest_lane(on, s, p.t_m);
        return along_lane(at, lane, s, p.t_m - lane_centre_t(on, lane, s), p.orientation);
    }
    /// A place `ds` on from an entity along its road's reference line, over the borders of roads; offset and lane kept.
    Spot onwards(const Spot& from, double ds_m) const { return move_along(world, from, ds_m, false, nullptr).spot; }
    Spot operator()(const RelativeLanePosition& p) const {
        const Spot from = world.entity(p.entity).spot;
        const Spot there = onwards(from, p.ds_m);
        const Road& on = world.network().roads[there.road];
        // The driver's left is the higher lane when he travels with s.
        int lane = there.lane + p.lanes * (there.with_s() ? 1 : -1);
        if (there.lane != 0 && (lane == 0 || (lane > 0) != (there.lane > 0)))
            lane += lane <= 0 && there.lane > 0 ? -1 : lane >= 0 && there.lane < 0 ? 1 : 0;
        Spot spot = world.on_lane(there.road, lane, there.s_m, p.offset_m, there.with_s() ? 0.0 : pi);
        if (!p.orientation)
            spot = world.on_lane(there.road, lane, there.s_m, p.offset_m, lane_direction_rad(on, lane, there.s_m));
        return oriented(spot, p.orientation);
    }
    Spot operator()(const RelativeRoadPosition& p) const {
        const Spot there = onwards(world.entity(p.entity).spot, p.ds_m);
        const Road& on = world.network().roads[there.road];
        const double t = there.t_m + p.dt_m;
        const int lane = nearest_lane(on, there.s_m, t);
        return oriented(world.on_lane(there.road, lane, there.s_m, t - lane_centre_t(on, lane, there.s_m), there.with_s() ? 0.0 : pi),
                        p.orientation);
    }
    Spot operator()(const RelativePosition& p) const {
        const Spot& from = world.entity(p.entity).spot;
        const glm::dvec3 by(p.dx_m, p.dy_m, p.dz_m);
        const glm::dvec3 at = p.in_world ? from.pose.position_m + by : to_parent(from.pose, by);
        double heading = from.heading_rad();
        if (p.orientation)
            heading = p.orientation->h_rad + (p.orientation->relative ? heading : 0.0);
        else if (p.in_world)
            heading = 0.0;
        return world.at_point(at, p.dz_m != 0.0, heading, {}, {}, from.on_network ? std::optional(from.road) : std::nullopt);
    }
    Spot operator()(const RoutePosition& p) const {
        if (!p.current_entity.empty())
            return oriented(world.entity(p.current_entity).spot, p.orientation);
        // The route's first waypoint says where it begins and which way; along it roads are followed with the least turn.
        const Spot start = world.spot(p.route->waypoints.front().position);
        const Spot there = onwards(start, p.s_m);
        const Road& on = world.network().roads[there.road];
        const double s = there.s_m;
        const int lane = p.lane ? *p.lane : p.t_m ? nearest_lane(on, s, *p.t_m) : there.lane;
        const double offset = p.t_m ? *p.t_m - lane_centre_t(on, lane, s) : p.offset_m;
        return along_lane(there.road, lane, s, offset, p.orientation);
    }
    Spot operator()(const TrajectoryPosition& p) const {
        const Path path = build_path(*p.trajectory, world, {});
        const PathPoint point = path.at(p.s_m);
        const double left_x = -std::sin(point.heading_rad), left_y = std::cos(point.heading_rad);
        return oriented(world.at_point({point.x_m + p.t_m * left_x, point.y_m + p.t_m * left_y, point.z_m}, path.has_z, point.heading_rad),
                        p.orientation);
    }
};

} // namespace

Spot World::spot(const Position& position) const { return std::visit(Placing{*this, *storyboard_}, position); }

} // namespace fernlicht::osc
