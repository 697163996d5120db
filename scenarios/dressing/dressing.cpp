#include "scenarios/dressing/dressing.h"

#include "scenarios/dressing/dresser.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace fernlicht {
namespace {

/// Of the ground above its foot.
double sunk_m(const RoadObject& house) { return std::clamp(-house.z_offset_m, 0.0, 1.5); }

double given_or(double value, double otherwise) { return value > 0.0 ? value : otherwise; }

} // namespace

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

Dresser::Dresser(Scene& scene, const RoadNetwork& network, const Route& route, const DressingSettings& settings)
    : scene_(scene), network_(network), settings_(settings), route_(route), finder_(network), road_meshes_(scene.meshes.size()),
      first_(add_dressing_materials(scene, settings.textures, settings.seed)) {
    for (const Road& road : network.roads)
        for (const RoadObject& object : road.objects)
            if (object.height_m > 0.3)
                occupy(road, object);
}

void Dresser::dress(const Road& road) {
    std::map<long, TriangleSoup> barriers; ///< in the world, by stretch
    for (const RoadObject& object : road.objects)
        if (const std::optional<DressedKind> look = dressed_kind(object))
            add(road, object, *look, barriers);
    for (auto& [stretch, soup] : barriers)
        add_mesh(soup, {}, fmt::format("crash barrier, road {} s {}-{}", road.id, stretch * stretch_m, (stretch + 1) * stretch_m), false,
                 false);
    for (const RoadSignal& signal : road.signals)
        add_sign(road, signal);
    add_people(road);
    add_bollards(road);
    for (const bool left : {true, false})
        add_verge(road, left);
    add_patches(road);
}

void Dresser::occupy(const Road& road, const RoadObject& object) {
    const double length = std::max(object.length_m, 2.0 * object.radius_m), width = std::max(object.width_m, 2.0 * object.radius_m);
    const Pose foot = standing(network_, road, object);
    if (const double room = std::max(object.radius_m, 0.5 * std::hypot(object.length_m, object.width_m)); room <= Occupied::widest_m)
        objects_.add(foot.position_m, room);
    else
        objects_.add_pieces(foot, length, width, Occupied::widest_m);
    if (dressed_kind(object) == DressedKind::tree)
        footprints_.add(foot.position_m, 0.4); // its trunk: there is room under the crown
    else
        footprints_.add_pieces(foot, length, width, 1.0);
}

Dice Dresser::dice(const Road& road, const RoadObject& object) const {
    return {settings_.seed, fmt::format("{} {} {:.3f} {:.3f}", road.id, object.id, object.s_m, object.t_m)};
}

void Dresser::add(const Road& road, const RoadObject& object, DressedKind look, std::map<long, TriangleSoup>& barriers) {
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
        return add(dressed_bush(height, given_or(object.radius_m, given_or(0.5 * across, 0.5 * height)), dice(road, object)), foot, name);
    }
    case DressedKind::barrier:
        return append_placed(barriers[static_cast<long>(std::floor(object.s_m / stretch_m))],
                             dressed_guard_rail(object.length_m, object.width_m, object.height_m, object.t_m < 0.0).low, foot);
    default:
        return add_vehicle(road, object, look, foot, name);
    }
}

Detail Dresser::detail(const Pose& foot, double error_m) const {
    return route_.nearest_m(foot.position_m) > error_m / settings_.pixel_rad ? Detail::far : Detail::near;
}

void Dresser::add_mesh(const TriangleSoup& soup, const Pose& pose, const std::string& name, bool whole, bool closed, bool casts) {
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
    mesh.closed = closed;
    scene_.meshes.push_back(std::move(mesh));
}

void Dresser::add(DressedObject object, const Pose& pose, const std::string& name) {
    for (TriangleSoup* soup : {&object.low, &object.high}) {
        if (!object.has_places)
            lay_pictures(*soup);
        add_mesh(*soup, pose, name, true, object.closed);
    }
}

void Dresser::add_house(const Road& road, const RoadObject& object, const Pose& foot, const std::string& name) {
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

void Dresser::add_body(const Model& model, const Pose& pose, const std::string& name) {
    const std::size_t before = scene_.meshes.size();
    add_model(scene_, model, pose, 1.0, SurfaceKind::vehicle);
    for (std::size_t i = before; i < scene_.meshes.size(); ++i) {
        scene_.meshes[i].name = name;
        scene_.meshes[i].whole = scene_.meshes[i].closed = true;
    }
}

void Dresser::add_vehicle(const Road& road, const RoadObject& object, DressedKind look, const Pose& foot, const std::string& name) {
    // Ten cars as they are registered in Germany (KBA, stock by colour: grey 3, black 2 to 3, white 2, blue 1, red 1), dealt like cards.
    static constexpr std::array<glm::vec3, 10> paints{
        glm::vec3(0.17F), {0.30F, 0.03F, 0.03F},  glm::vec3(0.04F),      {0.05F, 0.10F, 0.25F}, glm::vec3(0.60F),
        glm::vec3(0.36F), {0.03F, 0.04F, 0.035F}, {0.06F, 0.16F, 0.12F}, {0.24F, 0.20F, 0.15F}, {0.02F, 0.035F, 0.09F}};
    Dice drawn = dice(road, object);
    const std::size_t start = Dice(settings_.seed, "paints").of(paints.size()), paint = (start + 3 * cars_) % paints.size();
    const double rear_m = -0.2 * object.length_m;
    // A box that hangs up to 0.3 m above the road is a body without its wheels.
    const double lifted = object.z_offset_m > 0.0 && object.z_offset_m <= 0.3 ? object.z_offset_m : 0.0;
    const BodySize size{{object.length_m, object.width_m, object.height_m + lifted},
                        rear_m,
                        paints[paint],
                        true,
                        static_cast<std::uint32_t>(drawn.of(2) * 3 + cars_ % 3)};
    ++cars_;
    static constexpr Model (*bodies[])(const BodySize&) = {car_body, van_body, truck_body, bus_body};
    const Pose pose{to_parent(foot, {-(rear_m + 0.5 * object.length_m), 0.0, -lifted}), foot.axes};
    add_body(bodies[static_cast<std::size_t>(look) - static_cast<std::size_t>(DressedKind::car)](size), pose, name);
}

/// The plate on its post, in the place of the plain board.
void Dresser::add_sign(const Road& road, const RoadSignal& signal) {
    RoadObject place;
    place.s_m = signal.s_m, place.t_m = signal.t_m;
    place.heading_rad = (signal.facing_forward ? pi : 0.0) + signal.heading_offset_rad;
    const Pose ground = standing(network_, road, place);
    const double width = given_or(signal.width_m, signal.dynamic ? 0.3 : 0.6),
                 height = given_or(signal.height_m, signal.dynamic ? 0.9 : 0.6);
    const double bottom = given_or(signal.z_offset_m, 2.0), depth = signal.dynamic ? 0.2 : 0.03;
    constexpr double post_m = 0.038, below_m = 0.7; // the post's radius, and how far it reaches into the ground beside the road
    const auto face = settings_.faces.find({road.id, signal.id});
    TriangleSoup soup;
    append_placed(soup,
                  signal.dynamic ? dressed_traffic_light(width, height)
                                 : dressed_sign(width, height, face == settings_.faces.end() ? SignalFace{} : face->second,
                                                {settings_.seed, road.id + " " + signal.id}),
                  {{post_m + depth, 0.0, bottom + 0.5 * height}, glm::dmat3(1.0)});
    const int lane = lane_at(road, signal.s_m, signal.t_m);
    const Lane* under = lane == 0 ? nullptr : lane_of(section_at(road, signal.s_m), lane);
    const bool over_road = under != nullptr && lane_material(under->type) == RoadMaterial::asphalt;
    const std::vector<double> posts = over_road     ? std::vector<double>{}
                                      : width > 1.5 ? std::vector<double>{-0.35 * width, 0.35 * width}
                                                    : std::vector<double>{0.0};
    for (const double y : posts)
        append_box(soup, {-post_m, y - post_m, -below_m}, {post_m, y + post_m, bottom + 0.9 * height}, index_of(Stuff::zinc));
    add_mesh(soup, ground, fmt::format("signal {}", signal.id), true, !signal.dynamic);
}

bool is_dressed(const RoadObject& object) { return dressed_kind(object).has_value(); }

void dress_ground(RoadMeshOptions& options, bool mirrored) {
    const auto stuff = [](Stuff which) { return index_of(RoadMaterial::count) + index_of(which); };
    options.signals = false;
    options.leave_out = is_dressed;
    options.ground = [stuff, mirrored, seed = options.seed](const Road& road, bool left, double s_m, double out_m) {
        if (is_walked(outer_lane(road, s_m, left)) || (out_m > 0.0 && out_m < 12.0))
            return stuff(Stuff::meadow);
        if (out_m == 0.0)
            return stuff(Stuff::gravel);
        static constexpr std::array fields{Stuff::meadow, Stuff::stubble, Stuff::soil};
        return stuff(
            fields[Dice(seed, fmt::format("field, road {} {} {}", road.id, left != mirrored ? "left" : "right", std::floor(s_m / field_m)))
                       .of(3)]);
    };
    options.ditch = [material = stuff(Stuff::ditch), mirrored, seed = options.seed](const Road& road, bool left, double from_s_m,
                                                                                    double to_s_m) {
        return has_ditch(road, left, {from_s_m, to_s_m}, seed, mirrored) ? std::optional(material) : std::nullopt;
    };
}

void add_dressing(Scene& scene, const RoadNetwork& network, const Route& route, const DressingSettings& settings) {
    Dresser dresser(scene, network, route, settings);
    for (const Road& road : network.roads)
        dresser.dress(road);
    unify_texture_sizes(scene);
}

} // namespace fernlicht
