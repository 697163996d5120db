#include "runner/commands/model_command.h"

#include "renderer/device.h"
#include "renderer/renderer.h"
#include "runner/commands/commands.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/town/two_lamps.h"
#include "runner/files/json_text.h"
#include "runner/files/picture_file.h"
#include "scenarios/models/material_doubts.h"
#include "scenarios/models/model.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <memory>

namespace fernlicht {
namespace {

constexpr double lamps_x_m = two_lamps_x_m;
const glm::dvec3& eye_m = two_lamps_eye_m;

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
    const int along = static_cast<int>(std::ceil(length_m / 4.0)), across = 16, middle = across / 2;
    for (int i = 0; i <= along; ++i)
        for (int k = 0; k <= across; ++k)
            road.vertices.push_back({{4.0F * static_cast<float>(i), 4.0F * static_cast<float>(k - middle), 0.0F}, {0.0F, 0.0F, 1.0F}});
    const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * (across + 1) + k); };
    for (int i = 0; i < along; ++i)
        for (int k = 0; k < across; ++k)
            for (const std::uint32_t index : {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1)})
                road.indices.push_back(index);
    road.batches.push_back({static_cast<std::uint32_t>(scene.materials.size() - 1), 0, static_cast<std::uint32_t>(road.indices.size())});
    scene.meshes.push_back(std::move(road));
}

/// Asphalt (albedo 0.07) and the model on it, turned and as far ahead as the request says; the frame is that of the car with the lamps,
/// which stand at x = 3.6 m.
Scene model_scene(const Model& model, const ModelRequest& request) {
    Scene scene;
    const auto [low, high] = turned_box(model, request);
    add_road(scene, std::min(400.0, lamps_x_m + request.distance_m + high.x - low.x + 40.0));
    add_model(scene, model, pose_of(model, request), request.scale, SurfaceKind::vehicle);
    unify_texture_sizes(scene);
    return scene;
}

/// From the driver's eye, as wide as the model and its surroundings need.
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

struct OwnBody {
    const char* name;
    Model (*make)(const BodySize&);
    BodySize size;
};

/// Usual sizes.
const OwnBody bodies[] = {{"car", car_body, {{4.5, 1.8, 1.45}, -0.9, glm::vec3(0.25F)}},
                          {"van", van_body, {{5.5, 2.0, 2.3}, -1.1, glm::vec3(0.6F)}},
                          {"truck", truck_body, {{9.0, 2.5, 3.6}, -2.0, glm::vec3(0.35F)}},
                          {"bus", bus_body, {{12.0, 2.55, 3.1}, -3.2, glm::vec3(0.4F)}},
                          {"motorcycle", motorcycle_body, {{2.2, 0.8, 1.6}, -0.4, glm::vec3(0.2F)}},
                          {"bicycle", bicycle_body, {{1.8, 0.6, 1.7}, -0.4, glm::vec3(0.2F)}},
                          {"pedestrian", pedestrian_body, {{0.5, 0.6, 1.75}, -0.25, glm::vec3(0.1F)}}};

void write_model_picture(const Model& model, const ModelRequest& request) {
    const Scene scene = model_scene(model, request);
    const Moment moment = in_two_lamps(request.lamp, {});
    Device device = open_device(request.backend);
    RendererSettings settings;
    settings.technique = request.technique;
    settings.tone_mapper.l_max_cdm2 = 20.0;
    settings.white = white_of(moment);
    Renderer renderer(device, scene, settings);
    const Frame frame = renderer.draw(moment, towards(model, request), {.colour = true});
    write_png(frame.colour, request.picture);
}

} // namespace

Model model_of(const ModelRequest& request) {
    if (request.file.empty() == request.body.empty())
        throw InputError({}, request.file.empty() ? "found no model" : "found both a file and --body", "a glTF file or --body KIND");
    if (request.body.empty())
        return read_model(request.file);
    const auto known = std::ranges::find_if(bodies, [&](const OwnBody& body) { return request.body == body.name; });
    if (known == std::end(bodies))
        throw InputError({{}, 0, 0, "--body"}, "found '" + printable(request.body) + "'",
                         "car, van, truck, bus, motorcycle, bicycle or pedestrian");
    return known->make(known->size);
}

std::string model_text(const Model& model, double scale) {
    const auto millimetres = [](double m) { return std::round(1000.0 * m) / 1000.0 + 0.0; }; // and no negative zero
    const glm::dvec3 size = scale * (model.high_m - model.low_m), low = scale * model.low_m;
    std::size_t vertices = 0;
    for (const Mesh& mesh : model.meshes)
        vertices += mesh.vertices.size();
    std::string text = fmt::format("{}\n  size         {:.3f} m long, {:.3f} m wide, {:.3f} m high\n", model.name, size.x, size.y, size.z);
    text += fmt::format("  origin       {:.3f} m before its rear, {:.3f} m from its right side, {:.3f} m above its lowest point\n",
                        millimetres(-low.x), millimetres(-low.y), millimetres(-low.z));
    text += fmt::format("  triangles    {} in {} mesh{}, {} vertices\n", model.triangles(), model.meshes.size(),
                        model.meshes.size() == 1 ? "" : "es", vertices);
    auto doubt = model.doubts.begin();
    for (std::uint32_t i = 0; i < model.materials.size(); ++i) {
        const Material& m = model.materials[i];
        text += fmt::format(
            "  material     {}: reflects {:.3f} ({:.3f} {:.3f} {:.3f}{}){}{}\n", m.name, mean_reflectance(model, m), m.albedo.r, m.albedo.g,
            m.albedo.b, m.texture >= 0 ? fmt::format(", picture {}", model.textures[static_cast<std::size_t>(m.texture)].name) : "",
            m.retro_rl > 0.0F ? fmt::format(", returns {:.3g} cd/(lx m2)", m.retro_rl) : "",
            m.emission_cdm2 != glm::vec3(0.0F) ? fmt::format(", shines with {:.3g} cd/m2", luminance_of(m.emission_cdm2)) : "");
        for (; doubt != model.doubts.end() && doubt->material == i; ++doubt)
            text += fmt::format("    doubtful   {}\n", doubt->text);
    }
    for (const SurfaceTexture& t : model.textures)
        text += fmt::format("  picture      {}: {} x {} texels\n", t.name, t.width, t.height);
    for (const Mount& m : model.mounts) {
        const glm::dvec3 p = scale * m.pose.position_m;
        text += fmt::format("  mount        {} at [{:.3f}, {:.3f}, {:.3f}]\n", m.name, p.x, p.y, p.z);
    }
    if (model.mounts.empty())
        text += "  mount        none: no node is named lamp...\n";
    for (const std::string& note : model.notes)
        text += fmt::format("  note         {}\n", note);
    return text;
}

std::string model_json(const Model& model, double scale) {
    using Json = nlohmann::ordered_json;
    const auto three = [](const glm::dvec3& v) { return Json{v.x, v.y, v.z}; };
    Json json = {{"name", model.name},
                 {"low_m", three(scale * model.low_m)},
                 {"high_m", three(scale * model.high_m)},
                 {"triangles", model.triangles()},
                 {"meshes", model.meshes.size()},
                 {"materials", Json::array()},
                 {"pictures", Json::array()},
                 {"mounts", Json::array()},
                 {"notes", model.notes}};
    for (std::uint32_t i = 0; i < model.materials.size(); ++i) {
        const Material& m = model.materials[i];
        Json doubts = Json::array();
        for (const MaterialDoubt& doubt : model.doubts)
            if (doubt.material == i)
                doubts.push_back(doubt.text);
        json["materials"].push_back({{"name", m.name},
                                     {"albedo", three(m.albedo)},
                                     {"texture", m.texture},
                                     {"retro_rl", m.retro_rl},
                                     {"reflectance", mean_reflectance(model, m)},
                                     {"emission_cdm2", luminance_of(m.emission_cdm2)},
                                     {"doubts", doubts}});
    }
    for (const SurfaceTexture& t : model.textures)
        json["pictures"].push_back({{"name", t.name}, {"width", t.width}, {"height", t.height}});
    for (const Mount& m : model.mounts)
        json["mounts"].push_back(
            {{"name", m.name}, {"position_m", three(scale * m.pose.position_m)}, {"forward", three(m.pose.forward())}});
    return json_text(json);
}

int model_command(const ModelRequest& request) {
    check_target("--picture", request.picture, request.force);
    check_target("--write", request.write, request.force);
    if ((request.picture == "-") + (request.write == "-") + request.json > 1 && (request.picture == "-" || request.write == "-"))
        throw InputError({{}, 0, 0, request.write == "-" ? "--write" : "--picture"}, "found standard output twice", "one thing to print");
    if (!request.write.empty() && !request.file.empty())
        throw InputError({{}, 0, 0, "--write"}, "found it beside a file", "--body KIND");
    const Model model = model_of(request);
    if (!request.write.empty())
        write_file(request.write, glb_of(model));
    if (!request.picture.empty())
        write_model_picture(model, request);
    if (request.picture != "-" && request.write != "-")
        fmt::print("{}", request.json ? model_json(model, request.scale) : model_text(model, request.scale));
    return 0;
}

void add_model_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto request = std::make_shared<ModelRequest>();
    CLI::App* command = app.add_subcommand("model", "describe a model; render it at night in our lamps");
    command->add_option("FILE", request->file, "glTF (.gltf, .glb), or - for a .glb on standard input");
    command
        ->add_option("--body", request->body, "built-in body in place of a file: car, van, truck, bus, motorcycle, bicycle or pedestrian")
        ->option_text("NAME");
    add_shared(*command, "--picture", request->picture);
    command->add_option("--write", request->write, "new file for the body, NAME.glb, or - for standard output")->option_text("FILE");
    command->add_option("--distance", request->distance_m, "metres from the lamps to the model")
        ->option_text("M")
        ->check(CLI::Range(1.0, 300.0))
        ->capture_default_str();
    add_shared(*command, "--yaw", request->yaw_deg)->check(CLI::Range(-360.0, 360.0))->capture_default_str();
    command->add_option("--metres-per-unit", request->scale, "size of the file's unit")
        ->option_text("M")
        ->check(CLI::Range(1.0e-4, 1.0e4))
        ->capture_default_str();
    add_shared(*command, "--low-beams", request->lamp)->capture_default_str();
    add_shared(*command, "--technique", request->technique)->capture_default_str();
    add_shared(*command, "--backend", request->backend)->capture_default_str();
    add_shared(*command, "--json", request->json);
    add_shared(*command, "--force", request->force);
    command->footer("The picture is a PNG: the model on a level road, lit by two lamps, seen by the driver. With a yaw of 0 it drives "
                    "away, with 180 it comes towards you.");
    command->callback([request, &chosen] { chosen = [request] { return model_command(*request); }; });
    add_town_command(app, chosen);
}

} // namespace fernlicht
