#include "scenarios/drives/keys/lamp_sets.h"

#include "scenarios/drives/keys/control_keys.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/drives/keys/scenery_keys.h"
#include "scenarios/drives/keys/vehicle_keys.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_lamps_of_a_variant = 64, most_variants = 32, most_lamp_changes = 10'000;

std::vector<std::string> mount_names(const Car& car) {
    std::vector<std::string> names;
    for (const LampMount& mount : car.mounts)
        names.push_back(mount.name);
    return names;
}

const LampMount& mount_named(const Car& car, const std::string& name, const YamlEntry& asked_by) {
    for (const LampMount& mount : car.mounts)
        if (mount.name == name)
            return mount;
    const std::vector<std::string> known = mount_names(car);
    const std::string near = nearest_name(name, known);
    asked_by.refuse(fmt::format("no mount '{}' on the car", name),
                    near.empty() ? fmt::format("position_m, or mount: one of {}", fmt::join(known, ", "))
                                 : fmt::format("position_m, or mount: one of {} (nearest: '{}')", fmt::join(known, ", "), near));
}

LampMount place_of_lamp(const std::string& name, const Layers& layers, const Car& car, const YamlEntry& asked_by) {
    const auto position = find_in(layers, "position_m"), mount = find_in(layers, "mount"), turn = find_in(layers, "mount_turn");
    if (position && mount)
        mount->refuse("mount beside position_m", "one of them");
    if (turn && !position)
        turn->refuse("mount_turn without position_m", "position_m beside it; mounts are turned where they are given");
    if (!position)
        return mount ? mount_named(car, mount->name(), *mount) : mount_named(car, name, asked_by);
    LampMount place{name, read_position(*position), {}};
    if (turn) {
        const YamlMap keys = turn->map({"yaw_deg", "yaw_rad", "pitch_deg", "pitch_rad", "roll_deg", "roll_rad"});
        place.turn = {keys.angle_rad("yaw", 360.0).value_or(0.0), keys.angle_rad("pitch", 90.0).value_or(0.0),
                      keys.angle_rad("roll", 360.0).value_or(0.0)};
    }
    return place;
}

MountedLamp build_lamp(const std::string& name, const Layers& layers, const Car& car, LampShelf& shelf, const YamlEntry& asked_by) {
    MountedLamp lamp;
    lamp.name = name;
    const LampMount place = place_of_lamp(name, layers, car, asked_by);
    lamp.position_m = place.position_m;
    lamp.mount = place.turn;
    lamp.file = read_lamp_keys(layers, shelf);
    if (!lamp.file)
        asked_by.refuse("a lamp without a file", "file, in the lamp or in its variant");
    const AimKeys aim = read_aim(layers);
    lamp.pitch_rad = aim.pitch_rad.value_or(0.0);
    lamp.yaw_rad = aim.yaw_rad.value_or(0.0);
    lamp.roll_rad = aim.roll_rad.value_or(0.0);
    const auto number = [&](std::string_view key, double otherwise, double least, double greatest) {
        const auto given = find_in(layers, key);
        return given ? given->number(least, greatest) : otherwise;
    };
    lamp.level = number("level", 1.0, 0.0, 1.0);
    lamp.voltage_v = number("voltage_v", 13.2, 12.0, 13.8);
    lamp.reference_voltage_v = number("reference_voltage_v", 13.2, 12.0, 13.8);
    lamp.photometric_distance_m = number("photometric_distance_m", 0.0, 0.0, 1000.0);
    lamp.source = read_source(layers).value_or(SourceKind::filament);
    lamp.colour = read_colour(layers, lamp.source, shelf, asked_by);
    return lamp;
}

/// A lamp is a map of keys, or just the name of its file.
MountedLamp read_mounted_lamp(const std::string& name, const YamlEntry& entry, const Layers& variant, const Car& car, LampShelf& shelf) {
    if (entry.is_scalar()) {
        YamlValue with_file;
        with_file.kind = YamlValue::Kind::map;
        with_file.line = entry.value().line;
        with_file.column = entry.value().column;
        with_file.members.push_back({"file", entry.value().line, entry.value().column, entry.value()});
        return read_mounted_lamp(name, YamlEntry(with_file, entry.file(), entry.key_path()), variant, car, shelf);
    }
    Layers layers{entry.map({"file", "mount", "position_m", "mount_turn", "aim", "level", "voltage_v", "reference_voltage_v", "source",
                             "temperature_k", "spectrum", "colour", "photometric_distance_m", "between_samples", "type_c_axis", "texture",
                             "mirrored"})};
    layers.insert(layers.end(), variant.begin(), variant.end());
    return build_lamp(name, layers, car, shelf, entry);
}

std::vector<MountedLamp> read_lamps(const YamlEntry& entry, const Layers& variant, const Car& car, LampShelf& shelf) {
    std::vector<MountedLamp> lamps;
    for (const auto& [name, lamp] : entry.named(most_lamps_of_a_variant))
        lamps.push_back(read_mounted_lamp(name, lamp, variant, car, shelf));
    return lamps;
}

/// The lamps that a change names: `lamp`, `lamps`, or all.
std::vector<std::string> changed_lamps(const YamlMap& change, const Variant& variant) {
    std::vector<std::string> known;
    for (const MountedLamp& lamp : variant.lamps)
        known.push_back(lamp.name);
    const auto given = change.one_of({"lamp", "lamps"});
    if (!given)
        return known;
    std::vector<std::string> names;
    for (const YamlEntry& entry : given->first == "lamp" ? std::vector{given->second} : given->second.list(1, most_lamps_of_a_variant)) {
        names.push_back(entry.name());
        if (std::find(known.begin(), known.end(), names.back()) != known.end())
            continue;
        const std::string near = nearest_name(names.back(), known);
        entry.refuse(fmt::format("no lamp '{}' in variant '{}'", names.back(), variant.name),
                     fmt::format("one of {}{}", fmt::join(known, ", "), near.empty() ? "" : fmt::format(" (nearest: '{}')", near)));
    }
    return names;
}

void read_change(const YamlEntry& entry, Variant& variant, LampShelf& shelf) {
    const YamlMap keys = entry.map({"at_s", "lamp", "lamps", "level", "aim", "file", "source", "temperature_k", "spectrum", "colour",
                                    "between_samples", "type_c_axis", "texture", "mirrored"});
    const Layers layers{keys};
    LampChange change;
    change.time_s = keys.require("at_s").number(0.0, 1.0e6);
    if (const auto level = keys.find("level"))
        change.level = level->number(0.0, 1.0);
    const AimKeys aim = read_aim(layers);
    change.pitch_rad = aim.pitch_rad;
    change.yaw_rad = aim.yaw_rad;
    change.roll_rad = aim.roll_rad;
    change.file = read_lamp_keys(layers, shelf);
    for (const std::string_view key : {"between_samples", "type_c_axis", "texture", "mirrored"})
        if (const auto option = keys.find(key); option && !change.file)
            option->refuse("a way to read a file without a file", "file beside it");
    change.source = read_source(layers);
    if (change.source || gives_colour(layers))
        change.colour = read_colour(layers, change.source.value_or(SourceKind::filament), shelf, entry);
    if (!change.level && !change.pitch_rad && !change.yaw_rad && !change.roll_rad && !change.file && !change.colour)
        entry.refuse("a change that changes nothing", "level, aim, file, source or a colour");
    for (const std::string& name : changed_lamps(keys, variant)) {
        change.lamp = name;
        variant.changes.push_back(change);
    }
}

void read_changes(const YamlMap& keys, Variant& variant, LampShelf& shelf) {
    if (const auto given = keys.find("changes"))
        for (const YamlEntry& entry : given->list(0, most_lamp_changes))
            read_change(entry, variant, shelf);
}

/// Changes of the drive hold for every variant; the variant's own come after them. By time; at one time in the order of the file.
void read_all_changes(const YamlMap& drive, const YamlMap* keys, Variant& variant, LampShelf& shelf) {
    read_changes(drive, variant, shelf);
    if (keys)
        read_changes(*keys, variant, shelf);
    std::stable_sort(variant.changes.begin(), variant.changes.end(),
                     [](const LampChange& a, const LampChange& b) { return a.time_s < b.time_s; });
}

Variant read_variant(const std::string& name, const YamlMap& keys, const Car& car, LampShelf& shelf) {
    Variant variant;
    variant.name = name;
    if (const auto lamps = keys.find("lamps"))
        variant.lamps = read_lamps(*lamps, {keys}, car, shelf);
    else
        for (const LampMount& mount : car.mounts)
            if (mount.usual)
                variant.lamps.push_back(build_lamp(mount.name, {keys}, car, shelf, keys.entry()));
    return variant;
}

} // namespace

Variant read_lamp_set(const std::string& name, const YamlMap& keys, const Car& car, LampShelf& shelf) {
    Variant variant = read_variant(name, keys, car, shelf);
    read_changes(keys, variant, shelf);
    std::ranges::stable_sort(variant.changes, {}, &LampChange::time_s);
    return variant;
}

const Fields<Drive>& car_fields() {
    static const Fields<Drive> fields{
        field("bumper_x_m", 1, &Drive::bumper_m, range(-20.0, 20.0), "of the front bumper, from which reach is measured"),
        field("wheelbase_m", 2, &Drive::wheelbase_m, range(0.5, 20.0), "from the rear axle to the front axle"),
        inlined(3, &Drive::own_car, body_fields()),
    };
    return fields;
}

Car read_car(const YamlMap& drive_keys, Drive& drive) {
    Car car;
    // A compact car: lamps 1.2 m apart, 0.65 m above the road, 0.2 m behind the bumper.
    car.mounts = {{"left", {3.4, 0.6, 0.65}, {}}, {"right", {3.4, -0.6, 0.65}, {}}};
    drive.bumper_m = 3.6;
    const auto given = drive_keys.find("car");
    if (!given)
        return car;
    std::vector<std::string_view> known = keys_of(car_fields());
    known.insert(known.end(), {"mounts", "lamps"});
    const YamlMap keys = given->map(known);
    drive.own_car = read_car_model(keys);
    if (drive.own_car) {
        const Model& model = *drive.own_car->model;
        drive.bumper_m = turned_box_m(*drive.own_car).second.x;
        if (std::vector<LampMount> own = lamp_mounts(turned_mounts(model, drive.own_car->yaw_rad, drive.own_car->scale));
            std::ranges::any_of(own, &LampMount::usual))
            car.mounts = std::move(own);
        else
            car.mounts.insert(car.mounts.end(), own.begin(), own.end());
        drive.opened.insert(drive.opened.end(), model.opened.begin(), model.opened.end());
        for (const std::string& note : model.notes)
            drive.notes.push_back(fmt::format("model {}: {}", model.name, note));
    }
    for (const char* const key : {"bumper_x_m", "wheelbase_m"})
        read_field(car_fields(), key, keys, &drive);
    car.lamps = keys.find("lamps");
    if (const auto mounts = keys.find("mounts")) {
        if (!drive.own_car)
            car.mounts.clear();
        for (const auto& [name, place] : mounts->named(most_lamps_of_a_variant)) {
            std::erase_if(car.mounts, [&](const LampMount& mount) { return mount.name == name; });
            car.mounts.push_back(read_lamp_mount(name, place));
        }
    }
    return car;
}

std::vector<Variant> read_variants(const YamlMap& drive, const Car& car, LampShelf& shelf) {
    const auto named = drive.find("variants");
    if (named && car.lamps)
        car.lamps->refuse("lamps on the car beside variants", "one of them");
    if (car.lamps) {
        Variant variant{"lamps", read_lamps(*car.lamps, {}, car, shelf), {}};
        read_all_changes(drive, nullptr, variant, shelf);
        read_actuators(drive, nullptr, variant);
        read_control(drive, nullptr, variant, shelf);
        return {variant};
    }
    if (!named)
        drive.refuse_missing("variants", "named lamp sets, or car.lamps for just one");
    std::vector<Variant> variants;
    for (const auto& [name, entry] : named->named(most_variants)) {
        const YamlMap keys = entry.map({"lamps", "changes", "actuators", "control", "file", "aim", "level", "voltage_v",
                                        "reference_voltage_v", "source", "temperature_k", "spectrum", "colour", "photometric_distance_m",
                                        "between_samples", "type_c_axis", "texture", "mirrored"});
        variants.push_back(read_variant(name, keys, car, shelf));
        read_all_changes(drive, &keys, variants.back(), shelf);
        read_actuators(drive, &keys, variants.back());
        read_control(drive, &keys, variants.back(), shelf);
    }
    return variants;
}

} // namespace fernlicht
