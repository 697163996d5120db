#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/drives/keys/lamp_sets.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_triangles = 8'000'000;
constexpr double farthest_place_m = 1.0e7;

void read_along(const YamlEntry& entry, PlacedModel& placed) {
    const YamlMap along = entry.map({"distance_m", "left_m", "above_m"});
    placed.position_m = {along.require("distance_m").number(0.0, farthest_place_m), along.number_or("left_m", 0.0, -2000.0, 2000.0),
                         along.number_or("above_m", 0.0, -2000.0, 2000.0)};
}

std::string along_text(const PlacedModel& placed) {
    const glm::dvec3& p = placed.position_m;
    return fmt::format("{{distance_m: {}, left_m: {}, above_m: {}}}", p.x, p.y, p.z);
}

bool stands_along(const void* placed) { return static_cast<const PlacedModel*>(placed)->along_route; }
bool stands_in_world(const void* placed) { return !stands_along(placed); }

bool is_of_type(const void* markings) { return static_cast<const Markings*>(markings)->type != MarkingType::standard; }
bool is_of_type_2(const void* markings) { return static_cast<const Markings*>(markings)->type == MarkingType::type_2; }

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

const Fields<PlacedModel>& body_fields() {
    using Placed = PlacedModel;
    static const Fields<Placed> fields{
        field("model", 1, &Placed::file, any(), "glTF or OpenFlight; relative to the drive file"),
        field("yaw", 2, &Placed::yaw_rad, degrees_within("yaw", 360.0), "how the model is turned"),
        field("scale", 3, &Placed::scale, range(1.0e-4, 1.0e4), "how much larger"),
    };
    return fields;
}

const Fields<PlacedModel>& scenery_fields() {
    using Placed = PlacedModel;
    static const Fields<Placed> fields =
        Fields<Placed>{
            field("model", 1, &Placed::file, any(), "glTF or OpenFlight; relative to the drive file").required(),
            field("position_m", 2, &Placed::position_m, range(-farthest_place_m, farthest_place_m), "x, y, z in the road's coordinates")
                .heard_if(stands_in_world),
            own("along", 3, read_along, along_text, R"({"type": "object", "additionalProperties": false, "required": ["distance_m"],
                "properties": {"distance_m": {"type": "number", "minimum": 0, "maximum": 10000000},
                "left_m": {"type": "number", "minimum": -2000, "maximum": 2000},
                "above_m": {"type": "number", "minimum": -2000, "maximum": 2000}}})",
                "the route: distance_m from its start, left_m of the own lane's centre, above_m the surface")
                .bits_by([](const PlacedModel& placed) {
                    const glm::dvec3& p = placed.position_m;
                    return placed.along_route ? fmt::format("along {} {} {}", p.x, p.y, p.z) : "";
                })
                .heard_if(stands_along),
            field("yaw", 4, &Placed::yaw_rad, degrees_within("yaw", 360.0), "against the world's axes, or the route's there"),
            field("pitch", 5, &Placed::pitch_rad, degrees_within("pitch", 90.0), "upwards"),
            field("roll", 6, &Placed::roll_rad, degrees_within("roll", 360.0), "lifts the left side"),
            field("scale", 7, &Placed::scale, range(1.0e-4, 1.0e4), "how much larger"),
            field("ground", 8, &Placed::ground, any(), "it is ground, and stands in maps"),
        }
            .block()
            .in_schema(R"({"oneOf": [{"required": ["position_m"]}, {"required": ["along"]}]})");
    return fields;
}

const Fields<RoadSurface>& road_surface_fields() {
    static const Fields<RoadSurface> fields =
        Fields<RoadSurface>{
            field("pavement", 1, &RoadSurface::pavement, words({"standard", "asphalt-worn", "asphalt-new", "concrete"}),
                  "of lanes; all but standard mirror at grazing angles"),
            field("wheel_tracks", 2, &RoadSurface::wheel_tracks, any(), "each driving lane has two, polished by tyres"),
            field("markings", 3, &RoadSurface::markings,
                  Fields<Markings>{
                      field("type", 1, &Markings::type, words({"standard", "type-1", "type-2"}),
                            "of EN 1436; type 2 retroreflects when it is wet, too"),
                      field("r_class", 2, &Markings::r_class, range(1, 5), "dry, by headlamps: R1 to R5").heard_if(is_of_type),
                      field("rw_class", 3, &Markings::rw_class, range(1, 6), "wet, by headlamps: RW1 to RW6").heard_if(is_of_type_2),
                      field("q_class", 4, &Markings::q_class, range(1, 5), "in diffuse light: Q1 to Q5").heard_if(is_of_type),
                  },
                  "paint; its type alone, or with classes")
                .short_for("type"),
        }
            .block();
    return fields;
}

void read_scenery(const YamlEntry& given, Drive& drive) {
    std::size_t triangles = 0;
    for (const YamlEntry& entry : given.list(0, max_models)) {
        const YamlMap keys = entry.map(keys_of(scenery_fields()));
        PlacedModel placed;
        placed.model = model_of(keys.require("model"), drive);
        const auto place = keys.one_of({"position_m", "along"});
        if (!place)
            keys.refuse_missing("position_m", "position_m in the world, or along the route");
        placed.along_route = place->first == "along";
        read_group(scenery_fields(), keys, &placed);
        triangles += placed.model->triangles();
        if (triangles > max_triangles)
            entry.refuse(fmt::format("{} triangles of scenery so far", triangles), fmt::format("at most {}", max_triangles));
        drive.scenery.push_back(std::move(placed));
    }
}

} // namespace fernlicht
