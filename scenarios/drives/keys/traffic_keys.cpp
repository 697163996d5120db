#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/models/model.h"
#include "scenarios/values/refusals.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>

namespace fernlicht {
namespace {

constexpr int max_users = 2000;

template <TrafficPlace place> bool is_at(const void* row) { return static_cast<const TrafficRow*>(row)->place == place; }
bool is_on_road(const void* row) { return !is_at<TrafficPlace::storyboard>(row); }

const Fields<TrafficRow>& gap_fields() {
    static const Fields<TrafficRow> fields{
        field("gap_m", 1, &TrafficRow::gap_m, range(0.0, 1.0e5), "from the own car's start along the route").required(),
    };
    return fields;
}

const Fields<Route::Start>& lane_fields() {
    static const Fields<Route::Start> fields = [] {
        Fields<Route::Start> of = start_fields();
        for (Field& field : of.fields)
            field.is_required = field.key == "lane";
        return of;
    }();
    return fields;
}

std::string entities_text(const TrafficRow& row) {
    std::vector<std::string> names;
    for (const std::string& entity : row.entities)
        names.push_back(quoted(entity));
    return names.empty() ? "all" : fmt::format("[{}]", fmt::join(names, ", "));
}

void read_face(const YamlEntry& entry, TrafficRow& row) {
    const std::vector<double> m = entry.numbers(2, 2, 0.005, 2.0);
    row.face_m = {m[0], m[1]};
}

std::string face_text(const TrafficRow& row) { return fmt::format("[{}, {}]", row.face_m.x, row.face_m.y); }

TrafficRow default_row() {
    TrafficRow row;
    row.tail_cd = 6.0, row.brake_cd = 80.0;
    return row;
}

std::string place_and_speed_schema() {
    return fmt::format(R"({{"allOf": [{{"oneOf": [{{"required": ["oncoming"]}}, {{"required": ["ahead"]}}, {{"required": ["lane"]}},
        {{"required": ["entities"]}}]}}, {{"oneOf": [{{"required": ["speed_kmh"]}}, {{"required": ["speed_mps"]}},
        {{"required": ["speed"]}}, {{"required": ["entities"], "not": {{"anyOf": [{{"required": ["speed_kmh"]}},
        {{"required": ["speed_mps"]}}, {{"required": ["speed"]}}]}}}}]}}, {}]}})",
                       needs_model);
}

void read_place(const YamlMap& keys, TrafficRow& row) {
    const auto given = keys.one_of({"oncoming", "ahead", "lane", "entities"});
    if (!given)
        keys.refuse_missing("oncoming", "oncoming: {gap_m}, ahead: {gap_m}, lane: {road, lane, s_m} or entities: of a storyboard");
    if (given->first == "entities") {
        row.place = TrafficPlace::storyboard;
        if (given->second.is_list())
            for (const YamlEntry& entity : given->second.list(1, max_traffic_rows))
                row.entities.push_back(entity.text());
        else if (given->second.text() != "all")
            given->second.refuse("all, or a list of entities' names");
        return;
    }
    row.place = given->first == "lane" ? TrafficPlace::lane : given->first == "ahead" ? TrafficPlace::ahead : TrafficPlace::oncoming;
    read_field(traffic_fields(), given->first, keys, &row);
}

/// Lamps of cars stand on its front corners, those of what is narrow in the middle.
Car front_of(const TrafficRow& row) {
    const glm::dvec3 size = row.size_m.value_or(default_size_m(row.kind));
    const double x = row.rear_m.value_or(default_rear_m(row.kind) * size.x / default_size_m(row.kind).x) + size.x +
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

TrafficRow read_row(const std::string& name, const YamlEntry& entry, LampCache& cache) {
    const Fields<TrafficRow>& fields = traffic_fields();
    const YamlMap keys = entry.map(keys_of(fields));
    TrafficRow row = default_row();
    row.name = name;
    read_field(fields, "kind", keys, &row);
    if (row.kind == RoadUserKind::pedestrian) // carries no lamps
        row.tail_cd = row.brake_cd = 0.0;
    if (row.kind == RoadUserKind::bicycle)
        row.brake_cd = 0.0;
    read_field(fields, "size_m", keys, &row);
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
        LampSet lamps = read_lamp_set(name, keys, front_of(row), cache);
        if (std::ranges::any_of(lamps.lamps, [](const MountedLamp& lamp) { return lamp.levels != nullptr; }))
            entry.refuse("levels over time of another road user's lamps", "levels in a lamp set of the own car");
        row.lamps = std::move(lamps.lamps);
        row.changes = std::move(lamps.changes);
    }
    EachRead each;
    for (const char* const key : {"face_m", "tail_cd", "brake_cd", "repeat"})
        each([&] { read_field(fields, key, keys, &row); });
    each.end();
    return row;
}

} // namespace

const Fields<TrafficRow>& traffic_fields() {
    using Row = TrafficRow;
    static const Fields<Row> fields =
        Fields<Row>{
            field("kind", 1, &Row::kind, words({std::begin(road_user_kinds), std::end(road_user_kinds)}), "of road user"),
            field("size_m", 2, &Row::size_m, range(0.1, 50.0), "length, width, height; the model's or the kind's by default"),
            field("model", 3, &Row::model, any(), "glTF with its origin under the rear axle").written_off_default(),
            field("yaw", 4, &Row::model_yaw_rad, degrees_within("yaw", 360.0), "how the model is turned").written_off_default(),
            field("scale", 5, &Row::model_scale, range(1.0e-4, 1.0e4), "how much larger the model is").written_off_default(),
            section("oncoming", 6, gap_fields(), "on the nearest lane that leads the other way").heard_if(is_at<TrafficPlace::oncoming>),
            section("ahead", 7, gap_fields(), "on the route").heard_if(is_at<TrafficPlace::ahead>),
            field("lane", 8, &Row::start, lane_fields(), "a place on the road").heard_if(is_at<TrafficPlace::lane>),
            own<Row>("entities", 9, nullptr, entities_text, R"({"oneOf": [{"const": "all"},
                {"type": "array", "minItems": 1, "items": {"type": "string", "minLength": 1}}]})",
                     "of the storyboard: all, or those named, are lit as this row says")
                .heard_if(is_at<TrafficPlace::storyboard>),
            list("speed", 10, &Row::speed, 1, max_speed_points, speed_point_fields(), "linear between points, constant before and after")
                .heard_if(is_on_road),
            form<Row>("speed_kmh", FieldKind::number, range(0.0, 540.0), "for all of the drive"),
            form<Row>("speed_mps", FieldKind::number, range(0.0, 150.0), "for all of the drive"),
            lamps_field<Row>(11),
            forms_of<Row>(light_fields(), "keys of a lamp, for all lamps that do not give them"),
            changes_field<Row>(12).written_off_default(),
            own<Row>("face_m", 13, read_face, face_text,
                     R"({"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "number", "minimum": 0.005, "maximum": 2}})",
                     "width and height of each headlamp's luminous face"),
            field("tail_cd", 14, &Row::tail_cd, range(0.0, 1.0e4), "of each tail lamp on its axis; 0: none (pedestrians)"),
            field("brake_cd", 15, &Row::brake_cd, range(0.0, 1.0e4), "of each brake lamp on its axis; 0: none (pedestrians, bicycles)"),
            section("repeat", 16,
                    Fields<TrafficRow>{
                        field("count", 1, &TrafficRow::count, range(1.0, max_users), "of them").required(),
                        field("every_m", 2, &TrafficRow::every_m, range(1.0, 1.0e4), "from one to the next"),
                    },
                    "a row of them, one behind the other")
                .heard_if(is_on_road),
        }
            .block()
            .at_defaults(default_row())
            .in_schema(place_and_speed_schema());
    return fields;
}

void read_traffic(const YamlMap& keys, LampCache& cache, Drive& drive) {
    EachRead each;
    each([&] { read_field(drive_fields(), "traffic_light", keys, &drive); });
    int users = 0;
    if (const auto rows = keys.find("traffic"))
        for (const auto& [name, entry] : rows->named(max_traffic_rows))
            each([&, &name = name, &entry = entry] {
                drive.traffic_rows.push_back(read_row(name, entry, cache));
                users += drive.traffic_rows.back().count;
                if (users > max_users)
                    entry.refuse(fmt::format("{} road users", users), fmt::format("at most {}", max_users));
            });
    each.end();
}

} // namespace fernlicht
