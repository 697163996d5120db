#include "runner/experiments/town/town.h"

#include "renderer/device.h"
#include "renderer/renderer.h"
#include "renderer/twin.h"
#include "runner/experiments/town/two_lamps.h"
#include "scenarios/models/free_way.h"
#include "scenarios/values/errors.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double ahead_m = 120.0, behind_m = 10.0, beside_m = 25.0, pixel_m = 0.25;
constexpr double white_cdm2 = 20.0; ///< of the picture
constexpr int headings = 72;
constexpr double street_m = 20.0; ///< of free way, at least

double longest_heading(const SceneGround& ground, const glm::dvec2& at_m) {
    double best = -1.0, heading = 0.0;
    for (int h = 0; h < headings; ++h) {
        const double yaw = 2.0 * pi * h / headings, way = ground.free_way_m(at_m.x, at_m.y, yaw);
        if (way > best) {
            best = way;
            heading = yaw;
        }
    }
    return heading;
}

Pose place_of(const SceneGround& ground, const TownRequest& request) {
    if (!request.at_m) {
        const std::optional<Pose> found = ground.longest_free_way();
        if (!found)
            throw InputError({{}, 0, 0, "MODEL"}, "found no ground that a car could stand on",
                             "streets in metres (--metres-per-unit), or --place X,Y over ground");
        if (!request.heading_rad)
            return *found;
        return *ground.car_at(found->position_m.x, found->position_m.y, *request.heading_rad);
    }
    const glm::dvec2 at = *request.at_m;
    const std::optional<Pose> there = ground.car_at(at.x, at.y, request.heading_rad ? *request.heading_rad : longest_heading(ground, at));
    if (!there)
        throw InputError({{}, 0, 0, "--place"}, fmt::format("no ground at {:g}, {:g}", at.x, at.y), "a place over the model's ground");
    return *there;
}

View driver_view(const TownRequest& request) {
    View view;
    view.name = "driver";
    view.position_m = two_lamps_eye_m;
    view.pitch_rad = -radians(1.0);
    view.width_px = request.width_px;
    view.height_px = request.height_px;
    return view;
}

View map_view() {
    View view;
    view.name = "map";
    view.projection = Projection::map;
    view.map_ahead_m = ahead_m;
    view.map_behind_m = behind_m;
    view.map_left_m = view.map_right_m = beside_m;
    view.width_px = static_cast<int>(2.0 * beside_m / pixel_m);
    view.height_px = static_cast<int>((ahead_m + behind_m) / pixel_m);
    return view;
}

std::vector<TownFound::Row> rows_of(const Scene& scene, const Moment& moment) {
    const Twin twin(scene, true);
    const View map = map_view();
    std::vector<TownFound::Row> rows;
    for (const double ahead : {5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 75.0, 100.0}) {
        TownFound::Row& row = rows.emplace_back(TownFound::Row{ahead, {}});
        for (std::size_t i = 0; i < 3; ++i) {
            const double left = 3.0 - 3.0 * static_cast<double>(i);
            const TwinPixel there = twin.pixel(moment, map, (beside_m - left) / pixel_m, (ahead_m - two_lamps_x_m - ahead) / pixel_m);
            if (there.id != 0)
                row.ground_lx[i] = there.illuminance_lx;
        }
    }
    return rows;
}

} // namespace

TownFound look_at_town(const Model& model, const TownRequest& request) {
    Scene scene;
    add_model(scene, model, {{}, axes_from_angles(request.yaw_rad, 0.0, 0.0)}, request.scale, SurfaceKind::object);
    unify_texture_sizes(scene);
    const SceneGround ground(scene);
    ground.mark_ground(scene);
    TownFound found;
    found.car = place_of(ground, request);
    found.heading_rad = std::atan2(found.car.forward().y, found.car.forward().x);
    found.free_way_m = ground.free_way_m(found.car.position_m.x, found.car.position_m.y, found.heading_rad);
    if (found.free_way_m < street_m)
        found.doubt =
            fmt::format("the way ahead is free for {:.0f} m only: is this a model of streets (a car by itself has a roof for ground), "
                        "in metres (--metres-per-unit), and --place on a street?",
                        found.free_way_m);
    const Moment moment = in_two_lamps(request.lamp, found.car);
    Device device = open_device(request.backend);
    RendererSettings settings;
    settings.technique = request.technique;
    settings.tone_mapper.l_max_cdm2 = white_cdm2;
    settings.white = white_of(moment);
    Renderer renderer(device, scene, settings);
    found.view = renderer.draw(moment, driver_view(request), {.colour = true}).colour;
    found.map.lx = renderer.draw(moment, map_view(), {.illuminance = true}).illuminance_lx;
    found.map.ahead_m = ahead_m;
    found.map.behind_m = behind_m;
    found.map.left_m = found.map.right_m = beside_m;
    found.map.edges.push_back({"car", {{-0.9, 0.9}, {3.7, 0.9}, {3.7, -0.9}, {-0.9, -0.9}, {-0.9, 0.9}}});
    found.rows = rows_of(scene, moment);
    return found;
}

} // namespace fernlicht
