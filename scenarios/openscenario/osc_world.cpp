#include "scenarios/openscenario/osc_world.h"

#include "scenarios/roads/plan.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht::osc {
namespace {

glm::dmat3 turned(const glm::dmat3& axes, double yaw_rad) { return axes * axes_from_angles(yaw_rad, 0.0, 0.0); }

const Lane* lane_of(const Road& road, int id, double s_m) {
    for (const Lane& lane : section_at(road, s_m).lanes)
        if (lane.id == id)
            return &lane;
    return nullptr;
}

} // namespace

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

} // namespace fernlicht::osc
