#include "scenarios/sky/place_street_lamps.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double pole_half_m = 0.07, head_m = 0.5, head_width_m = 0.25, head_height_m = 0.1;

/// On the pole's side of the lane, with x along the route and y to its left; z stands up in the world, as poles do.
Pose foot_of(const StreetLampRow& row, const Route& route, double at_m) {
    const Pose lane = route.pose(at_m, row.beside_m);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(lane.forward().x, lane.forward().y, 0.0));
    const glm::dvec3 up(0.0, 0.0, 1.0);
    return {lane.position_m, {forward, glm::cross(up, forward), up}};
}

/// From the pole towards the lane, in the foot's frame.
double inwards(const StreetLampRow& row) { return row.beside_m <= 0.0 ? 1.0 : -1.0; }

/// The lamp hangs with its axis down: forward down, up towards the lane, right along the route (for a pole on the right).
Pose lamp_pose(const StreetLampRow& row, const Pose& foot) {
    const double side = inwards(row), c = std::cos(row.tilt_rad), s = std::sin(row.tilt_rad);
    const glm::dvec3 across = side * foot.left();
    const glm::dvec3 forward = s * across - c * foot.up(), up = c * across + s * foot.up();
    return {foot.position_m + row.height_m * foot.up() + row.arm_m * across, {forward, glm::cross(up, forward), up}};
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
        for (const double at : places(row, route, moment.distance_m - within_m, moment.distance_m + within_m)) {
            LitLamp lamp{fmt::format("{} at {:.1f} m", row.name, at), row.file, lamp_pose(row, foot_of(row, route, at)), row.level,
                         row.colour};
            lamp.body = -2;
            lamp.face_m = {head_m, head_width_m};
            moment.other_lamps.push_back(std::move(lamp));
        }
    }
}

void add_street_lamp_poles(const Drive& drive, const Route& route, Scene& scene) {
    if (drive.street_lamps.empty())
        return;
    const auto metal = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({.name = "street-lamp", .kind = SurfaceKind::object, .albedo = glm::vec3(0.3F)});
    for (const StreetLampRow& row : drive.street_lamps)
        for (const double at : places(row, route, row.first_m, row.last_m)) {
            const Pose foot = foot_of(row, route, at);
            Mesh mesh{fmt::format("street lamp {} at {:.1f} m", row.name, at), foot.position_m, {}, {}, {}};
            const double side = inwards(row), reach = side * row.arm_m, top = row.height_m + head_height_m;
            add_box(mesh, foot, {-pole_half_m, -pole_half_m, 0.0}, {pole_half_m, pole_half_m, top});
            if (row.arm_m > 2.0 * pole_half_m)
                add_box(mesh, foot, {-0.03, std::min(side * pole_half_m, reach), top - 0.06},
                        {0.03, std::max(side * pole_half_m, reach), top});
            add_box(mesh, foot, {-0.5 * head_m, reach - 0.5 * head_width_m, row.height_m + 0.02},
                    {0.5 * head_m, reach + 0.5 * head_width_m, top + 0.02});
            mesh.batches = {{metal, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
            scene.meshes.push_back(std::move(mesh));
        }
}

} // namespace fernlicht
