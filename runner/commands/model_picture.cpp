#include "runner/commands/model_picture.h"

#include "scenarios/lamps/lamp_model.h"
#include "scenarios/models/model_textures.h"
#include "scenarios/models/placed_model.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double lamps_x_m = 3.6, lamps_z_m = 0.65, lamps_y_m = 0.6;
const glm::dvec3 eye_m{1.3, 0.35, 1.2};

/// The model's box, turned: from its least to its greatest corner.
std::pair<glm::dvec3, glm::dvec3> turned_box(const Model& model, const ModelRequest& request) {
    const glm::dmat3 axes = axes_from_angles(radians(request.yaw_deg), 0.0, 0.0);
    glm::dvec3 low(1e30), high(-1e30);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner((i & 1) ? model.high_m.x : model.low_m.x, (i & 2) ? model.high_m.y : model.low_m.y,
                                (i & 4) ? model.high_m.z : model.low_m.z);
        const glm::dvec3 p = axes * (request.scale * corner);
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {low, high};
}

Pose pose_of(const Model& model, const ModelRequest& request) {
    const auto [low, high] = turned_box(model, request);
    return {{lamps_x_m + request.distance_m - low.x, -0.5 * (low.y + high.y), -low.z},
            axes_from_angles(radians(request.yaw_deg), 0.0, 0.0)};
}

/// Squares of 4 m, so that per-vertex techniques have something to work with.
void add_road(Scene& scene, double length_m) {
    Mesh road;
    road.name = "road";
    scene.materials.push_back({.name = "asphalt", .kind = SurfaceKind::road, .albedo = glm::vec3(0.07F)});
    const int along = static_cast<int>(std::ceil(length_m / 4.0)), across = 16;
    for (int i = 0; i <= along; ++i)
        for (int k = 0; k <= across; ++k)
            road.vertices.push_back({{4.0F * static_cast<float>(i), 4.0F * static_cast<float>(k - across / 2), 0.0F}, {0.0F, 0.0F, 1.0F}});
    const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * (across + 1) + k); };
    for (int i = 0; i < along; ++i)
        for (int k = 0; k < across; ++k)
            for (const std::uint32_t index : {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1)})
                road.indices.push_back(index);
    road.batches.push_back({static_cast<std::uint32_t>(scene.materials.size() - 1), 0, static_cast<std::uint32_t>(road.indices.size())});
    scene.meshes.push_back(std::move(road));
}

} // namespace

Scene model_scene(const Model& model, const ModelRequest& request) {
    Scene scene;
    const auto [low, high] = turned_box(model, request);
    add_road(scene, std::min(400.0, lamps_x_m + request.distance_m + high.x - low.x + 40.0));
    add_model(scene, model, pose_of(model, request), request.scale, SurfaceKind::vehicle);
    unify_texture_sizes(scene);
    return scene;
}

Moment lit_moment(const ModelRequest& request) {
    const auto& models = lamp_models();
    const auto known = std::ranges::find(models, request.lamp, &LampModel::name);
    if (known == models.end())
        throw InputError({{}, 0, 0, "--lamp"}, "found '" + printable(request.lamp) + "'",
                         "halogen-low, halogen-high, xenon-low or xenon-high");
    const auto file = std::make_shared<const LampFile>(lamp_of_model(*known));
    const LampColour colour = colour_of_temperature(request.lamp.starts_with("xenon") ? 4300.0 : 3200.0);
    Moment moment;
    for (const double y : {lamps_y_m, -lamps_y_m}) {
        MountedLamp lamp;
        lamp.name = y > 0.0 ? "left" : "right";
        lamp.position_m = {lamps_x_m, y, lamps_z_m};
        lamp.file = file;
        LitLamp lit;
        lit.name = lamp.name;
        lit.file = file;
        lit.pose = lamp.pose();
        lit.intensity_factor = lamp.intensity_factor();
        lit.colour = colour;
        moment.lamps.push_back(std::move(lit));
    }
    return moment;
}

View towards(const Model& model, const ModelRequest& request) {
    const auto [low, high] = turned_box(model, request);
    const glm::dvec3 size = high - low;
    const double distance_m = lamps_x_m + request.distance_m - eye_m.x;
    View view;
    view.name = "model";
    view.position_m = eye_m;
    view.width_px = request.width_px;
    view.height_px = request.height_px;
    view.yaw_rad = std::atan2(-eye_m.y, distance_m);
    view.pitch_rad = std::atan2(0.45 * size.z - eye_m.z, distance_m);
    const double aspect = static_cast<double>(request.width_px) / request.height_px;
    const double half_m = std::max(0.75 * size.z, 0.7 * size.y / aspect);
    view.vertical_fov_rad = std::clamp(2.0 * std::atan(half_m / distance_m), radians(1.0), radians(100.0));
    return view;
}

} // namespace fernlicht
