#include "scenarios/drives/keys/scenery_keys.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_sets.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_models = 10'000, most_triangles = 8'000'000;
constexpr double farthest_place_m = 1.0e7;

void read_place(PlacedModel& placed, const YamlMap& keys) {
    const auto place = keys.one_of({"position_m", "along"});
    if (!place)
        keys.refuse_missing("position_m", "position_m in the world, or along the route");
    placed.along_route = place->first == "along";
    if (placed.along_route) {
        const YamlMap along = place->second.map({"distance_m", "left_m", "above_m"});
        placed.position_m = {along.require("distance_m").number(0.0, farthest_place_m), along.number_or("left_m", 0.0, -2000.0, 2000.0),
                             along.number_or("above_m", 0.0, -2000.0, 2000.0)};
    } else {
        const std::vector<double> xyz = place->second.numbers(3, 3, -farthest_place_m, farthest_place_m);
        placed.position_m = {xyz[0], xyz[1], xyz[2]};
    }
    placed.yaw_rad = keys.angle_rad("yaw", 360.0).value_or(0.0);
    placed.pitch_rad = keys.angle_rad("pitch", 90.0).value_or(0.0);
    placed.roll_rad = keys.angle_rad("roll", 360.0).value_or(0.0);
    placed.scale = keys.number_or("scale", 1.0, 1.0e-4, 1.0e4);
    placed.ground = keys.flag_or("ground", false);
}

std::shared_ptr<const Model> model_of(const YamlEntry& asked_by, Drive& drive) {
    const std::filesystem::path path = asked_by.path();
    for (const PlacedModel& known : drive.scenery)
        if (known.file == path)
            return known.model;
    check_file(path, asked_by);
    auto model = std::make_shared<const Model>(read_model(path));
    drive.opened.insert(drive.opened.end(), model->opened.begin(), model->opened.end());
    for (const std::string& note : model->notes)
        drive.notes.push_back(fmt::format("model {}: {}", model->name, note));
    return model;
}

} // namespace

void read_scenery(const YamlMap& keys, Drive& drive) {
    const auto given = keys.find("scenery");
    if (!given)
        return;
    std::size_t triangles = 0;
    for (const YamlEntry& entry : given->list(0, most_models)) {
        const YamlMap one = entry.map(
            {"model", "position_m", "along", "yaw_deg", "yaw_rad", "pitch_deg", "pitch_rad", "roll_deg", "roll_rad", "scale", "ground"});
        PlacedModel placed;
        const YamlEntry file = one.require("model");
        placed.file = file.path();
        placed.model = model_of(file, drive);
        read_place(placed, one);
        triangles += placed.model->triangles();
        if (triangles > most_triangles)
            entry.refuse(fmt::format("{} triangles of scenery so far", triangles), fmt::format("at most {}", most_triangles));
        drive.scenery.push_back(std::move(placed));
    }
}

} // namespace fernlicht
