#include "scenarios/dressing/dresser.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {

const Lane& outer_lane(const Road& road, double s_m, bool left) {
    const LaneSection& section = section_at(road, s_m);
    return left ? section.lanes.front() : section.lanes.back();
}

double outer_edge_m(const Road& road, double s_m, bool left) {
    const Lane& lane = outer_lane(road, s_m, left);
    return lane.id == 0 ? 0.0 : lane_edges(road, section_at(road, s_m), lane.id, s_m).outer_t_m;
}

double edge_height_m(const Road& road, double s_m, bool left) {
    const Lane& lane = outer_lane(road, s_m, left);
    return lane.heights.empty() ? 0.0 : lane.heights.front().outer_m;
}

bool is_walked(const Lane& lane) { return lane.type == "sidewalk" || lane.type == "walking"; }

bool has_ditch(const Road& road, bool left, std::pair<double, double> s_m, std::uint64_t seed, bool mirrored) {
    constexpr double share = 0.6, nearest_m = 1.0, farthest_m = 5.5;
    const auto dug_at = [&](double s) {
        return !is_walked(outer_lane(road, s, left)) &&
               Dice(seed, fmt::format("ditch, road {} {} {}", road.id, left != mirrored ? "left" : "right", std::floor(s / field_m)))
                       .share() < share;
    };
    if (road.junction != "-1" || !dug_at(s_m.first) || !dug_at(s_m.second))
        return false;
    const auto stands_in_it = [&](double s, double t, double reach_m) {
        if (s + reach_m < s_m.first || s - reach_m > s_m.second)
            return false;
        const double edge = outer_edge_m(road, std::clamp(s, 0.0, road.length_m), left), out = left ? t - edge : edge - t;
        return out + reach_m > nearest_m && out - reach_m < farthest_m;
    };
    return std::ranges::none_of(road.objects,
                                [&](const RoadObject& o) {
                                    return stands_in_it(o.s_m, o.t_m, std::max({o.radius_m, 0.5 * std::hypot(o.length_m, o.width_m), 0.3}));
                                }) &&
           std::ranges::none_of(road.signals,
                                [&](const RoadSignal& o) { return stands_in_it(o.s_m, o.t_m, std::max(0.5 * o.width_m, 0.3)); });
}

/// A hedge or a fence along the road, half-way between sidewalk and front, where the house stands along the road and leaves 2.5 m.
void Dresser::add_garden(const Road& road, const RoadObject& object, Dice drawn, const std::string& name) {
    const double kind = drawn.share();
    if (kind > 0.75 || std::abs(std::sin(object.heading_rad)) > 0.05 || object.t_m == 0.0)
        return;
    const double side = object.t_m > 0.0 ? 1.0 : -1.0, front = std::abs(object.t_m) - 0.5 * object.width_m;
    double edge = 0.0;
    for (const double s : {-0.5, 0.0, 0.5})
        edge = std::max(edge, side * outer_edge_m(road, object.s_m + s * object.length_m, side > 0.0));
    if (front - edge < 2.5)
        return;
    const double out = edge + std::clamp(0.3 * (front - edge), 0.7, 1.5), length = object.length_m - 2.4;
    RoadObject row;
    row.s_m = object.s_m + (drawn.share() < 0.5 ? 1.2 : -1.2);
    row.t_m = side * out;
    row.heading_rad = object.heading_rad;
    row.z_offset_m = edge_height_m(road, row.s_m, side > 0.0) - ground_drop_m(out - edge);
    if (length < 3.0 || row.s_m - 0.5 * length < 0.0 || row.s_m + 0.5 * length > road.length_m)
        return;
    const Pose pose = standing(network_, road, row);
    if (route_.nearest_m(pose.position_m) > far_from_route_m)
        return;
    const int steps = 1 + static_cast<int>(length);
    for (int i = 0; i <= steps; ++i)
        if (!is_clear(road, to_parent(pose, {(static_cast<double>(i) / steps - 0.5) * length, 0.0, 0.0}), 0))
            return;
    if (kind < 0.45) {
        const double height = drawn.between(0.9, 1.5), width = drawn.between(0.6, 0.9);
        add(dressed_hedge(length, width, height, 0.4, drawn), pose, "hedge of " + name);
    } else
        add(dressed_fence(length, drawn.between(0.8, 1.1), 0.3), pose, "fence of " + name);
}

/// One every 40 to 90 m on each sidewalk, going one way or the other, an arm's length from its outer edge; one in six on a bicycle.
void Dresser::add_people(const Road& road) {
    if (road.junction != "-1")
        return;
    for (const bool left : {true, false}) {
        Dice drawn(settings_.seed, fmt::format("people, road {} {}", road.id, left ? "left" : "right"));
        for (double s = drawn.between(10.0, 40.0); s < road.length_m - 5.0; s += drawn.between(40.0, 90.0)) {
            const Lane& lane = outer_lane(road, s, left);
            const bool back = drawn.share() < 0.5, dark = drawn.share() < 0.7;
            const auto draw = static_cast<std::uint32_t>(drawn.of(6));
            const double height = drawn.between(1.58, 1.88), tone = dark ? drawn.between(0.03, 0.08) : drawn.between(0.25, 0.5);
            if (!is_walked(lane))
                continue;
            const LaneEdges edges = lane_edges(road, section_at(road, s), lane.id, s);
            if (std::abs(edges.outer_t_m - edges.inner_t_m) < 1.2)
                continue;
            RoadObject place;
            place.s_m = s;
            place.t_m = edges.outer_t_m + (left ? -0.55 : 0.55);
            place.z_offset_m = edge_height_m(road, s, left);
            place.heading_rad = back ? pi : 0.0;
            const bool rides = draw == 5;
            const Pose pose = standing(network_, road, place);
            const auto clear = [&](double ahead_m) { return is_clear(road, to_parent(pose, {ahead_m, 0.0, 0.0}), lane.id); };
            if (route_.nearest_m(pose.position_m) > far_from_route_m || !clear(0.0) || (rides && (!clear(0.9) || !clear(-0.9))))
                continue;
            const glm::vec3 clothing(static_cast<float>(tone));
            if (rides)
                add_body(bicycle_body({{1.75, 0.6, height}, -0.4, clothing, true, draw}), pose,
                         fmt::format("cyclist, road {} s {:.0f}", road.id, s));
            else
                add_body(pedestrian_body({{0.5, 0.55, height}, -0.25, clothing, true, draw}), pose,
                         fmt::format("pedestrian, road {} s {:.0f}", road.id, s));
        }
    }
}

/// Before junctions, on the kerb's side of sidewalks, so that nobody parks there.
void Dresser::add_bollards(const Road& road) {
    constexpr double first_m = 4.0, apart_m = 1.8, from_kerb_m = 0.3;
    constexpr int count = 6;
    for (const bool at_end : {false, true}) {
        const std::optional<RoadLink>& link = at_end ? road.successor : road.predecessor;
        if (!link || !link->is_junction || road.length_m < 60.0)
            continue;
        for (const bool left : {true, false}) {
            TriangleSoup row;
            for (int i = 0; i < count; ++i) {
                const double s = first_m + apart_m * i;
                RoadObject place;
                place.s_m = at_end ? road.length_m - s : s;
                const Lane& lane = outer_lane(road, place.s_m, left);
                const LaneEdges edges = lane.id == 0 ? LaneEdges{} : lane_edges(road, section_at(road, place.s_m), lane.id, place.s_m);
                if (!is_walked(lane) || std::abs(edges.outer_t_m - edges.inner_t_m) < 1.5)
                    continue;
                place.t_m = edges.inner_t_m + (left ? from_kerb_m : -from_kerb_m);
                place.z_offset_m = edge_height_m(road, place.s_m, left);
                const Pose pose = standing(network_, road, place);
                if (is_clear(road, pose.position_m, lane.id))
                    append_placed(row, dressed_bollard(0.9).low, pose);
            }
            add_mesh(row, {}, fmt::format("bollards, road {} {} {}", road.id, at_end ? "end" : "start", left ? "left" : "right"), true,
                     true);
        }
    }
}

/// On the ground beside a road, so far out from its edge, level.
Pose Dresser::beside(const Road& road, double s_m, bool left, double out_m) const {
    const Pose edge = surface_pose(network_, road, s_m, outer_edge_m(road, s_m, left));
    const double yaw = std::atan2(edge.forward().y, edge.forward().x), side = left ? 1.0 : -1.0;
    return {edge.position_m + glm::dvec3(-std::sin(yaw) * side * out_m, std::cos(yaw) * side * out_m, -ground_drop_m(out_m)),
            axes_from_angles(yaw, 0.0, 0.0)};
}

/// The same, standing on the ground as it slopes.
Pose Dresser::grown_beside(const Road& road, double s_m, bool left, double out_m) const {
    constexpr double apart_m = 0.1;
    const auto at = [&](double s, double out) { return beside(road, s, left, out).position_m; };
    const double before = std::max(0.0, s_m - apart_m), after = std::min(road.length_m, s_m + apart_m);
    const glm::dvec3 forward = glm::normalize(at(after, out_m) - at(before, out_m)),
                     outward = at(s_m, out_m + apart_m) - at(s_m, out_m - apart_m),
                     up = glm::normalize(left ? glm::cross(forward, outward) : glm::cross(outward, forward));
    return {at(s_m, out_m), glm::dmat3(forward, glm::cross(up, forward), up)};
}

/// Whether nothing else is there: another road, or an object within so many metres.
bool Dresser::is_free(const Road& road, const glm::dvec3& place_m, double room_m) const {
    const std::optional<RoadPlace> on = finder_.find(glm::dvec2(place_m));
    return on && on->lane == 0 && &network_.roads[on->road] == &road && objects_.none_within(place_m, room_m);
}

/// Whether this lane of this road is there (0: beside all), and no object within 0.45 m of its footprint.
bool Dresser::is_clear(const Road& road, const glm::dvec3& place_m, int lane) const {
    const std::optional<RoadPlace> on = finder_.find(glm::dvec2(place_m));
    return on && on->lane == lane && &network_.roads[on->road] == &road && footprints_.none_within(place_m, 0.45);
}

/// Grass up to 5 cm above the road's edge, and farther out bushes and a field's fence; nothing of it beside sidewalks.
void Dresser::add_verge(const Road& road, bool left) {
    Dice drawn(settings_.seed, fmt::format("verge, road {} {}", road.id, left ? "left" : "right"));
    for (double from = 0.0; from < road.length_m; from += stretch_m) {
        TriangleSoup grass;
        const double to = std::min(from + stretch_m, road.length_m);
        Dice here = drawn.fork();
        Dice field(settings_.seed, fmt::format("field fence, road {} {} {}", road.id, left ? "left" : "right", std::floor(from / field_m)));
        const double fence_m = field.share() < 0.5 ? field.between(6.5, 9.0) : 0.0;
        if (is_walked(outer_lane(road, 0.5 * (from + to), left)) || road.junction != "-1" ||
            route_.nearest_m(beside(road, 0.5 * (from + to), left, 0.0).position_m) > far_from_route_m)
            continue;
        for (double s = from; s < to; s += here.between(0.6, 2.2)) {
            const double share = here.share(), out = 0.7 + 6.3 * share * share; // denser towards the road
            const Pose pose = grown_beside(road, s, left, out);
            const double most = ground_drop_m(out) + 0.05;
            const bool in_ditch = out > 2.0 && out < 4.5 && has_ditch(road, left, {s, s}, settings_.seed);
            if (!in_ditch && is_free(road, pose.position_m, 0.3)) {
                const Dice of_tuft = here.fork();
                append_placed(grass, dressed_tuft(std::min(0.45, most) * here.between(0.7, 1.0), of_tuft).low, pose);
            }
        }
        add_mesh(grass, {}, fmt::format("grass, road {} s {:.0f}-{:.0f}", road.id, from, to), true, false, false);
        for (double s = from + here.between(0.0, 50.0); s < to; s += here.between(20.0, 70.0)) {
            const double radius = here.between(0.6, 1.5);
            const Pose pose = beside(road, s, left, here.between(9.5, 15.0));
            if (is_free(road, pose.position_m, radius)) {
                const Dice of_bush = here.fork();
                add(dressed_bush(radius * here.between(1.0, 1.6), radius, of_bush), pose,
                    fmt::format("bush, road {} s {:.0f} {}", road.id, s, left ? "left" : "right"));
            }
        }
        TriangleSoup fence;
        bool open = fence_m > 0.0; // nothing stands in its way
        for (double s = from + 2.0; open && s + 2.0 <= to; s += 4.0) {
            const Pose a = beside(road, s - 2.0, left, fence_m), b = beside(road, s + 2.0, left, fence_m);
            const glm::dvec3 way = b.position_m - a.position_m, middle = 0.5 * (a.position_m + b.position_m);
            open = is_free(road, middle, 2.1);
            append_placed(fence, dressed_field_fence(glm::length(way)).low,
                          {middle, axes_from_angles(std::atan2(way.y, way.x), std::atan2(way.z, std::hypot(way.x, way.y)), 0.0)});
        }
        if (!open)
            continue;
        lay_pictures(fence);
        add_mesh(fence, {}, fmt::format("field fence, road {} s {:.0f}-{:.0f} {}", road.id, from, to, left ? "left" : "right"), true,
                 false);
    }
}

} // namespace fernlicht
