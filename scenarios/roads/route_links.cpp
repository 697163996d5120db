#include "scenarios/roads/road_finder.h"

#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

/// Where a file names no lane link, a lane that goes on within this distance is taken for the same lane.
constexpr double same_lane_m = 0.5;

struct End {
    glm::dvec3 centre_m; ///< of the lane, on the surface
    double heading_rad;  ///< of travel
};

/// Where the lane is entered (or left, with `leaving`) when followed in the place's direction.
End end_of(const RoadNetwork& network, const LanePlace& place, bool leaving) {
    const Road& road = network.roads[place.road];
    const LaneSection& section = road.sections[place.section];
    const double s = place.with_s == leaving ? section.end_m : section.s_m;
    const LaneEdges edges = lane_edges(road, section, place.lane, s);
    const double heading = plan_point(road, s).heading_rad;
    return {surface_pose(network, road, s, 0.5 * (edges.inner_t_m + edges.outer_t_m)).position_m, place.with_s ? heading : heading + pi};
}

/// The place in `section` that `lane_id` names; without a name, the lane whose centre goes on where `from` ends.
std::optional<LanePlace> enter(const RoadNetwork& network, const LanePlace& from, std::size_t road, std::size_t section, bool with_s,
                               std::optional<int> lane_id) {
    const Road& to = network.roads[road];
    if (lane_id)
        return lane_of(to.sections[section], *lane_id) ? std::optional(LanePlace{road, section, *lane_id, with_s}) : std::nullopt;
    const End left = end_of(network, from, true);
    std::optional<LanePlace> best;
    double nearest = same_lane_m;
    for (const Lane& lane : to.sections[section].lanes) {
        if (lane.id == 0 || travels_with_s(to, lane) != with_s)
            continue;
        const LanePlace place{road, section, lane.id, with_s};
        if (const double distance = glm::distance(end_of(network, place, false).centre_m, left.centre_m); distance < nearest) {
            nearest = distance;
            best = place;
        }
    }
    return best;
}

std::optional<LanePlace> enter_road(const RoadNetwork& network, const LanePlace& from, const std::string& id, bool contact_start,
                                    std::optional<int> lane_id) {
    const Road* road = network.find(id);
    if (!road)
        return {};
    return enter(network, from, static_cast<std::size_t>(road - network.roads.data()), contact_start ? 0 : road->sections.size() - 1,
                 contact_start, lane_id);
}

std::vector<LanePlace> through_junction(const RoadNetwork& network, const LanePlace& from, const std::string& id) {
    std::vector<LanePlace> places;
    const std::string& road_id = network.roads[from.road].id;
    for (const Junction& junction : network.junctions) {
        if (junction.id != id)
            continue;
        for (const Junction::Connection& connection : junction.connections) {
            if (connection.incoming_road != road_id)
                continue;
            if (connection.lane_links.empty())
                if (const auto place = enter_road(network, from, connection.connecting_road, connection.contact_start, {}))
                    places.push_back(*place);
            for (const auto& [from_lane, to_lane] : connection.lane_links)
                if (from_lane == from.lane)
                    if (const auto place = enter_road(network, from, connection.connecting_road, connection.contact_start, to_lane))
                        places.push_back(*place);
        }
    }
    return places;
}

/// A road may touch one junction with both its ends: only what begins near this end is meant, if anything does.
void keep_near(const RoadNetwork& network, const LanePlace& from, std::vector<LanePlace>& places) {
    constexpr double near_m = 2.0;
    const glm::dvec3 end = end_of(network, from, true).centre_m;
    const auto far = [&](const LanePlace& place) { return glm::distance(end_of(network, place, false).centre_m, end) > near_m; };
    if (!std::all_of(places.begin(), places.end(), far))
        std::erase_if(places, far);
}

/// Change of heading from the end of `from` to the far end of the road that `place` enters.
double turn(const RoadNetwork& network, const LanePlace& from, const LanePlace& place) {
    const Road& road = network.roads[place.road];
    const double exit = plan_point(road, place.with_s ? road.length_m : 0.0).heading_rad + (place.with_s ? 0.0 : pi);
    return std::abs(std::remainder(exit - end_of(network, from, true).heading_rad, 2.0 * pi));
}

} // namespace

const Lane* lane_of(const LaneSection& section, int id) {
    const auto lane = std::ranges::find(section.lanes, id, &Lane::id);
    return lane == section.lanes.end() || id == 0 ? nullptr : &*lane;
}

std::vector<LanePlace> next_places(const RoadNetwork& network, const LanePlace& from) {
    const Road& road = network.roads[from.road];
    const Lane* lane = lane_of(road.sections[from.section], from.lane);
    if (!lane)
        return {};
    const std::optional<int> link = from.with_s ? lane->successor : lane->predecessor;
    const bool last = from.with_s ? from.section + 1 == road.sections.size() : from.section == 0;
    const std::optional<RoadLink>& road_link = from.with_s ? road.successor : road.predecessor;
    if (last && !road_link)
        return {};
    if (!last || !road_link->is_junction) {
        const auto place = !last ? enter(network, from, from.road, from.with_s ? from.section + 1 : from.section - 1, from.with_s, link)
                                 : enter_road(network, from, road_link->id, road_link->contact_start, link);
        return place ? std::vector{*place} : std::vector<LanePlace>{};
    }
    std::vector<LanePlace> places = through_junction(network, from, road_link->id);
    keep_near(network, from, places);
    std::stable_sort(places.begin(), places.end(),
                     [&](const LanePlace& a, const LanePlace& b) { return turn(network, from, a) < turn(network, from, b); });
    return places;
}

} // namespace fernlicht
