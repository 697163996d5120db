#include "scenarios/drives/play/staged_scene.h"

#include "scenarios/dressing/dressing.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/control_play.h"
#include "scenarios/drives/play/motion.h"
#include "scenarios/drives/play/place_street_lamps.h"
#include "scenarios/drives/play/place_traffic.h"
#include "scenarios/drives/play/storyboard_timeline.h"
#include "scenarios/models/model.h"
#include "scenarios/roads/mesh/mesh_terrain.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/traffic/road_user_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace fernlicht {
namespace {

/// At the picture's middle; of maps and where there is no view a default.
double smallest_pixel_rad(const std::vector<View>& views) {
    double least = 0.7e-3;
    for (const View& view : views)
        if (view.projection == Projection::perspective)
            least = std::min(least, 2.0 * std::tan(0.5 * view.vertical_fov_rad) / view.height_px);
    return least;
}

/// What is on the other side of y = 0.
Mesh reflected(Mesh mesh) {
    mesh.origin_m.y = -mesh.origin_m.y;
    for (Vertex& v : mesh.vertices) {
        v.position_m.y = -v.position_m.y;
        v.normal.y = -v.normal.y;
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    return mesh;
}

/// With a note of what shades the own lane. In a mirror stands the image of what would stand without one.
void dress(Scene& scene, Drive& drive, const RoadNetwork& network, const Route& route, RoadMeshOptions options) {
    const std::size_t before = scene.meshes.size();
    const DressingSettings settings{.textures = drive.textured,
                                    .seed = drive.seed,
                                    .pixel_rad = smallest_pixel_rad(drive.views),
                                    .faces = read_signal_faces(drive.road_file)};
    if (drive.mirrored_road) {
        const RoadNetwork original = mirrored(network);
        dress_ground(options);
        Scene there = build_scene(original, options);
        const std::size_t first = there.meshes.size();
        add_dressing(there, original, Route(original, drive.start, drive.via), settings);
        scene.materials = std::move(there.materials);
        scene.textures = std::move(there.textures);
        for (std::size_t i = first; i < there.meshes.size(); ++i)
            scene.meshes.push_back(reflected(std::move(there.meshes[i])));
    } else {
        add_dressing(scene, network, route, settings);
    }
    constexpr std::size_t most_told = 40;
    std::vector<std::string> names = shades_of_lane(scene, route, before);
    const std::size_t more = names.size() > most_told ? names.size() - most_told : 0;
    names.resize(names.size() - more);
    if (!names.empty())
        drive.notes.push_back(fmt::format("dressed objects that shade the own lane somewhere on the route: {}{}", fmt::join(names, "; "),
                                          more > 0 ? fmt::format("; and {} more", more) : ""));
}

} // namespace

Scene staged_scene(Drive& drive, const RoadNetwork& network, const Route& route) {
    RoadMeshOptions options{.textures = drive.textured, .seed = drive.seed, .surface = drive.road_surface};
    if (drive.dressing == Dressing::none)
        options.leave_out = [](const RoadObject&) { return true; };
    else if (drive.dressing == Dressing::dressed)
        dress_ground(options, drive.mirrored_road);
    Scene scene = build_scene(network, options);
    if (drive.dressing == Dressing::dressed)
        dress(scene, drive, network, route, options);
    for (const PlacedModel& placed : drive.scenery)
        if (placed.along_route && placed.position_m.x > route.length_m())
            drive.notes.push_back(fmt::format("{}: stands {:g} m along the route, which ends at {:.0f} m", placed.file.filename().string(),
                                              placed.position_m.x, route.length_m()));
    add_scenery(scene, drive.scenery, route);
    find_street_lamps(drive, network);
    add_street_lamp_poles(drive, route, scene);
    if (drive.daylight != Daylight{})
        add_far_ground(scene);
    lay_on_route(drive, route);
    simulate_bus(drive, route);
    fit_to_route(drive, route);
    simulate(drive, route);
    place_traffic(drive, network, route);
    simulate_control(drive, route);
    add_road_users(scene, drive.traffic, drive.opened, drive.dressing == Dressing::dressed);
    add_own_car(scene, drive);
    return scene;
}

namespace {

constexpr double below_windows = 5.0 / 6.0; // of the eye's height: bonnets, doors and dashboards reach so far up

const View* eye_of(const Drive& drive) {
    const auto view = std::ranges::find(drive.views, Projection::perspective, &View::projection);
    return view == drive.views.end() ? nullptr : &*view;
}

/// Keeps of a mesh in the car's frame what stands before an eye at `eye_m` and below the windows.
void keep_before(Mesh& mesh, const glm::dvec3& eye_m) {
    std::vector<std::uint32_t> indices;
    for (Batch& batch : mesh.batches) {
        const auto first = static_cast<std::uint32_t>(indices.size());
        for (std::uint32_t k = batch.first; k + 2 < batch.first + batch.count; k += 3) {
            double highest_m = -std::numeric_limits<double>::infinity(), sum_x_m = 0.0;
            for (std::uint32_t i = 0; i < 3; ++i) {
                const glm::dvec3 at = mesh.origin_m + glm::dvec3(mesh.vertices[mesh.indices[k + i]].position_m);
                highest_m = std::max(highest_m, at.z);
                sum_x_m += at.x;
            }
            if (highest_m < below_windows * eye_m.z && sum_x_m > 3.0 * eye_m.x)
                indices.insert(indices.end(), {mesh.indices[k], mesh.indices[k + 1], mesh.indices[k + 2]});
        }
        batch.first = first;
        batch.count = static_cast<std::uint32_t>(indices.size()) - first;
    }
    mesh.indices = std::move(indices);
    std::erase_if(mesh.batches, [](const Batch& batch) { return batch.count == 0; });
}

} // namespace

void add_own_car(Scene& scene, const Drive& drive) {
    const View* driver = eye_of(drive);
    if (!drive.own_car || driver == nullptr)
        return;
    const std::size_t before = scene.meshes.size();
    add_model(scene, *drive.own_car->model, {{}, axes_from_angles(drive.own_car->yaw_rad, 0.0, 0.0)}, drive.own_car->scale,
              SurfaceKind::vehicle);
    for (std::size_t i = before; i < scene.meshes.size(); ++i) {
        Mesh& mesh = scene.meshes[i];
        keep_before(mesh, driver->position_m);
        mesh.name = "own car";
        mesh.body = static_cast<int>(drive.traffic.size());
        mesh.casts = false;
    }
    std::erase_if(scene.meshes, [](const Mesh& mesh) { return mesh.batches.empty() && mesh.name == "own car"; });
    unify_texture_sizes(scene);
}

} // namespace fernlicht
