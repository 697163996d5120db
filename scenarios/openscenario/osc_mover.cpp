#include "scenarios/openscenario/osc_mover.h"

#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::osc {
namespace {

constexpr int most_borders = 64;

std::size_t section_towards(const Road& road, double s_m, bool with_s) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < road.sections.size(); ++i)
        if (with_s ? road.sections[i].s_m <= s_m : road.sections[i].s_m < s_m)
            at = i;
    return at;
}

struct Walker {
    const World& world;
    std::size_t road;
    int lane;
    double s, offset;
    bool with_s;    ///< of the movement
    double heading; ///< relative to the reference line

    const Road& on() const { return world.network().roads[road]; }

    /// The lane has become another: the offset goes on from the new one's centre, the place stays.
    void change_lane(int to) {
        offset += lane_centre_t(on(), lane, s) - lane_centre_t(on(), to, s);
        lane = to;
    }

    void enter(const LanePlace& place, bool keeps_place) {
        const glm::dvec3 before = surface_pose(world.network(), on(), s, lane_centre_t(on(), lane, s) + offset).position_m;
        const bool turned = place.with_s != with_s;
        const Road& to = world.network().roads[place.road];
        const LaneSection& section = to.sections[place.section];
        road = place.road;
        lane = place.lane;
        with_s = place.with_s;
        s = with_s ? section.s_m : section.end_m;
        offset = turned ? -offset : offset;
        heading += turned ? pi : 0.0;
        if (keeps_place) {
            const LaneEdges edges = lane_edges(to, section, lane, s);
            const Pose centre = surface_pose(world.network(), to, s, 0.5 * (edges.inner_t_m + edges.outer_t_m));
            offset = glm::dot(before - centre.position_m, centre.left());
        }
    }

    /// Where no lane is linked: the lane at the same place on the section or road that follows.
    bool enter_unlinked(std::size_t section) {
        const Road& here = on();
        const bool last = with_s ? section + 1 >= here.sections.size() : section == 0;
        if (!last) {
            const std::size_t next = with_s ? section + 1 : section - 1;
            const double t = lane_centre_t(here, lane, s) + offset;
            // The border's s belongs to the section that begins there.
            const double just = with_s ? here.sections[next].s_m : std::max(here.sections[next].s_m, s - 1e-6);
            lane = nearest_lane(here, just, t);
            s = just;
            offset = t - lane_centre_t(here, lane, s);
            return true;
        }
        const std::optional<RoadLink>& link = with_s ? here.successor : here.predecessor;
        const Road* to = link && !link->is_junction ? world.network().find(link->id) : nullptr;
        if (!to || to->sections.empty())
            return false;
        const double to_s = link->contact_start ? 0.0 : to->length_m;
        const bool turned = link->contact_start != with_s;
        const double t = (lane_centre_t(here, lane, s) + offset) * (turned ? -1.0 : 1.0);
        const std::size_t index = static_cast<std::size_t>(to - world.network().roads.data());
        const int there = nearest_lane(*to, to_s, t);
        enter({index, link->contact_start ? 0 : to->sections.size() - 1, there, link->contact_start}, false);
        offset = t - lane_centre_t(*to, there, to_s);
        return true;
    }

    /// Over the border at the end of `section`; false where nothing follows.
    bool cross(std::size_t section, RoadPath* path) {
        const bool leaves = with_s ? section + 1 >= on().sections.size() : section == 0;
        if (path && leaves && path->at + 1 < path->steps.size() && path->steps[path->at].road == road) {
            const std::size_t wanted = path->steps[path->at + 1].road;
            for (const int exit : {lane, path->steps[path->at].lane})
                for (const LanePlace& place : next_places(world.network(), {road, section, exit, with_s}))
                    if (place.road == wanted) {
                        enter(place, exit != lane);
                        ++path->at;
                        return true;
                    }
        }
        const auto places = next_places(world.network(), {road, section, lane, with_s});
        if (places.empty())
            return enter_unlinked(section);
        enter(places.front(), false);
        return true;
    }
};

} // namespace

Moved move_along(const World& world, const Spot& from, double distance_m, bool actual, RoadPath* path) {
    if (!from.on_network || world.network().roads[from.road].sections.empty() || distance_m == 0.0)
        return {from, false};
    double left = distance_m;
    if (actual) {
        const PlanPoint plan = plan_point(world.network().roads[from.road], from.s_m);
        const double bend = plan.heading_rate_per_m / std::max(plan.speed, 1e-9) * from.t_m;
        if (bend < 0.95) // beyond, the spot lies near the bend's centre
            left /= 1.0 - bend;
    }
    const bool forward = left > 0.0;
    Walker walker{world, from.road, from.lane, from.s_m, from.offset_m, from.with_s() == forward, from.relative_heading_rad};
    left = std::abs(left);
    bool end = false;
    for (int i = 0; i < most_borders; ++i) {
        const Road& road = walker.on();
        const std::size_t section = section_towards(road, walker.s, walker.with_s);
        const double border = walker.with_s ? road.sections[section].end_m : road.sections[section].s_m;
        const double room = std::abs(border - walker.s);
        if (left <= room) {
            walker.s += walker.with_s ? left : -left;
            break;
        }
        left -= room;
        walker.s = border;
        // At the border itself the lane must be one of this section for the links; s of a border belongs to the next.
        if (!walker.cross(section, path)) {
            end = true;
            break;
        }
    }
    const Road& road = walker.on();
    if (walker.s < road.length_m || !end) {
        const auto& lanes = section_at(road, walker.s).lanes;
        if (std::none_of(lanes.begin(), lanes.end(), [&](const Lane& lane) { return lane.id == walker.lane; }))
            walker.lane = nearest_lane(road, walker.s, from.t_m);
    }
    return {world.on_lane(walker.road, walker.lane, walker.s, walker.offset, walker.heading), end};
}

} // namespace fernlicht::osc
