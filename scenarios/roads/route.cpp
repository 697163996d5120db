// Distance along a lane's centre against s, in cells on which the geometry is smooth.
#include "scenarios/roads/route.h"

#include "scenarios/roads/plan.h"
#include "scenarios/roads/road_finder.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double longest_route_m = 5e6;

[[noreturn]] void refuse(const RoadNetwork& network, const Route::Start& start, const std::string& found, const std::string& expected) {
    const std::filesystem::path road_file = network.opened.empty() ? std::filesystem::path() : network.opened.front().path;
    throw InputError({start.asked_in.empty() ? road_file : start.asked_in, 0, 0, start.key}, found, expected);
}

std::string road_list(const RoadNetwork& network) {
    constexpr std::size_t most = 12;
    std::vector<std::string> ids;
    for (const Road& road : network.roads)
        if (ids.size() < most)
            ids.push_back(printable(road.id));
    const std::string more = network.roads.size() > most ? fmt::format(" and {} more", network.roads.size() - most) : "";
    return fmt::format("one of the roads {}{}", fmt::join(ids, ", "), more);
}

/// Outermost driving lane of at least this width on the side of the traffic rule, else on the other; 0 when there is none.
int outermost_driving_lane(const Road& road, double s, double narrowest_m) {
    const LaneSection& section = section_at(road, s);
    int best = 0;
    const auto usual = [&](int id) { return (id < 0) != road.left_hand_traffic; };
    for (const Lane& lane : section.lanes) {
        if (lane.type != "driving" || lane.id == 0)
            continue;
        if (const LaneEdges edges = lane_edges(road, section, lane.id, s); std::abs(edges.outer_t_m - edges.inner_t_m) < narrowest_m)
            continue;
        const bool better =
            best == 0 || (usual(lane.id) && !usual(best)) || (usual(lane.id) == usual(best) && std::abs(lane.id) > std::abs(best));
        if (better)
            best = lane.id;
    }
    return best;
}

/// A lane that a car fits on, else one that has yet to open.
int outermost_driving_lane(const Road& road, double s) {
    const int wide = outermost_driving_lane(road, s, 1.0);
    return wide != 0 ? wide : outermost_driving_lane(road, s, 0.0);
}

std::size_t start_road(const RoadNetwork& network, const Route::Start& start) {
    const std::string& id = start.road;
    for (std::size_t i = 0; i < network.roads.size(); ++i) {
        const Road& road = network.roads[i];
        if (id.empty() ? outermost_driving_lane(road, 0.0) != 0 : road.id == id)
            return i;
    }
    if (id.empty())
        refuse(network, {}, "the network has no road with driving lanes", "at least one"); // the road's fault
    refuse(network, start, fmt::format("found no road '{}'", printable(id)), road_list(network));
}

LanePlace start_place(const RoadNetwork& network, const Route::Start& start) {
    LanePlace place;
    place.road = start_road(network, start);
    const Road& road = network.roads[place.road];
    if (!(start.s_m >= 0.0 && start.s_m <= road.length_m))
        refuse(network, start, fmt::format("the start s = {} m lies outside road '{}'", start.s_m, road.id),
               fmt::format("a station from 0 to {} m", road.length_m));
    const LaneSection& section = section_at(road, start.s_m);
    place.section = static_cast<std::size_t>(&section - road.sections.data());
    place.lane = start.lane != 0 ? start.lane : outermost_driving_lane(road, start.s_m);
    std::vector<int> ids;
    for (const Lane& lane : section.lanes) {
        if (lane.id == place.lane && lane.id != 0) {
            place.with_s = travels_with_s(road, lane);
            return place;
        }
        if (lane.id != 0)
            ids.push_back(lane.id);
    }
    refuse(network, start,
           fmt::format("found no {} at s = {} m of road '{}'", place.lane == 0 ? "driving lane" : fmt::format("lane {}", place.lane),
                       start.s_m, road.id),
           ids.empty() ? "a road with lanes" : fmt::format("one of the lanes {}", fmt::join(ids, ", ")));
}

/// The way to go on: where `via` names a road that can be reached now or behind the connecting road, that one; else the least turn.
const LanePlace& choose(const RoadNetwork& network, const std::vector<LanePlace>& places, const std::string* via) {
    if (via)
        for (const LanePlace& place : places) {
            const Road& road = network.roads[place.road];
            const std::optional<RoadLink>& behind = place.with_s ? road.successor : road.predecessor;
            if (road.id == *via || (road.junction != "-1" && behind && !behind->is_junction && behind->id == *via))
                return place;
        }
    return places.front();
}

bool paved(const std::string& type) {
    static constexpr std::array<std::string_view, 19> types{
        "driving",  "shoulder",      "stop", "parking", "biking", "entry",    "exit",    "onRamp",     "offRamp",  "connectingRamp",
        "slipLane", "bidirectional", "bus",  "taxi",    "HOV",    "mwyEntry", "mwyExit", "restricted", "roadWorks"};
    return std::ranges::find(types, type) != types.end();
}

constexpr double longest_cell_m = 5.0;
constexpr double shortest_cell_m = 1e-9; ///< what lies between two borders that are the same but for rounding

/// Every s within (low, high) at which some polynomial of the road or of the section's lanes begins.
std::vector<double> borders(const Road& road, const LaneSection& section, double low, double high) {
    std::vector<double> at{low, high};
    const auto add = [&](double s) {
        if (s > low && s < high)
            at.push_back(s);
    };
    for (const PlanElement& element : road.plan)
        add(element.s_m);
    for (const auto* pieces : {&road.elevation, &road.superelevation, &road.lane_offset})
        for (const Cubic& piece : *pieces)
            add(piece.s0);
    for (const ShapeProfile& profile : road.shapes)
        add(profile.s_m);
    for (const Lane& lane : section.lanes)
        for (const auto* pieces : {&lane.widths, &lane.borders})
            for (const Cubic& piece : *pieces)
                add(section.s_m + piece.s0);
    std::sort(at.begin(), at.end());
    return at;
}

/// t of the lane's centre as one cubic over s = low .. high: through four inner points, exact where every width is one cubic.
Cubic centre_cubic(const Road& road, const LaneSection& section, int lane, double low, double high) {
    const double step = (high - low) / 5.0;
    std::array<double, 4> t{};
    for (std::size_t i = 0; i < 4; ++i) {
        const LaneEdges edges = lane_edges(road, section, lane, low + step * static_cast<double>(i + 1));
        t[i] = 0.5 * (edges.inner_t_m + edges.outer_t_m);
    }
    // Newton's divided differences at x = 1, 2, 3, 4 steps, written out in powers of x.
    const double d1 = t[1] - t[0], d2 = (t[2] - 2.0 * t[1] + t[0]) / 2.0, d3 = (t[3] - 3.0 * t[2] + 3.0 * t[1] - t[0]) / 6.0;
    const double a = t[0] - d1 + 2.0 * d2 - 6.0 * d3, b = d1 - 3.0 * d2 + 11.0 * d3, c = d2 - 6.0 * d3, d = d3;
    return {low, a, b / step, c / (step * step), d / (step * step * step)};
}

/// Metres along the lane's centre per metre of s.
double stretch(const SurfaceStrip& strip, const Cubic& centre, double s) {
    const SurfacePoint point = surface_point(strip, s, centre.at(s));
    return std::max(glm::length(point.by_s + centre.slope(s) * point.by_t), 1e-6);
}

} // namespace

Route::Route(const RoadNetwork& network, Start start, const std::vector<std::string>& via) : network_(&network) {
    struct Visit {
        LanePlace place;
        std::size_t met; ///< how many of `via`
        bool operator==(const Visit&) const = default;
    };
    std::vector<Visit> visits;
    LanePlace place = start_place(network, start);
    for (std::size_t met = 0;;) {
        if (met < via.size() && network.roads[place.road].id == via[met])
            ++met;
        if (std::ranges::find(visits, Visit{place, met}) != visits.end())
            break; // once round
        visits.push_back({place, met});
        const LaneSection& section = network.roads[place.road].sections[place.section];
        const double begin = place.with_s ? section.s_m : section.end_m, end = place.with_s ? section.end_m : section.s_m;
        legs_.push_back({place.road, place.lane, place.with_s, visits.size() == 1 ? start.s_m : begin, end, length_m_, place.section});
        add_cells(legs_.size() - 1);
        if (length_m_ > longest_route_m)
            refuse(
                network, start,
                fmt::format("the way from road '{}' is longer than {} km", network.roads[legs_.front().road].id, longest_route_m / 1000.0),
                "a shorter one");
        const std::vector<LanePlace> next = next_places(network, place);
        if (next.empty()) {
            if (met < via.size())
                refuse(
                    network, start,
                    fmt::format("the way does not meet road '{}': it ends on road '{}'", printable(via[met]), network.roads[place.road].id),
                    "roads that follow one another");
            break;
        }
        place = choose(network, next, met < via.size() ? &via[met] : nullptr);
    }
    if (visits.back().met < via.size())
        refuse(network, start, fmt::format("the way does not meet road '{}'", printable(via[visits.back().met])),
               "roads that follow one another");
    if (!(length_m_ > 0.0))
        refuse(network, start,
               fmt::format("lane {} of road '{}' ends at the start s = {} m: traffic on it moves towards {} s", legs_.front().lane,
                           network.roads[legs_.front().road].id, start.s_m, legs_.front().with_s ? "growing" : "falling"),
               "a start from which there is a way to go");
}

Route::Cut Route::cut(double distance_m) const {
    const Cell& cell = cell_at(distance_m);
    const double s = s_at(cell, distance_m);
    return {cell.to_s_m >= cell.from_s_m ? 1.0 : -1.0, cell.centre.at(s), cell.centre.slope(s), cut_at(cell.strip, s)};
}

Pose Route::pose(const Cut& cut, double offset_left_m) {
    const SurfacePoint point = surface_point(cut.surface, cut.centre_t_m + cut.side * offset_left_m);
    return pose_along(point, cut.side * (point.by_s + cut.centre_slope * point.by_t));
}

Pose Route::pose(double distance_m, double offset_left_m) const { return pose(cut(distance_m), offset_left_m); }

void Route::poses(double distance_m, std::span<const double> offsets_left_m, std::span<Pose> poses) const {
    const Cut across = cut(distance_m);
    for (std::size_t i = 0; i < poses.size(); ++i)
        poses[i] = pose(across, offsets_left_m[i]);
}

std::pair<std::string, double> Route::place(double distance_m) const {
    const Cell& cell = cell_at(distance_m);
    return {network_->roads[legs_[cell.leg].road].id, s_at(cell, distance_m)};
}

CrossSection Route::cross_section(double distance_m) const {
    const Cell& cell = cell_at(distance_m);
    const Leg& leg = legs_[cell.leg];
    const Road& road = network_->roads[leg.road];
    const LaneSection& section = road.sections[leg.section];
    const double s = s_at(cell, distance_m), centre = cell.centre.at(s), side = leg.with_s ? 1.0 : -1.0;
    CrossSection cross;
    for (const Lane& lane : section.lanes) {
        if (lane.id == 0)
            continue;
        const LaneEdges edges = lane_edges(road, section, lane.id, s);
        const double a = side * (edges.inner_t_m - centre), b = side * (edges.outer_t_m - centre);
        constexpr double narrowest_m = 0.001;
        if (lane.id != leg.lane && std::abs(a - b) < narrowest_m)
            continue;
        cross.lanes.push_back({"", lane.type, lane.id, travels_with_s(road, lane) == leg.with_s, std::max(a, b), std::min(a, b)});
    }
    if (!leg.with_s)
        std::reverse(cross.lanes.begin(), cross.lanes.end());
    const auto own = std::ranges::find(cross.lanes, leg.lane, &RouteLane::road_lane_id);
    for (auto lane = cross.lanes.begin(); lane != cross.lanes.end(); ++lane) {
        const auto steps = lane - own;
        lane->name = steps == 0 ? "own" : (steps < 0 ? "left " : "right ") + std::to_string(std::abs(steps));
        if (steps == 0 || paved(lane->type)) {
            cross.paved_left_m = std::max(cross.paved_left_m, lane->left_m);
            cross.paved_right_m = std::min(cross.paved_right_m, lane->right_m);
        }
    }
    return cross;
}

void Route::add_cells(std::size_t leg_index) {
    const Leg leg = legs_[leg_index];
    const Road& road = network_->roads[leg.road];
    const LaneSection& section = road.sections[leg.section];
    std::vector<double> at = borders(road, section, std::min(leg.from_s_m, leg.to_s_m), std::max(leg.from_s_m, leg.to_s_m));
    if (!leg.with_s)
        std::reverse(at.begin(), at.end());
    for (std::size_t i = 1; i < at.size(); ++i) {
        const double span = at[i] - at[i - 1];
        if (std::abs(span) < shortest_cell_m)
            continue;
        const double parts = std::ceil(std::abs(span) / longest_cell_m);
        for (double part = 0.0; part < parts; part += 1.0) {
            Cell cell{};
            cell.start_m = length_m_;
            cell.leg = leg_index;
            cell.from_s_m = at[i - 1] + span * part / parts;
            cell.to_s_m = part + 1.0 == parts ? at[i] : at[i - 1] + span * (part + 1.0) / parts;
            cell.strip = strip_at(road, 0.5 * (cell.from_s_m + cell.to_s_m));
            cell.centre = centre_cubic(road, section, leg.lane, std::min(cell.from_s_m, cell.to_s_m), std::max(cell.from_s_m, cell.to_s_m));
            const double ds = cell.to_s_m - cell.from_s_m;
            for (std::size_t n = 0; n < gauss_node.size(); ++n)
                cell.length_m += gauss_weight[n] * std::abs(ds) * stretch(cell.strip, cell.centre, cell.from_s_m + gauss_node[n] * ds);
            const double side = ds > 0.0 ? 1.0 : -1.0;
            cell.from_slope = side / stretch(cell.strip, cell.centre, cell.from_s_m);
            cell.to_slope = side / stretch(cell.strip, cell.centre, cell.to_s_m);
            length_m_ += cell.length_m;
            cells_.push_back(cell);
        }
    }
}

const Route::Cell& Route::cell_at(double distance_m) const {
    const auto after = std::ranges::upper_bound(cells_, distance_m, {}, &Cell::start_m);
    return after == cells_.begin() ? *after : *(after - 1);
}

/// Cubic Hermite interpolation between the cell's ends: right to 1e-5 in speed, some 10 micrometres in place, on spirals of radius 30 m.
double Route::s_at(const Cell& cell, double distance_m) const {
    const double along = std::clamp(distance_m - cell.start_m, 0.0, cell.length_m), x = along / cell.length_m;
    const double ds = cell.to_s_m - cell.from_s_m, a = cell.from_slope * cell.length_m, b = cell.to_slope * cell.length_m;
    return cell.from_s_m + x * (a + x * (3.0 * ds - 2.0 * a - b + x * (a + b - 2.0 * ds)));
}

} // namespace fernlicht
