#include "scenarios/openscenario/reader/read_parts.h"

#include "scenarios/sky/sky_light.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht::osc {
namespace {

void read_box(const OscNode& node, BoundingBox& box) {
    if (const auto centre = node.find("Center")) {
        box.x_m = centre->number_or("x", box.x_m);
        box.y_m = centre->number_or("y", box.y_m);
        box.z_m = centre->number_or("z", box.z_m);
    }
    if (const auto size = node.find("Dimensions")) {
        box.length_m = size->number_or("length", box.length_m);
        box.width_m = size->number_or("width", box.width_m);
        box.height_m = size->number_or("height", box.height_m);
        if (!(box.length_m >= 0.0 && box.width_m >= 0.0 && box.height_m >= 0.0))
            size->refuse("", "has a size below 0", "sizes not below 0");
    }
}

/// Elements that entities are, in the order of EntityKind, with boxes where the file gives none.
struct KnownKind {
    const char *element, *category;
    BoundingBox box;
};
constexpr KnownKind known_kinds[] = {{"Vehicle", "vehicleCategory", {1.4, 0.0, 0.75, 4.5, 1.8, 1.5}},
                                     {"Pedestrian", "pedestrianCategory", {0.0, 0.0, 0.9, 0.5, 0.6, 1.8}},
                                     {"MiscObject", "miscObjectCategory", {0.0, 0.0, 0.5, 1.0, 1.0, 1.0}}};

Entity entity_from(const OscNode& node, const std::string& name) {
    Entity entity;
    entity.name = name;
    entity.kind = node.element() == "Vehicle"      ? EntityKind::vehicle
                  : node.element() == "Pedestrian" ? EntityKind::pedestrian
                                                   : EntityKind::object;
    const KnownKind& kind = known_kinds[static_cast<std::size_t>(entity.kind)];
    entity.category = node.text_or(kind.category, "");
    entity.model = node.text_or("model3d", "");
    entity.box = kind.box;
    if (const auto box = node.find("BoundingBox"))
        read_box(*box, entity.box);
    if (const auto performance = node.find("Performance"))
        entity.limits = read_limits(*performance);
    if (const auto properties = node.find("Properties"); properties && entity.model.empty())
        if (const auto file = properties->find("File"))
            entity.model = file->text("filepath");
    return entity;
}

} // namespace

ReadEntities read_entities(const OscNode& scenario) {
    ReadEntities out;
    const OscNode list = scenario.require("Entities");
    const auto take_name = [&](const OscNode& node) {
        std::string name = node.text("name");
        auto& known = scenario.reading().entities;
        if (std::find(known.begin(), known.end(), name) != known.end())
            node.refuse("name", fmt::format("found a second '{}'", printable(name)), "each name once");
        known.push_back(name);
        return name;
    };
    for (const OscNode& object : list.children("ScenarioObject")) {
        const std::string name = take_name(object);
        std::optional<OscNode> what;
        for (const KnownKind& kind : known_kinds)
            if (const auto own = object.find(kind.element))
                what = own->with_declared();
        if (const auto reference = object.find("CatalogReference"); !what && reference)
            what = catalog_entry(*reference);
        if (!what)
            object.refuse("", "holds no entity", "Vehicle, Pedestrian, MiscObject or CatalogReference");
        out.entities.push_back(entity_from(*what, name));
        if (const auto controller = object.find("ObjectController"))
            controller->note("controllers are not run: the entity moves as the storyboard says");
    }
    for (const OscNode& selection : list.children("EntitySelection")) {
        std::vector<std::string> members;
        const OscNode names = selection.require("Members");
        for (const OscNode& member : names.children("EntityRef"))
            members.push_back(member.entity("entityRef"));
        for (const OscNode& member : names.children("ByObjectType")) // 1.0: ByType
            for (const Entity& entity : out.entities)
                if (member.text("type") == type_of(entity.kind))
                    members.push_back(entity.name);
        out.selections[take_name(selection)] = members;
    }
    return out;
}

namespace {

constexpr double mean_sun_km = 149.598e6;

/// Files before 1.2 have an intensity. It was meant in lux; many write a share instead, which here is one of the clear sky's sun.
std::optional<double> illuminance_of_intensity_lx(const OscNode& sun) {
    const auto intensity = sun.number_if("intensity"), elevation = sun.number_if("elevation");
    if (!intensity || *intensity > 1.0 || !elevation)
        return intensity;
    return *intensity * sun_light(*elevation, *elevation, mean_sun_km, SkyCover::clear).direct_lx;
}

void read_weather(const OscNode& node, Environment& out) {
    if (node.has("fractionalCloudCover"))
        out.cloud_state = node.text("fractionalCloudCover");
    else if (node.has("cloudState"))
        out.cloud_state = node.text("cloudState");
    if (const auto sun = node.find("Sun")) {
        out.sun_azimuth_rad = sun->number_if("azimuth");
        out.sun_elevation_rad = sun->number_if("elevation");
        out.sun_illuminance_lx = sun->has("illuminance") ? sun->number_if("illuminance") : illuminance_of_intensity_lx(*sun);
    }
    if (const auto fog = node.find("Fog"); fog && fog->has("visualRange")) {
        out.fog_visual_range_m = fog->number("visualRange");
        if (!(*out.fog_visual_range_m > 0.0))
            fog->refuse("visualRange", "found a range that is not above 0", "metres above 0");
    }
    if (const auto rain = node.find("Precipitation")) {
        out.precipitation = rain->text_or("precipitationType", rain->text_or("type", "dry"));
        out.precipitation_mm_per_h =
            rain->has("precipitationIntensity") ? rain->number_if("precipitationIntensity") : rain->number_if("intensity"); // 1.0: 0..1
    }
}

} // namespace

Environment read_environment(const OscNode& node) {
    Environment out;
    if (const auto time = node.find("TimeOfDay")) {
        out.date_time = time->has("dateTime") ? std::optional(time->text("dateTime")) : std::nullopt;
        out.time_runs = time->flag_or("animation", false);
    }
    if (const auto weather = node.find("Weather"))
        read_weather(*weather, out);
    if (const auto road = node.find("RoadCondition"); road && road->has("wetness"))
        out.wetness = road->text("wetness");
    return out;
}

} // namespace fernlicht::osc
