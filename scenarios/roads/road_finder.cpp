#include "scenarios/roads/road_finder.h"

#include "scenarios/roads/plan.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double sample_m = 4.0, cell_m = 32.0;
constexpr int max_samples_a_road = 100'000;

std::int64_t key(std::int64_t column, std::int64_t row) { return column * 0x1'0000'0000 + row; }
std::int64_t cell_of(double at_m) { return static_cast<std::int64_t>(std::floor(at_m / cell_m)); }

/// How far beside the outermost lanes; 0 on them.
double beyond_lanes(const Road& road, const RoadPlace& place) {
    if (road.sections.empty() || place.lane != 0)
        return place.lane != 0 ? 0.0 : std::abs(place.t_m);
    const LaneSection& section = section_at(road, place.s_m);
    if (section.lanes.empty())
        return std::abs(place.t_m);
    const double left = lane_edges(road, section, section.lanes.front().id, place.s_m).outer_t_m;
    const double right = lane_edges(road, section, section.lanes.back().id, place.s_m).outer_t_m;
    return std::max({place.t_m - left, right - place.t_m, 0.0});
}

} // namespace

int lane_at(const Road& road, double s_m, double t_m) {
    const LaneSection& section = section_at(road, s_m);
    for (const Lane& lane : section.lanes) {
        if (lane.id == 0)
            continue;
        const LaneEdges edges = lane_edges(road, section, lane.id, s_m);
        const double low = std::min(edges.inner_t_m, edges.outer_t_m), high = std::max(edges.inner_t_m, edges.outer_t_m);
        if (high > low && t_m >= low && t_m <= high)
            return lane.id;
    }
    return 0;
}

double lane_centre_t(const Road& road, int lane, double s_m) {
    const LaneEdges edges = lane_edges(road, section_at(road, s_m), lane, s_m);
    return 0.5 * (edges.inner_t_m + edges.outer_t_m);
}

RoadFinder::RoadFinder(const RoadNetwork& network) : network_(&network) {
    for (std::size_t r = 0; r < network.roads.size(); ++r) {
        const Road& road = network.roads[r];
        if (road.plan.empty() || !(road.length_m > 0.0))
            continue;
        const int steps = std::clamp(static_cast<int>(std::ceil(road.length_m / sample_m)), 1, max_samples_a_road);
        for (int i = 0; i <= steps; ++i) {
            const double s = road.length_m * i / steps;
            const PlanPoint point = plan_point(road, s);
            cells_[key(cell_of(point.x_m), cell_of(point.y_m))].push_back(samples_.size());
            samples_.push_back({r, s, point.x_m, point.y_m});
        }
    }
}

std::vector<RoadFinder::Nearest> RoadFinder::nearest_samples(const glm::dvec2& point_m) const {
    std::unordered_map<std::size_t, Nearest> by_road;
    const auto look = [&](const Sample& sample) {
        const double dx = sample.x_m - point_m.x, dy = sample.y_m - point_m.y, square = dx * dx + dy * dy;
        const auto [known, fresh] = by_road.try_emplace(sample.road, Nearest{&sample, square});
        if (!fresh && square < known->second.square)
            known->second = {&sample, square};
    };
    const std::int64_t column = cell_of(point_m.x), row = cell_of(point_m.y);
    for (std::int64_t c = column - 1; c <= column + 1; ++c)
        for (std::int64_t r = row - 1; r <= row + 1; ++r)
            if (const auto cell = cells_.find(key(c, r)); cell != cells_.end())
                for (const std::size_t i : cell->second)
                    look(samples_[i]);
    if (by_road.empty()) // far from every road
        for (const Sample& sample : samples_)
            look(sample);
    std::vector<Nearest> found;
    for (const auto& [road, nearest] : by_road)
        found.push_back(nearest);
    std::sort(found.begin(), found.end(), [](const Nearest& a, const Nearest& b) { // of equal ones the first road: the same everywhere
        return a.square != b.square ? a.square < b.square : a.sample->road < b.sample->road;
    });
    return found;
}

std::optional<RoadPlace> RoadFinder::refined(const Sample& sample, const glm::dvec2& point_m) const {
    const Road& road = network_->roads[sample.road];
    const auto along = [&](double at) { // how far the point lies ahead of the reference line's normal at `at`
        const PlanPoint plan = plan_point(road, at);
        return (point_m.x - plan.x_m) * std::cos(plan.heading_rad) + (point_m.y - plan.y_m) * std::sin(plan.heading_rad);
    };
    // Bisection between the neighbours of the nearest sample: sure also where the curve bends tightly.
    double low = std::max(0.0, sample.s_m - 1.5 * sample_m), high = std::min(road.length_m, sample.s_m + 1.5 * sample_m);
    double s = sample.s_m;
    if (along(low) <= 0.0) {
        s = low;
    } else if (along(high) >= 0.0) {
        s = high;
    } else {
        for (int i = 0; i < 60 && high - low > 1e-9; ++i) {
            s = 0.5 * (low + high);
            (along(s) > 0.0 ? low : high) = s;
        }
    }
    const PlanPoint plan = plan_point(road, s);
    const double t = -(point_m.x - plan.x_m) * std::sin(plan.heading_rad) + (point_m.y - plan.y_m) * std::cos(plan.heading_rad);
    return RoadPlace{sample.road, s, t, lane_at(road, s, t)};
}

std::optional<RoadPlace> RoadFinder::find(const glm::dvec2& point_m, std::optional<double> heading_rad,
                                          std::optional<std::size_t> preferred) const {
    std::optional<RoadPlace> best;
    double best_score = HUGE_VAL;
    for (const Nearest& nearest : nearest_samples(point_m)) {
        const auto place = refined(*nearest.sample, point_m);
        const Road& road = network_->roads[place->road];
        const PlanPoint plan = plan_point(road, place->s_m);
        const double gap = std::hypot(point_m.x - plan.x_m, point_m.y - plan.y_m) - std::abs(place->t_m); // beyond an end
        double score = beyond_lanes(road, *place) + std::max(gap, 0.0) * 2.0;
        if (heading_rad)
            score += 1e-3 * std::abs(std::remainder(*heading_rad - plan.heading_rad, pi)); // either way
        if (preferred && *preferred == place->road)
            score -= 0.1;
        if (score < best_score) {
            best_score = score;
            best = place;
        }
    }
    return best;
}

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
