#include "scenarios/openscenario/osc_world.h"

#include "scenarios/roads/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <queue>

namespace fernlicht::osc {
namespace {

constexpr int max_borders = 64;

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
    for (int i = 0; i < max_borders; ++i) {
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
    if ((walker.s < road.length_m || !end) && !lane_of(road, walker.lane, walker.s))
        walker.lane = nearest_lane(road, walker.s, from.t_m);
    return {world.on_lane(walker.road, walker.lane, walker.s, walker.offset, walker.heading), end};
}

namespace {

constexpr std::size_t max_places = 50'000;

std::size_t section_index(const Road& road, double s_m) {
    return road.sections.empty() ? 0 : static_cast<std::size_t>(&section_at(road, s_m) - road.sections.data());
}

/// Lanes beside that are driven the same way.
std::vector<LanePlace> beside(const RoadNetwork& network, const LanePlace& place) {
    std::vector<LanePlace> out;
    const Road& road = network.roads[place.road];
    for (const Lane& lane : road.sections[place.section].lanes)
        if (lane.id != 0 && lane.id != place.lane && std::abs(lane.id - place.lane) == 1 && lane.type == "driving" &&
            travels_with_s(road, lane) == place.with_s)
            out.push_back({place.road, place.section, lane.id, place.with_s});
    return out;
}

struct Reached {
    LanePlace place;
    double cost;
    std::size_t from; ///< into the list of reached places
};

/// From one place to another by lanes; the places on the way, both ends included.
std::vector<LanePlace> shortest(const RoadNetwork& network, const LanePlace& start, const Spot& goal, bool once_round) {
    const std::size_t goal_section = section_index(network.roads[goal.road], goal.s_m);
    const auto is_goal = [&](const LanePlace& place) {
        return place.road == goal.road && place.section == goal_section && (place.lane == goal.lane || goal.lane == 0);
    };
    std::vector<Reached> reached;
    std::map<std::tuple<std::size_t, std::size_t, int, bool>, double> known;
    using Item = std::pair<double, std::size_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
    const auto offer = [&](const LanePlace& place, double cost, std::size_t from) {
        const auto key = std::tuple(place.road, place.section, place.lane, place.with_s);
        if (const auto before = known.find(key); before != known.end() && before->second <= cost)
            return;
        known[key] = cost;
        reached.push_back({place, cost, from});
        open.emplace(cost, reached.size() - 1);
    };
    reached.push_back({start, 0.0, 0});
    open.emplace(0.0, 0);
    if (!once_round)
        known[{start.road, start.section, start.lane, start.with_s}] = 0.0;
    while (!open.empty() && reached.size() < max_places) {
        const std::size_t at = open.top().second;
        open.pop();
        const Reached here = reached[at];
        if (is_goal(here.place) && (at != 0 || !once_round)) {
            std::vector<LanePlace> way{here.place};
            for (std::size_t back = at; back != 0; back = reached[back].from)
                way.push_back(reached[reached[back].from].place);
            std::reverse(way.begin(), way.end());
            return way;
        }
        const LaneSection& section = network.roads[here.place.road].sections[here.place.section];
        for (const LanePlace& next : next_places(network, here.place))
            offer(next, here.cost + section.end_m - section.s_m, at);
        for (const LanePlace& next : beside(network, here.place))
            offer(next, here.cost + lane_change_m, at);
    }
    return {};
}

} // namespace

std::optional<RoadPath> plan_path(const World& world, const Spot& from, const std::vector<Spot>& goals) {
    const RoadNetwork& network = world.network();
    if (!from.on_network || goals.empty())
        return {};
    RoadPath path;
    path.goal = goals.back();
    LanePlace here{from.road, section_index(network.roads[from.road], from.s_m), from.lane, from.with_s()};
    double s = from.s_m;
    std::vector<LanePlace> all{here};
    for (std::size_t i = 0; i < goals.size(); ++i) {
        const Spot& goal = goals[i];
        if (!goal.on_network)
            return {};
        const bool here_already = goal.road == here.road && section_index(network.roads[goal.road], goal.s_m) == here.section;
        const bool behind = here_already && (here.with_s ? goal.s_m < s - 1e-6 : goal.s_m > s + 1e-6);
        if (behind && i == 0 && goals.size() > 1)
            continue;
        const std::vector<LanePlace> way = shortest(network, here, goal, behind);
        if (way.empty())
            return {};
        all.insert(all.end(), way.begin() + 1, way.end());
        here = way.back();
        s = goal.s_m;
    }
    for (const LanePlace& place : all) {
        if (path.steps.empty() || path.steps.back().road != place.road || path.steps.back().with_s != place.with_s)
            path.steps.push_back({place.road, place.with_s, place.lane, network.roads[place.road].length_m});
        path.steps.back().lane = place.lane;
    }
    return path;
}

namespace {

/// Roads in one direction, by links of roads and connections of junctions, lanes not looked at.
std::vector<std::pair<std::size_t, bool>> next_roads(const RoadNetwork& network, std::size_t at, bool with_s) {
    std::vector<std::pair<std::size_t, bool>> out;
    const Road& road = network.roads[at];
    const std::optional<RoadLink>& link = with_s ? road.successor : road.predecessor;
    if (!link)
        return out;
    const auto add = [&](const std::string& id, bool contact_start) {
        if (const Road* next = network.find(id))
            out.emplace_back(static_cast<std::size_t>(next - network.roads.data()), contact_start);
    };
    if (!link->is_junction) {
        add(link->id, link->contact_start);
        return out;
    }
    for (const Junction& junction : network.junctions)
        if (junction.id == link->id)
            for (const Junction::Connection& connection : junction.connections)
                if (connection.incoming_road == road.id)
                    add(connection.connecting_road, connection.contact_start);
    return out;
}

std::optional<double> one_way(const RoadNetwork& network, const Spot& from, const Spot& to, bool with_s, double max_m) {
    using Item = std::tuple<double, std::size_t, bool>; // distance to where the road is entered
    std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
    std::map<std::pair<std::size_t, bool>, double> known;
    const double to_end = with_s ? network.roads[from.road].length_m - from.s_m : from.s_m;
    for (const auto& [road, way] : next_roads(network, from.road, with_s))
        open.emplace(to_end, road, way);
    while (!open.empty()) {
        const auto [distance, road, way] = open.top();
        open.pop();
        if (distance > max_m)
            break;
        if (!known.try_emplace({road, way}, distance).second)
            continue;
        const double length = network.roads[road].length_m;
        if (road == to.road)
            return distance + (way ? to.s_m : length - to.s_m);
        for (const auto& [next, next_way] : next_roads(network, road, way))
            open.emplace(distance + length, next, next_way);
    }
    return {};
}

} // namespace

std::optional<double> distance_along(const World& world, const Spot& from, const Spot& to, double max_m) {
    if (!from.on_network || !to.on_network)
        return {};
    if (from.road == to.road)
        return (to.s_m - from.s_m) * (from.with_s() ? 1.0 : -1.0);
    const auto ahead = one_way(world.network(), from, to, from.with_s(), max_m);
    const auto behind = one_way(world.network(), from, to, !from.with_s(), max_m);
    if (ahead && (!behind || *ahead <= *behind))
        return ahead;
    return behind ? std::optional(-*behind) : std::nullopt;
}

} // namespace fernlicht::osc
