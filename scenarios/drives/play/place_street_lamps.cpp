#include "scenarios/drives/play/place_street_lamps.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <set>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double pole_half_m = 0.07, head_m = 0.5, head_width_m = 0.25, head_height_m = 0.1;
constexpr double below_lamp_m = 0.05; ///< where a pole without arm ends, so that the lamp is not in it

/// There, with x along the road and y to its left; z stands up in the world, as poles do.
Pose upright(const Pose& ground) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(ground.forward().x, ground.forward().y, 0.0)), up(0.0, 0.0, 1.0);
    return {ground.position_m, {forward, glm::cross(up, forward), up}};
}

/// On the pole's side of the lane.
Pose foot_of(const StreetLampRow& row, const Route& route, double at_m) { return upright(route.pose(at_m, row.beside_m)); }

/// Whether the lamp hangs beside its pole rather than on it.
bool has_arm(const StreetLampRow& row) { return row.arm_m > street_lamp_min_arm_m; }

/// From the pole towards the lane, in the foot's frame.
double inwards(double beside_m) { return beside_m <= 0.0 ? 1.0 : -1.0; }

/// The lamp hangs with its axis down: forward down, up towards the lane, right along the route (for a pole on the right).
Pose lamp_pose(const StreetLampRow& row, const Pose& foot, double beside_m, double height_m) {
    const double side = inwards(beside_m), c = std::cos(row.tilt_rad), s = std::sin(row.tilt_rad);
    const glm::dvec3 across = side * foot.left();
    const glm::dvec3 forward = s * across - c * foot.up(), up = c * across + s * foot.up();
    return {foot.position_m + height_m * foot.up() + row.arm_m * across, {forward, glm::cross(up, forward), up}};
}

void add_lamp(const StreetLampRow& row, std::string name, const Pose& pose, Moment& moment) {
    LitLamp lamp{std::move(name), row.file, pose, row.level, row.colour};
    lamp.body = fixed_in_world;
    lamp.face_m = {head_m, head_width_m};
    moment.other_lamps.push_back(std::move(lamp));
}

/// Places along the route of the row's poles between two distances.
std::vector<double> places(const StreetLampRow& row, const Route& route, double from_m, double to_m) {
    const double last = std::min({row.last_m, route.length_m(), to_m}), first = std::max(row.first_m, 0.0);
    std::vector<double> all;
    for (double k = std::max(std::ceil((from_m - first) / row.every_m), 0.0); first + k * row.every_m <= last; k += 1.0)
        all.push_back(first + k * row.every_m);
    return all;
}

void add_box(Mesh& mesh, const Pose& frame, const glm::dvec3& low, const glm::dvec3& high) {
    const int faces[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}; // axis, then two that turn about it
    for (int f = 0; f < 6; ++f) {
        const int axis = faces[f][0], a = faces[f][1], b = faces[f][2];
        const bool upper = f % 2 == 0;
        glm::dvec3 normal(0.0);
        normal[axis] = upper ? 1.0 : -1.0;
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const auto& [at_a, at_b] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
            glm::dvec3 p;
            p[axis] = upper ? high[axis] : low[axis];
            p[a] = at_a ? high[a] : low[a];
            p[b] = at_b ? high[b] : low[b];
            mesh.vertices.push_back({glm::vec3(frame.axes * p), glm::vec3(frame.axes * normal), {}});
        }
        mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
}

} // namespace

void add_street_lamps(const Drive& drive, const Route& route, double within_m, Moment& moment) {
    for (const StreetLampRow& row : drive.street_lamps) {
        if (row.level <= 0.0)
            continue;
        if (!row.on_objects.empty()) {
            if (!row.found)
                throw std::logic_error("add_street_lamps: lamps on objects of the road that were not looked for");
            for (const StreetLampPlace& place : *row.found)
                if (glm::distance(place.foot.position_m, moment.ego.position_m) <= within_m)
                    add_lamp(row, fmt::format("{} on {}", row.name, place.object),
                             lamp_pose(row, place.foot, place.beside_m, place.height_m), moment);
            continue;
        }
        for (const double at : places(row, route, moment.distance_m - within_m, moment.distance_m + within_m))
            add_lamp(row, fmt::format("{} at {:.1f} m", row.name, at), lamp_pose(row, foot_of(row, route, at), row.beside_m, row.height_m),
                     moment);
    }
}

void add_street_lamp_poles(const Drive& drive, const Route& route, Scene& scene) {
    if (drive.street_lamps.empty())
        return;
    const auto metal = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({.name = "street-lamp", .kind = SurfaceKind::object, .albedo = glm::vec3(0.3F)});
    const auto add = [&](const StreetLampRow& row, std::string name, const Pose& foot, double beside_m, double height_m, double stands_m) {
        Mesh mesh{std::move(name), foot.position_m, {}, {}, {}};
        const double side = inwards(beside_m), reach = side * row.arm_m, top = height_m + head_height_m,
                     pole_top = has_arm(row) ? top : height_m - below_lamp_m;
        if (pole_top > stands_m + 1e-6) // what stands there already is not drawn twice
            add_box(mesh, foot, {-pole_half_m, -pole_half_m, 0.0}, {pole_half_m, pole_half_m, pole_top});
        if (has_arm(row))
            add_box(mesh, foot, {-0.03, std::min(side * pole_half_m, reach), top - 0.06}, {0.03, std::max(side * pole_half_m, reach), top});
        add_box(mesh, foot, {-0.5 * head_m, reach - 0.5 * head_width_m, height_m + 0.02},
                {0.5 * head_m, reach + 0.5 * head_width_m, top + 0.02});
        mesh.batches = {{metal, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
        scene.meshes.push_back(std::move(mesh));
    };
    for (const StreetLampRow& row : drive.street_lamps) {
        if (row.found)
            for (const StreetLampPlace& place : *row.found)
                add(row, fmt::format("street lamp {} on {}", row.name, place.object), place.foot, place.beside_m, place.height_m,
                    place.own_height_m);
        if (row.on_objects.empty())
            for (const double at : places(row, route, row.first_m, row.last_m))
                add(row, fmt::format("street lamp {} at {:.1f} m", row.name, at), foot_of(row, route, at), row.beside_m, row.height_m, 0.0);
    }
}

namespace {

constexpr double pole_drawn_m = 4.0, ///< of a pole whose file says no height, as the road's mesh has it
    below_top_m = 0.1, above_top_m = 0.05;
constexpr std::size_t max_named = 8;

std::string without_case(std::string text) {
    for (char& c : text)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

bool is_asked_for(const StreetLampRow& row, const RoadObject& object) {
    const std::string type = without_case(object.type), name = without_case(object.name);
    return std::ranges::any_of(row.on_objects, [&](const std::string& given) {
        const std::string word = without_case(given);
        return type == word || name.find(word) != std::string::npos;
    });
}

StreetLampPlace place_on(const StreetLampRow& row, const RoadNetwork& network, const Road& road, const RoadObject& object) {
    Pose ground = surface_pose(network, road, object.s_m, object.t_m);
    ground.position_m += object.z_offset_m * glm::dvec3(0.0, 0.0, 1.0);
    const double own_m = object.height_m > 0.0 ? object.height_m : pole_drawn_m;
    return {fmt::format("object {} ({}) of road {}", object.id, object.name.empty() ? object.type : object.name, road.id), upright(ground),
            object.t_m,
            row.height_m > 0.0 ? row.height_m
            : has_arm(row)     ? std::max(own_m - below_top_m, 0.5)
                               : own_m + above_top_m,
            own_m};
}

/// Types and names that the road's objects have, for a sentence.
std::string what_stands_there(const RoadNetwork& network) {
    std::set<std::string> words;
    for (const Road& road : network.roads)
        for (const RoadObject& object : road.objects)
            for (const std::string& word : {object.type, object.name})
                if (!word.empty())
                    words.insert(word);
    std::string list;
    std::size_t named = 0;
    for (const std::string& word : words) {
        if (named++ == max_named)
            return list + fmt::format(" and {} more", words.size() - max_named);
        list += (list.empty() ? "'" : ", '") + word + "'";
    }
    return list.empty() ? "a road with objects: this one has none" : "one of the road's objects: " + list;
}

} // namespace

void find_street_lamps(Drive& drive, const RoadNetwork& network) {
    for (StreetLampRow& row : drive.street_lamps) {
        if (row.on_objects.empty())
            continue;
        row.found.emplace();
        for (const Road& road : network.roads)
            for (const RoadObject& object : road.objects)
                if (is_asked_for(row, object))
                    row.found->push_back(place_on(row, network, road, object));
        if (row.found->empty())
            throw InputError({drive.file, 0, 0, "street_lamps." + row.name + ".on_objects"},
                             "found no object of such a type or name in " + drive.road_file.filename().string(),
                             what_stands_there(network));
    }
}

} // namespace fernlicht
