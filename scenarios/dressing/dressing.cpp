#include "scenarios/dressing/dressing.h"

#include "scenarios/dressing/dressed_object.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/roads/road_finder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace fernlicht {
namespace {

enum class DressedKind { house, tree, bush, barrier, car, van, truck, bus };

/// Of the ground above its foot.
double sunk_m(const RoadObject& house) { return std::clamp(-house.z_offset_m, 0.0, 1.5); }

std::optional<DressedKind> dressed_kind(const RoadObject& o) {
    std::string type = o.type;
    std::ranges::transform(type, type.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (type == "tree" || (type == "vegetation" && o.height_m > 3.0))
        return DressedKind::tree;
    if (type == "vegetation" || type == "bush")
        return DressedKind::bush;
    if (o.outline_m.size() > 1 || o.radius_m > 0.0 || o.pitch_rad != 0.0 || o.roll_rad != 0.0)
        return std::nullopt;
    if (type == "building" && std::min({o.length_m, o.width_m, o.height_m}) >= smallest_house_m && o.height_m - sunk_m(o) >= lowest_house_m)
        return DressedKind::house;
    if (type == "barrier" && o.width_m <= 0.2 && o.height_m >= 0.2 && o.height_m <= 0.4 && o.z_offset_m > 0.2 && o.length_m > 0.5)
        return DressedKind::barrier;
    if (o.length_m < 3.0 || o.length_m > 20.0 || o.width_m < 1.2 || o.height_m < 1.1)
        return std::nullopt;
    static constexpr std::pair<std::string_view, DressedKind> vehicles[]{{"car", DressedKind::car},
                                                                         {"van", DressedKind::van},
                                                                         {"truck", DressedKind::truck},
                                                                         {"trailer", DressedKind::truck},
                                                                         {"bus", DressedKind::bus}};
    for (const auto& [word, look] : vehicles)
        if (type == word)
            return look;
    return std::nullopt;
}

double given_or(double value, double otherwise) { return value > 0.0 ? value : otherwise; }

/// From the side on what stands, from above on what lies, along its slope on a roof.
void lay_pictures(TriangleSoup& soup) {
    constexpr double repeat_m = 8.0; // as mesh_builder.h's texture_repeat_m
    for (SoupVertex& v : soup.vertices) {
        const bool lies = std::hypot(v.normal.x, v.normal.y) < 0.2;
        const glm::dvec3 u = lies ? glm::dvec3(1, 0, 0) : glm::normalize(glm::cross(glm::dvec3(0, 0, 1), v.normal));
        v.uv = glm::vec2(glm::dvec2(glm::dot(u, v.position_m), glm::dot(glm::cross(v.normal, u), v.position_m)) / repeat_m);
    }
}

void append_placed(TriangleSoup& into, const TriangleSoup& soup, const Pose& pose) {
    const auto before = static_cast<std::uint32_t>(into.vertices.size());
    for (const SoupVertex& v : soup.vertices)
        into.vertices.push_back({to_parent(pose, v.position_m), pose.axes * v.normal, v.uv});
    for (SoupTriangle t : soup.triangles) {
        for (std::uint32_t& corner : t.corners)
            corner += before;
        into.triangles.push_back(t);
    }
}

/// Places along the route, to ask how near it comes.
class Nearness {
  public:
    explicit Nearness(const Route& route) {
        for (double at = 0.0; at < route.length_m() + step_m; at += step_m)
            places_.push_back(route.pose(at).position_m);
    }
    /// Not farther than the true distance in plan.
    double nearest_m(const glm::dvec3& p) const {
        double least = std::numeric_limits<double>::infinity();
        for (const glm::dvec3& place : places_)
            least = std::min(least, std::hypot(place.x - p.x, place.y - p.y));
        return least - 0.5 * step_m;
    }

  private:
    static constexpr double step_m = 10.0;
    std::vector<glm::dvec3> places_;
};

constexpr double widest_m = 10.0; ///< of one place of an object, and of what it reaches

/// Where objects stand, in cells.
class Occupied {
  public:
    void add(const glm::dvec3& place_m, double reach_m) { cells_[cell(place_m, 0, 0)].emplace_back(place_m.x, place_m.y, reach_m); }
    /// A rectangle around a pose as places of squares, no side longer than `most_m`.
    void add_pieces(const Pose& pose, double length_m, double width_m, double most_m) {
        const auto pieces = [most_m](double side_m) { return static_cast<int>(std::clamp(std::ceil(side_m / most_m), 1.0, 1000.0)); };
        const int columns = pieces(length_m), rows = pieces(width_m);
        const double reach_m = 0.5 * std::hypot(length_m / columns, width_m / rows);
        for (int column = 0; column < columns; ++column)
            for (int row = 0; row < rows; ++row)
                add(to_parent(pose, {((column + 0.5) / columns - 0.5) * length_m, ((row + 0.5) / rows - 0.5) * width_m, 0.0}), reach_m);
    }
    /// `room_m` up to 6 m.
    bool none_within(const glm::dvec3& place_m, double room_m) const {
        for (long x = -1; x <= 1; ++x)
            for (long y = -1; y <= 1; ++y)
                if (const auto there = cells_.find(cell(place_m, x, y)); there != cells_.end())
                    for (const glm::dvec3& other : there->second)
                        if (std::hypot(other.x - place_m.x, other.y - place_m.y) < room_m + other.z)
                            return false;
        return true;
    }

  private:
    static std::pair<long, long> cell(const glm::dvec3& p, long dx, long dy) {
        return {std::lround(std::floor(p.x / 16.0)) + dx, std::lround(std::floor(p.y / 16.0)) + dy};
    }
    std::map<std::pair<long, long>, std::vector<glm::dvec3>> cells_;
};

class Dresser {
  public:
    Dresser(Scene& scene, const RoadNetwork& network, const Route& route, const DressingSettings& settings)
        : scene_(scene), network_(network), settings_(settings), route_(route), finder_(network),
          first_(add_dressing_materials(scene, settings.textures, settings.seed)) {
        for (const Road& road : network.roads)
            for (const RoadObject& object : road.objects)
                if (object.height_m > 0.3)
                    occupy(road, object);
    }

    void dress(const Road& road) {
        std::map<long, TriangleSoup> barriers; ///< in the world, by stretch
        for (const RoadObject& object : road.objects)
            if (const std::optional<DressedKind> look = dressed_kind(object))
                add(road, object, *look, barriers);
        for (auto& [stretch, soup] : barriers)
            add_mesh(soup, {}, fmt::format("crash barrier, road {} s {}-{}", road.id, stretch * stretch_m, (stretch + 1) * stretch_m),
                     false);
        add_people(road);
        for (const bool left : {true, false})
            add_verge(road, left);
    }

  private:
    static constexpr long stretch_m = 60;
    static constexpr double far_from_route_m = 300.0; ///< beyond it verges stay bare

    void occupy(const Road& road, const RoadObject& object) {
        const double length = std::max(object.length_m, 2.0 * object.radius_m), width = std::max(object.width_m, 2.0 * object.radius_m);
        const Pose foot = standing(network_, road, object);
        if (const double room = std::max(object.radius_m, 0.5 * std::hypot(object.length_m, object.width_m)); room <= widest_m)
            objects_.add(foot.position_m, room);
        else
            objects_.add_pieces(foot, length, width, widest_m);
        if (dressed_kind(object) == DressedKind::tree)
            footprints_.add(foot.position_m, 0.4); // its trunk: there is room under the crown
        else
            footprints_.add_pieces(foot, length, width, 1.0);
    }

    Dice dice(const Road& road, const RoadObject& object) const {
        return {settings_.seed, fmt::format("{} {} {:.3f} {:.3f}", road.id, object.id, object.s_m, object.t_m)};
    }

    void add(const Road& road, const RoadObject& object, DressedKind look, std::map<long, TriangleSoup>& barriers) {
        const Pose foot = standing(network_, road, object);
        const double across = std::max(object.length_m, object.width_m);
        const std::string name = fmt::format("{} {}", object.name.empty() ? object.type : object.name, object.id);
        switch (look) {
        case DressedKind::house:
            return add_house(road, object, foot, name);
        case DressedKind::tree: {
            const double height = given_or(object.height_m, 8.0), radius = given_or(object.radius_m, given_or(0.5 * across, 0.22 * height));
            return add(dressed_tree(height, radius, dice(road, object), detail(foot, far_tree_error * radius)), foot, name);
        }
        case DressedKind::bush: {
            const double height = given_or(object.height_m, 1.5);
            return add(dressed_bush(height, given_or(object.radius_m, given_or(0.5 * across, 0.5 * height)), dice(road, object)), foot,
                       name);
        }
        case DressedKind::barrier:
            return append_placed(barriers[static_cast<long>(std::floor(object.s_m / stretch_m))],
                                 dressed_guard_rail(object.length_m, object.width_m, object.height_m, object.t_m < 0.0).low, foot);
        default:
            return add_vehicle(object, look, foot, name, dice(road, object));
        }
    }

    Detail detail(const Pose& foot, double error_m) const {
        return route_.nearest_m(foot.position_m) > error_m / settings_.pixel_rad ? Detail::far : Detail::near;
    }

    void add_mesh(const TriangleSoup& soup, const Pose& pose, const std::string& name, bool whole, bool casts = true) {
        if (soup.triangles.empty())
            return;
        TriangleSoup placed;
        append_placed(placed, soup, pose);
        std::vector<std::size_t> all(soup.triangles.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        Mesh mesh = mesh_of(placed, all, glm::round(placed.vertices.front().position_m), name);
        for (Batch& batch : mesh.batches)
            batch.material += first_;
        mesh.whole = whole;
        mesh.casts = casts;
        scene_.meshes.push_back(std::move(mesh));
    }

    void add(DressedObject object, const Pose& pose, const std::string& name) {
        for (TriangleSoup* soup : {&object.low, &object.high}) {
            if (!object.has_places)
                lay_pictures(*soup);
            add_mesh(*soup, pose, name, true);
        }
    }

    void add_house(const Road& road, const RoadObject& object, const Pose& foot, const std::string& name) {
        Dice drawn = dice(road, object);
        const glm::dvec3 to_road = glm::transpose(foot.axes) * (surface_pose(network_, road, object.s_m, 0.0).position_m - foot.position_m);
        const bool turned = object.width_m > object.length_m; // the ridge runs along the longer side
        Pose pose = foot;
        if (turned)
            pose.axes = foot.axes * axes_from_angles(0.5 * pi, 0.0, 0.0);
        const HouseSize size{std::max(object.length_m, object.width_m), std::min(object.length_m, object.width_m), object.height_m,
                             sunk_m(object), turned ? to_road.x < 0.0 : to_road.y > 0.0};
        add(dressed_house(size, drawn, detail(foot, far_house_error_m)), pose, name);
        add_garden(road, object, drawn, name);
    }

    /// A hedge or a fence along the road, half-way between sidewalk and front, where the house stands along the road and leaves 2.5 m.
    void add_garden(const Road& road, const RoadObject& object, Dice drawn, const std::string& name) {
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
        if (kind < 0.45)
            add(dressed_hedge(length, drawn.between(0.6, 0.9), drawn.between(0.9, 1.5), 0.4, drawn), pose, "hedge of " + name);
        else
            add(dressed_fence(length, drawn.between(0.8, 1.1), 0.3), pose, "fence of " + name);
    }

    static double outer_edge_m(const Road& road, double s_m, bool left) {
        const LaneSection& section = section_at(road, s_m);
        const Lane& lane = left ? section.lanes.front() : section.lanes.back();
        return lane.id == 0 ? 0.0 : lane_edges(road, section, lane.id, s_m).outer_t_m;
    }
    /// Of the outermost lane above the road's surface: a sidewalk's.
    static double edge_height_m(const Road& road, double s_m, bool left) {
        const LaneSection& section = section_at(road, s_m);
        const Lane& lane = left ? section.lanes.front() : section.lanes.back();
        return lane.heights.empty() ? 0.0 : lane.heights.front().outer_m;
    }

    void add_body(const Model& model, const Pose& pose, const std::string& name) {
        const std::size_t before = scene_.meshes.size();
        add_model(scene_, model, pose, 1.0, SurfaceKind::vehicle);
        for (std::size_t i = before; i < scene_.meshes.size(); ++i) {
            scene_.meshes[i].name = name;
            scene_.meshes[i].whole = true;
        }
    }

    void add_vehicle(const RoadObject& object, DressedKind look, const Pose& foot, const std::string& name, Dice drawn) {
        // Shares of new cars by colour, as often counted: grey, white, black, blue, red, the rest (docs/scenery.md).
        static constexpr std::array<glm::vec3, 6> paints{
            glm::vec3(0.17F), glm::vec3(0.60F), glm::vec3(0.04F), glm::vec3(0.05F, 0.1F, 0.25F), glm::vec3(0.3F, 0.03F, 0.03F),
            glm::vec3(0.36F)};
        const double rear_m = -0.2 * object.length_m;
        const BodySize size{{object.length_m, object.width_m, object.height_m},
                            rear_m,
                            paints[drawn.of(paints.size())],
                            true,
                            static_cast<std::uint32_t>(drawn.of(6))};
        static constexpr Model (*bodies[])(const BodySize&) = {car_body, van_body, truck_body, bus_body};
        const Pose pose{to_parent(foot, {-(rear_m + 0.5 * object.length_m), 0.0, 0.0}), foot.axes};
        add_body(bodies[static_cast<std::size_t>(look) - static_cast<std::size_t>(DressedKind::car)](size), pose, name);
    }

    /// One every 30 to 70 m on each sidewalk, walking one way or the other, an arm's length from its outer edge.
    void add_people(const Road& road) {
        if (road.junction != "-1")
            return;
        for (const bool left : {true, false}) {
            Dice drawn(settings_.seed, fmt::format("people, road {} {}", road.id, left ? "left" : "right"));
            for (double s = drawn.between(10.0, 40.0); s < road.length_m - 5.0; s += drawn.between(30.0, 70.0)) {
                const LaneSection& section = section_at(road, s);
                const Lane& lane = left ? section.lanes.front() : section.lanes.back();
                const bool back = drawn.share() < 0.5, dark = drawn.share() < 0.7;
                const auto draw = static_cast<std::uint32_t>(drawn.of(6));
                const double height = drawn.between(1.58, 1.88), tone = dark ? drawn.between(0.03, 0.08) : drawn.between(0.25, 0.5);
                if (lane.type != "sidewalk" && lane.type != "walking")
                    continue;
                const LaneEdges edges = lane_edges(road, section, lane.id, s);
                if (std::abs(edges.outer_t_m - edges.inner_t_m) < 1.2)
                    continue;
                RoadObject place;
                place.s_m = s;
                place.t_m = edges.outer_t_m + (left ? -0.55 : 0.55);
                place.z_offset_m = edge_height_m(road, s, left);
                place.heading_rad = back ? pi : 0.0;
                const BodySize size{{0.5, 0.55, height}, -0.25, glm::vec3(static_cast<float>(tone)), true, draw};
                const Pose pose = standing(network_, road, place);
                if (route_.nearest_m(pose.position_m) > far_from_route_m || !is_clear(road, pose.position_m, lane.id))
                    continue;
                add_body(pedestrian_body(size), pose, fmt::format("pedestrian, road {} s {:.0f}", road.id, s));
            }
        }
    }

    /// On the ground beside a road, so far out from its edge.
    Pose beside(const Road& road, double s_m, bool left, double out_m) const {
        const Pose edge = surface_pose(network_, road, s_m, outer_edge_m(road, s_m, left));
        const double yaw = std::atan2(edge.forward().y, edge.forward().x), side = left ? 1.0 : -1.0;
        return {edge.position_m + glm::dvec3(-std::sin(yaw) * side * out_m, std::cos(yaw) * side * out_m, -ground_drop_m(out_m)),
                axes_from_angles(yaw, 0.0, 0.0)};
    }

    /// Whether nothing else is there: another road, or an object within so many metres.
    bool is_free(const Road& road, const glm::dvec3& place_m, double room_m) const {
        const std::optional<RoadPlace> on = finder_.find(glm::dvec2(place_m));
        return on && on->lane == 0 && &network_.roads[on->road] == &road && objects_.none_within(place_m, room_m);
    }

    /// Whether this lane of this road is there (0: beside all), and no object within 0.45 m of its footprint.
    bool is_clear(const Road& road, const glm::dvec3& place_m, int lane) const {
        const std::optional<RoadPlace> on = finder_.find(glm::dvec2(place_m));
        return on && on->lane == lane && &network_.roads[on->road] == &road && footprints_.none_within(place_m, 0.45);
    }

    /// Grass up to the height of the road's edge, and farther out bushes and a field's fence; nothing of it beside sidewalks.
    void add_verge(const Road& road, bool left) {
        Dice drawn(settings_.seed, fmt::format("verge, road {} {}", road.id, left ? "left" : "right"));
        const double fence_m = drawn.share() < 0.5 ? drawn.between(6.5, 9.0) : 0.0;
        for (double from = 0.0; from < road.length_m; from += stretch_m) {
            TriangleSoup grass;
            const double to = std::min(from + stretch_m, road.length_m);
            const LaneSection& section = section_at(road, 0.5 * (from + to));
            const std::string& edge = (left ? section.lanes.front() : section.lanes.back()).type;
            Dice here = drawn.fork();
            if (edge == "sidewalk" || edge == "walking" || road.junction != "-1" ||
                route_.nearest_m(beside(road, 0.5 * (from + to), left, 0.0).position_m) > far_from_route_m)
                continue;
            for (double s = from; s < to; s += here.between(0.3, 1.2)) {
                const double out = here.between(2.6, 6.0);
                const Pose pose = beside(road, s, left, out);
                if (is_free(road, pose.position_m, 0.3))
                    append_placed(grass, dressed_tuft(std::min(0.35, ground_drop_m(out) - 0.03), here.fork()).low, pose);
            }
            add_mesh(grass, {}, fmt::format("grass, road {} s {:.0f}-{:.0f}", road.id, from, to), true, false);
            for (double s = from + here.between(0.0, 14.0); s < to; s += here.between(6.0, 24.0)) {
                const double radius = here.between(0.6, 1.5);
                const Pose pose = beside(road, s, left, here.between(9.5, 15.0));
                if (is_free(road, pose.position_m, radius))
                    add(dressed_bush(radius * here.between(1.0, 1.6), radius, here.fork()), pose,
                        fmt::format("bush, road {} s {:.0f} {}", road.id, s, left ? "left" : "right"));
            }
            TriangleSoup fence;
            bool open = fence_m > 0.0; // nothing stands in its way
            for (double s = from + 1.5; open && s + 1.5 <= to; s += 3.0) {
                const Pose a = beside(road, s - 1.5, left, fence_m), b = beside(road, s + 1.5, left, fence_m);
                const glm::dvec3 way = b.position_m - a.position_m, middle = 0.5 * (a.position_m + b.position_m);
                open = is_free(road, middle, 1.6);
                append_placed(fence, dressed_field_fence(glm::length(way)).low,
                              {middle, axes_from_angles(std::atan2(way.y, way.x), std::atan2(way.z, std::hypot(way.x, way.y)), 0.0)});
            }
            if (!open)
                continue;
            lay_pictures(fence);
            add_mesh(fence, {}, fmt::format("field fence, road {} s {:.0f}-{:.0f} {}", road.id, from, to, left ? "left" : "right"), true);
        }
    }

    Scene& scene_;
    const RoadNetwork& network_;
    DressingSettings settings_;
    Nearness route_;
    RoadFinder finder_;
    Occupied objects_, footprints_; ///< roughly, with what sways about them; in pieces of a metre
    std::uint32_t first_;
};

} // namespace

bool is_dressed(const RoadObject& object) { return dressed_kind(object).has_value(); }

void add_dressing(Scene& scene, const RoadNetwork& network, const Route& route, const DressingSettings& settings) {
    Dresser dresser(scene, network, route, settings);
    for (const Road& road : network.roads)
        dresser.dress(road);
    unify_texture_sizes(scene);
}

} // namespace fernlicht
