#include "runner/experiments/shadows/stress_scenes.h"

#include "runner/play/small_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fernlicht {
namespace {

constexpr glm::dvec3 left_lamp_m{3.4, 0.6, 0.65}, right_lamp_m{3.4, -0.6, 0.65};
constexpr std::uint32_t road_material = 0, thing_material = 2;

/// Closed, one mesh.
void add_box(Scene& scene, const std::string& name, const glm::dvec3& low, const glm::dvec3& high) {
    Mesh mesh{name, 0.5 * (low + high), {}, {}, {}};
    const glm::dvec3 half = 0.5 * (high - low);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 normal(0.0), across(0.0), up(0.0);
            normal[axis] = side;
            across[(axis + 1) % 3] = half[(axis + 1) % 3];
            up[(axis + 2) % 3] = side * half[(axis + 2) % 3]; // counter-clockwise seen from outside
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (const auto& [a, b] : {std::pair(-1.0, -1.0), std::pair(1.0, -1.0), std::pair(1.0, 1.0), std::pair(-1.0, 1.0)})
                mesh.vertices.push_back({glm::vec3(normal * half + a * across + b * up), glm::vec3(normal)});
            mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
        }
    mesh.batches = {{thing_material, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
    scene.meshes.push_back(std::move(mesh));
}

/// Several boxes as one mesh: what stands together.
void join(Scene& scene, std::size_t first, const std::string& name) {
    Mesh all{name, scene.meshes[first].origin_m, {}, {}, {}};
    for (std::size_t i = first; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const auto base = static_cast<std::uint32_t>(all.vertices.size());
        const glm::vec3 offset(mesh.origin_m - all.origin_m);
        for (const Vertex& vertex : mesh.vertices)
            all.vertices.push_back({vertex.position_m + offset, vertex.normal});
        for (const std::uint32_t index : mesh.indices)
            all.indices.push_back(base + index);
    }
    all.batches = {{thing_material, 0, static_cast<std::uint32_t>(all.indices.size())}};
    scene.meshes.resize(first);
    scene.meshes.push_back(std::move(all));
}

Scene scene_without_road() {
    Scene scene = small_scenes::empty_scene();
    scene.materials.push_back({"thing", SurfaceKind::object, glm::vec3(0.3F)});
    return scene;
}

Scene plane_road() {
    Scene scene = scene_without_road();
    small_scenes::add_sheet(scene, "road", road_material, {-10.0, -30.0, 0.0}, {140.0, 0.0, 0.0}, {0.0, 60.0, 0.0});
    return scene;
}

/// Up by 3 % from 10 m before the lamps, over a crest of 500 m radius, down by 3 %.
Scene crest_road() {
    Scene scene = scene_without_road();
    const double foot_m = left_lamp_m.x + 10.0, slope = 0.03, radius_m = 500.0, up_m = 15.0, over_m = 2.0 * slope * radius_m, step_m = 0.5;
    const auto slope_at = [&](double x) { return x < foot_m ? 0.0 : std::clamp(slope - (x - foot_m - up_m) / radius_m, -slope, slope); };
    Mesh mesh{"road", {foot_m + up_m + 0.5 * over_m, 0.0, 0.0}, {}, {}, {}};
    double x = -10.0, z = 0.0;
    for (std::uint32_t i = 0; x < 130.0; ++i, x += step_m) {
        const glm::vec3 normal(glm::normalize(glm::dvec3(-slope_at(x), 0.0, 1.0)));
        for (const double y : {-30.0, 30.0})
            mesh.vertices.push_back({glm::vec3(glm::dvec3(x, y, z) - mesh.origin_m), normal});
        if (i > 0)
            mesh.indices.insert(mesh.indices.end(), {2 * i - 2, 2 * i, 2 * i + 1, 2 * i - 2, 2 * i + 1, 2 * i - 1});
        z += step_m * slope_at(x + 0.5 * step_m);
    }
    mesh.batches = {{road_material, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
    scene.meshes.push_back(std::move(mesh));
    add_box(scene, "post", {foot_m + 8.0, -1.35, 0.0}, {foot_m + 8.1, -1.25, 1.2});
    return scene;
}

void add_post(Scene& scene, double ahead_m, double y_m) {
    const double x = left_lamp_m.x + ahead_m;
    add_box(scene, "post", {x, y_m - 0.05, 0.0}, {x + 0.1, y_m + 0.05, 1.0});
}

Scene with_post(double ahead_m, double y_m) {
    Scene scene = plane_road();
    add_post(scene, ahead_m, y_m);
    return scene;
}

Scene with_kerb() {
    Scene scene = plane_road();
    add_box(scene, "kerb", {left_lamp_m.x + 6.0, -2.6, 0.0}, {left_lamp_m.x + 90.0, -2.4, 0.12});
    return scene;
}

Scene with_fence() {
    Scene scene = plane_road();
    const std::size_t first = scene.meshes.size();
    for (int i = 0; i < 120; ++i) {
        const double x = left_lamp_m.x + 6.0 + 0.15 * i;
        add_box(scene, "pale", {x, -3.02, 0.0}, {x + 0.04, -3.0, 1.0});
    }
    join(scene, first, "fence");
    return scene;
}

/// A body on four legs, light passes below. Its origin lies under the middle of its rear: it is one that can move.
Scene with_car() {
    Scene scene = plane_road();
    const std::size_t first = scene.meshes.size();
    add_box(scene, "body", {0.0, -0.9, 0.2}, {4.2, 0.9, 1.4});
    for (const double wheel : {0.6, 3.0})
        for (const double y : {-0.9, 0.7})
            add_box(scene, "wheel", {wheel, y, 0.0}, {wheel + 0.6, y + 0.2, 0.2});
    join(scene, first, "car");
    scene.meshes.back().body = 0;
    return scene;
}

/// Each lamp in a housing of 2 mm sheet, 0.3 m wide and high, open in front 0.25 m before it and closed 0.1 m behind.
Scene with_housings() {
    Scene scene = plane_road();
    for (const glm::dvec3& lamp : {left_lamp_m, right_lamp_m}) {
        const std::size_t first = scene.meshes.size();
        const double half = 0.15, thick = 0.002, back = lamp.x - 0.1, front = lamp.x + 0.25;
        add_box(scene, "top", {back, lamp.y - half, lamp.z + half}, {front, lamp.y + half, lamp.z + half + thick});
        add_box(scene, "bottom", {back, lamp.y - half, lamp.z - half - thick}, {front, lamp.y + half, lamp.z - half});
        add_box(scene, "left", {back, lamp.y + half, lamp.z - half}, {front, lamp.y + half + thick, lamp.z + half});
        add_box(scene, "right", {back, lamp.y - half - thick, lamp.z - half}, {front, lamp.y - half, lamp.z + half});
        add_box(scene, "back", {back - thick, lamp.y - half, lamp.z - half}, {back, lamp.y + half, lamp.z + half});
        join(scene, first, "housing");
    }
    add_post(scene, 12.0, -0.8);
    return scene;
}

Scene with_wall() {
    Scene scene = plane_road();
    add_box(scene, "wall", {left_lamp_m.x + 4.0, -2.0, 0.0}, {left_lamp_m.x + 4.2, 1.0, 1.6});
    add_post(scene, 16.0, 1.4);
    return scene;
}

View drivers_view(double vertical_fov_rad) {
    View view = small_scenes::camera({1.3, 0.35, 1.2}, 0.0, radians(-1.0), 0.0, 1024, 768);
    view.name = "driver";
    view.vertical_fov_rad = vertical_fov_rad;
    return view;
}

} // namespace

std::vector<ShadowScene> stress_scenes(const std::shared_ptr<const LampFile>& beam, double vertical_fov_rad) {
    Moment moment;
    for (const auto& [name, place] : {std::pair("left", left_lamp_m), std::pair("right", right_lamp_m)})
        moment.lamps.push_back({name, beam, Pose{place, glm::dmat3(1.0)}, 1.0, LampColour{}, 0.0});
    std::vector<ShadowScene> all;
    const auto add = [&](const char* name, const char* title, Scene scene, const View& view) {
        all.push_back({name, title, false, std::make_shared<const Scene>(std::move(scene)), {moment}, view, {}});
    };
    const View driver = drivers_view(vertical_fov_rad);
    add("post-5", "A post 5 m away", with_post(5.0, -0.3), driver);
    add("post-20", "A post 20 m away", with_post(20.0, -0.9), driver);
    add("post-79", "A post 79 m away: light falls in at half a degree", with_post(79.0, -1.5), driver);
    add("kerb", "A kerb, 0.12 m high, along the road", with_kerb(), driver);
    add("fence", "A fence of pales 4 cm wide", with_fence(), driver);
    add("car-close", "A car 3 m before the lamps; light passes below it", with_car(), driver);
    all.back().moments[0].bodies = {{"car", Pose{{left_lamp_m.x + 3.0, 0.0, 0.0}, glm::dmat3(1.0)}, true, 0.0, false}};
    add("crest", "A crest, grazed by the light, and a post before it", crest_road(), driver);
    add("lamp-in-body", "Lamps inside housings that are open in front", with_housings(), driver);
    View behind_wall = driver;
    behind_wall.position_m = {left_lamp_m.x + 7.0, -0.6, 0.9};
    behind_wall.yaw_rad = radians(10.0);
    add("camera-in-shadow", "A wall before the lamps, seen from within its shadow", with_wall(), behind_wall);
    return all;
}

Moment moved_ahead(Moment moment, double ahead_m) {
    const glm::dvec3 step = ahead_m * moment.ego.forward();
    moment.ego.position_m += step;
    for (LitLamp& lamp : moment.lamps)
        lamp.pose.position_m += step;
    for (Body& body : moment.bodies)
        if (body.own)
            body.pose.position_m += step;
    return moment;
}

Moment first_lamp_alone(Moment moment) {
    constexpr double next_to_nothing = 1e-6;
    bool first = true;
    for (LitLamp& lamp : moment.lamps)
        if (lamp.intensity_factor > 0.0) {
            lamp.intensity_factor *= first ? 1.0 : next_to_nothing;
            first = false;
        }
    moment.other_lamps.clear();
    moment.daylight = {};
    return moment;
}

} // namespace fernlicht
