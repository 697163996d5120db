#include "scenarios/drives/keys/traffic_keys.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/models/model.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/common.hpp>

namespace fernlicht {
namespace {

constexpr std::size_t most_rows = 1000;
constexpr int most_users = 2000;

void read_place(const YamlMap& keys, TrafficRow& row) {
    const auto given = keys.one_of({"oncoming", "ahead", "lane", "entities"});
    if (!given)
        keys.refuse_missing("oncoming", "oncoming: {gap_m}, ahead: {gap_m}, lane: {road, lane, s_m} or entities: of a storyboard");
    if (given->first == "entities") {
        row.place = TrafficPlace::storyboard;
        if (given->second.is_list())
            for (const YamlEntry& entity : given->second.list(1, most_rows))
                row.entities.push_back(entity.text());
        else if (given->second.text() != "all")
            given->second.refuse("all, or a list of entities' names");
        return;
    }
    if (given->first == "lane") {
        row.place = TrafficPlace::lane;
        const YamlMap place = given->second.map({"road", "lane", "s_m"});
        if (const auto road = place.find("road"))
            row.start.road = road->text();
        row.start.lane = place.require("lane").whole(-1000, 1000);
        row.start.s_m = place.number_or("s_m", 0.0, 0.0, 1.0e6);
        return;
    }
    row.place = given->first == "ahead" ? TrafficPlace::ahead : TrafficPlace::oncoming;
    row.gap_m = given->second.map({"gap_m"}).require("gap_m").number(0.0, 1.0e5);
}

/// Lamps of cars stand on its front corners, those of what is narrow in the middle.
Car front_of(const TrafficRow& row) {
    const glm::dvec3 size = row.size_m.value_or(usual_size_m(row.kind));
    const double x = row.rear_m.value_or(usual_rear_m(row.kind) * size.x / usual_size_m(row.kind).x) + size.x +
                     0.02; // the face, before the body, which else would hide it from rays
    const double z = std::min(row.kind == RoadUserKind::truck || row.kind == RoadUserKind::bus ? 0.9 : 0.65, 0.6 * size.z);
    Car car;
    car.mounts = lamp_mounts(row.mounts);
    if (std::ranges::any_of(car.mounts, &LampMount::usual))
        return car;
    if (size.y < 1.0)
        car.mounts.push_back({"left", {x, 0.0, 0.75}, {}});
    else
        car.mounts.insert(car.mounts.end(), {{"left", {x, 0.5 * size.y - 0.3, z}, {}}, {"right", {x, 0.3 - 0.5 * size.y, z}, {}}});
    return car;
}

TrafficRow read_row(const std::string& name, const YamlEntry& entry, LampShelf& shelf) {
    const YamlMap keys = entry.map({"kind",
                                    "size_m",
                                    "model",
                                    "yaw_deg",
                                    "yaw_rad",
                                    "scale",
                                    "oncoming",
                                    "ahead",
                                    "lane",
                                    "entities",
                                    "speed_kmh",
                                    "speed_mps",
                                    "speed",
                                    "lamps",
                                    "changes",
                                    "file",
                                    "aim",
                                    "level",
                                    "voltage_v",
                                    "reference_voltage_v",
                                    "source",
                                    "temperature_k",
                                    "spectrum",
                                    "colour",
                                    "photometric_distance_m",
                                    "between_samples",
                                    "type_c_axis",
                                    "texture",
                                    "mirrored",
                                    "face_m",
                                    "tail_cd",
                                    "brake_cd",
                                    "repeat"});
    TrafficRow row;
    row.name = name;
    if (const auto kind = keys.find("kind"))
        row.kind = static_cast<RoadUserKind>(kind->choice({"car", "van", "truck", "bus", "motorcycle", "bicycle", "pedestrian", "other"}));
    if (const auto size = keys.find("size_m")) {
        const std::vector<double> m = size->numbers(3, 3, 0.1, 50.0);
        row.size_m = {m[0], m[1], m[2]};
    }
    if (const auto model = read_car_model(keys)) {
        row.model = model->file;
        row.model_yaw_rad = model->yaw_rad;
        row.model_scale = model->scale;
        row.mounts = turned_mounts(*model->model, model->yaw_rad, model->scale);
        const auto [low, high] = turned_box_m(*model);
        row.rear_m = low.x;
        if (!row.size_m)
            row.size_m = glm::clamp(high - low, glm::dvec3(0.1), glm::dvec3(50.0));
    }
    read_place(keys, row);
    if (row.place != TrafficPlace::storyboard)
        row.speed = read_speed(keys);
    if (keys.find("lamps") || keys.find("file")) {
        Variant lamps = read_lamp_set(name, keys, front_of(row), shelf);
        row.lamps = std::move(lamps.lamps);
        row.changes = std::move(lamps.changes);
    }
    if (const auto face = keys.find("face_m")) {
        const std::vector<double> m = face->numbers(2, 2, 0.005, 2.0);
        row.face_m = {m[0], m[1]};
    }
    row.tail_cd = keys.number_or("tail_cd", 6.0, 0.0, 1.0e4);
    row.brake_cd = keys.number_or("brake_cd", 80.0, 0.0, 1.0e4);
    if (const auto repeat = keys.find("repeat")) {
        const YamlMap many = repeat->map({"count", "every_m"});
        row.count = many.require("count").whole(1, most_users);
        row.every_m = many.number_or("every_m", row.every_m, 1.0, 1.0e4);
    }
    return row;
}

} // namespace

void read_traffic(const YamlMap& keys, LampShelf& shelf, Drive& drive) {
    if (const auto light = keys.find("traffic_light"))
        drive.least_traffic_lx = light->map({"least_lx"}).number_or("least_lx", drive.least_traffic_lx, 1.0e-6, 1.0e3);
    int users = 0;
    if (const auto rows = keys.find("traffic"))
        for (const auto& [name, entry] : rows->named(most_rows)) {
            drive.traffic_rows.push_back(read_row(name, entry, shelf));
            users += drive.traffic_rows.back().count;
            if (users > most_users)
                entry.refuse(fmt::format("{} road users", users), fmt::format("at most {}", most_users));
        }
}

} // namespace fernlicht
