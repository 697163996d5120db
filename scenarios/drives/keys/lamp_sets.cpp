#include "scenarios/drives/keys/lamp_sets.h"

#include "scenarios/drives/keys/control_fields.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/refusals.h"

#include <algorithm>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>

namespace fernlicht {
namespace {

const LampMount& mount_named(const Car& car, const std::string& name, const YamlEntry& asked_by) {
    if (const auto found = std::ranges::find(car.mounts, name, &LampMount::name); found != car.mounts.end())
        return *found;
    std::vector<std::string> known;
    for (const LampMount& mount : car.mounts)
        known.push_back(mount.name);
    asked_by.refuse(fmt::format("no mount '{}' on the car", name), "position_m, or mount: " + one_of_names(name, known));
}

void read_lamp_place(const YamlMap& keys, const Car& car, const YamlEntry& asked_by, MountedLamp& lamp) {
    const auto position = keys.find("position_m"), mount = keys.find("mount"), turn = keys.find("mount_turn");
    if (position && mount)
        mount->refuse("mount beside position_m", "one of them");
    if (turn && !position)
        turn->refuse("mount_turn without position_m", "position_m beside it; mounts are turned where they are given");
    if (position) {
        read_field(lamp_fields(), "position_m", keys, &lamp);
        read_field(lamp_fields(), "mount_turn", keys, &lamp);
        return;
    }
    const LampMount& place = mount ? mount_named(car, mount->name(), *mount) : mount_named(car, lamp.name, asked_by);
    lamp.position_m = place.position_m;
    lamp.mount = place.turn;
}

MountedLamp build_lamp(const std::string& name, const YamlMap& keys, const Car& car, LampCache& cache, const YamlEntry& asked_by) {
    MountedLamp lamp;
    lamp.name = name;
    EachRead each;
    each([&] { read_lamp_place(keys, car, asked_by, lamp); });
    each([&] {
        lamp.file = read_lamp_keys(keys, cache);
        if (!lamp.file)
            asked_by.refuse("a lamp without a file", "file, in the lamp or in its lamp set");
    });
    for (const char* const key :
         {"aim", "level", "voltage_v", "reference_voltage_v", "function", "photometric_distance_m", "flux_factor", "source", "levels"})
        each([&] { read_field(lamp_fields(), key, keys, &lamp); });
    each.end();
    if (const auto levels = keys.find("levels"))
        lamp.levels = cache.levels(lamp, *levels);
    lamp.colour = read_colour(keys, lamp.source, cache, asked_by);
    return lamp;
}

/// A lamp is a map of keys, or just the name of its file. `behind` gives what it does not.
MountedLamp read_mounted_lamp(const std::string& name, const YamlEntry& entry, const YamlMap* behind, const Car& car, LampCache& cache) {
    if (!entry.is_scalar())
        return build_lamp(name, entry.map(keys_of(lamp_fields())).before(behind), car, cache, entry);
    YamlValue with_file = entry.value();
    with_file.kind = YamlValue::Kind::map;
    with_file.members.push_back({"file", with_file.line, with_file.column, entry.value()});
    return read_mounted_lamp(name, YamlEntry(with_file, entry.file(), entry.key_path()), behind, car, cache);
}

std::vector<MountedLamp> read_lamps(const YamlEntry& entry, const YamlMap* behind, const Car& car, LampCache& cache) {
    std::vector<MountedLamp> lamps;
    EachRead each;
    for (const auto& [name, lamp] : entry.named(max_lamps))
        each([&, &name = name, &lamp = lamp] { lamps.push_back(read_mounted_lamp(name, lamp, behind, car, cache)); });
    each.end();
    return lamps;
}

/// The lamps that a change names: `lamp`, `lamps`, or all.
std::vector<std::string> changed_lamps(const YamlMap& change, const LampSet& lamp_set) {
    const auto given = change.one_of({"lamp", "lamps"});
    if (!given)
        return lamp_names(lamp_set);
    std::vector<std::string> names;
    for (const YamlEntry& entry : given->first == "lamp" ? std::vector{given->second} : given->second.list(1, max_lamps))
        names.push_back(lamp_name(entry, lamp_set));
    return names;
}

void read_change(const YamlEntry& entry, LampSet& lamp_set, LampCache& cache) {
    const YamlMap keys = entry.map(keys_of(change_fields()));
    LampChange change;
    for (const char* const key : {"at_s", "level", "aim"})
        read_field(change_fields(), key, keys, &change);
    change.file = read_lamp_keys(keys, cache);
    for (const std::string_view key : {"between_samples", "type_c_axis", "texture", "mirrored", "recipe"})
        if (const auto option = keys.find(key); option && !change.file)
            option->refuse("a way to read a file without a file", "file beside it");
    change.source = read_source(keys);
    if (change.source || gives_colour(keys))
        change.colour = read_colour(keys, change.source.value_or(SourceKind::filament), cache, entry);
    if (!change.level && !change.pitch_rad && !change.yaw_rad && !change.roll_rad && !change.file && !change.colour)
        entry.refuse("a change that changes nothing", "level, aim, file, source or a colour");
    for (const std::string& name : changed_lamps(keys, lamp_set)) {
        change.lamp = name;
        lamp_set.changes.push_back(change);
    }
}

/// Changes of the drive hold for every lamp set; the lamp set's own come after them. By time; at one time in the order of the file.
void read_changes(std::initializer_list<const YamlMap*> maps, LampSet& lamp_set, LampCache& cache) {
    EachRead each;
    for (const YamlMap* const keys : maps)
        if (const auto given = keys ? keys->find("changes") : std::nullopt)
            for (const YamlEntry& entry : given->list(0, max_lamp_changes))
                each([&] { read_change(entry, lamp_set, cache); });
    each.end();
    std::ranges::stable_sort(lamp_set.changes, {}, &LampChange::time_s);
}

LampSet read_lamps_of_set(const std::string& name, const YamlMap& keys, const Car& car, LampCache& cache) {
    LampSet lamp_set;
    lamp_set.name = name;
    if (const auto lamps = keys.find("lamps"))
        lamp_set.lamps = read_lamps(*lamps, &keys, car, cache);
    else
        for (const LampMount& mount : car.mounts)
            if (mount.usual)
                lamp_set.lamps.push_back(build_lamp(mount.name, keys, car, cache, keys.entry()));
    return lamp_set;
}

/// Levels and masks are those of one file.
void check_pixels_stay(const YamlMap& drive, const YamlMap* keys, const LampSet& lamp_set) {
    const ControlParameters* const control = lamp_set.control.get();
    const auto refuse = [&](const char* key, const std::string& found, const char* expected) {
        const auto given = keys ? keys->find(key) : std::nullopt;
        (given ? *given : drive.require(key)).refuse(found, expected);
    };
    for (const MountedLamp& lamp : lamp_set.lamps) {
        const bool masked =
            control && control->glare_free &&
            std::ranges::find(control->glare_free->lamps, lamp.name, &SegmentedLamp::name) != control->glare_free->lamps.end();
        if (!masked && !lamp.levels)
            continue;
        if (std::ranges::any_of(lamp_set.changes, [&](const LampChange& change) { return change.lamp == lamp.name && change.file; }))
            refuse("changes",
                   fmt::format("another file for '{}', whose {}", lamp.name, masked ? "beam is masked" : "pixels have levels from a file"),
                   "a lamp set of its own for it");
        if (!control)
            continue;
        if (control->modes && std::ranges::find(control->modes->lamps, lamp.name) != control->modes->lamps.end() &&
            std::ranges::any_of(control->modes->settings, [](const BeamModeSettings& mode) { return mode.file != nullptr; }))
            refuse(
                "control",
                fmt::format("files of modes for '{}', whose {}", lamp.name, masked ? "beam is masked" : "pixels have levels from a file"),
                "modes without files for it");
        for (const PluginParameters& plugin : control->plugins)
            if (lamp.levels && std::ranges::find(plugin.lamps, lamp.name) != plugin.lamps.end())
                refuse("control", fmt::format("a plug-in for '{}', whose pixels have levels from a file", lamp.name), "one of them");
    }
}

/// Of the one lamp set of a drive without lamp sets `keys` are nullptr.
LampSet whole_lamp_set(LampSet lamp_set, const YamlMap& drive, const YamlMap* keys, LampCache& cache) {
    EachRead each;
    each([&] { read_changes({&drive, keys}, lamp_set, cache); });
    each([&] { read_actuators(drive, keys, lamp_set); });
    each([&] { read_control(drive, keys, lamp_set, cache); });
    each.end();
    check_pixels_stay(drive, keys, lamp_set);
    return lamp_set;
}

bool has_actuators(const void* lamp_set) {
    return static_cast<const LampSet*>(lamp_set)->levelling || static_cast<const LampSet*>(lamp_set)->swivel;
}

} // namespace

void check_file(const std::filesystem::path& path, const YamlEntry& asked_by) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    const std::string name = printable(path.string(), 400);
    if (status.type() == std::filesystem::file_type::not_found)
        asked_by.refuse("there is no file " + name, "a file (relative paths start at this file's folder)");
    if (error)
        asked_by.refuse(name + " cannot be read: " + error.message(), "a readable file");
    if (status.type() != std::filesystem::file_type::regular)
        asked_by.refuse(name + " is not a regular file", "a file");
    if (::access(path.c_str(), R_OK) != 0)
        asked_by.refuse(name + " cannot be read: " + std::generic_category().message(errno), "a readable file");
}

std::shared_ptr<const LampFile> LampCache::lamp(const std::filesystem::path& path, const LampReadOptions& options,
                                                const YamlEntry* asked_by) {
    for (const LampSource& source : sources_)
        if (source.path == path && source.options == options)
            return source.file;
    if (asked_by)
        check_file(path, *asked_by);
    auto file = std::make_shared<const LampFile>(read_lamp(path, options));
    for (const FileRead& one : file->opened) // one recipe may be for many lamps
        if (one.path != options.recipe || std::ranges::find(opened_, one.path, &FileRead::path) == opened_.end())
            opened_.push_back(one);
    sources_.push_back({path, options, file});
    return file;
}

LampColour LampCache::spectrum(const std::filesystem::path& path, const YamlEntry& asked_by) {
    if (const auto known = spectra_.find(path); known != spectra_.end())
        return known->second;
    check_file(path, asked_by);
    return spectra_.emplace(path, read_spectrum(path, opened_)).first->second;
}

std::shared_ptr<const LevelTrack> LampCache::levels(const MountedLamp& lamp, const YamlEntry& asked_by) {
    if (!lamp.file->pixels)
        asked_by.refuse("levels of a lamp without pixels", "a pixel lamp as its file");
    check_file(lamp.levels_file, asked_by);
    return read_levels(lamp.levels_file, lamp.file, opened_);
}

std::vector<std::string> lamp_names(const LampSet& lamp_set) {
    std::vector<std::string> names;
    for (const MountedLamp& lamp : lamp_set.lamps)
        names.push_back(lamp.name);
    return names;
}

std::string lamp_name(const YamlEntry& entry, const LampSet& lamp_set) {
    const std::vector<std::string> known = lamp_names(lamp_set);
    std::string name = entry.name();
    if (std::ranges::find(known, name) == known.end())
        entry.refuse(fmt::format("no lamp '{}' in lamp set '{}'", name, lamp_set.name), one_of_names(name, known));
    return name;
}

const Fields<LampSet>& lamp_set_fields() {
    static const Fields<LampSet> fields =
        Fields<LampSet>{
            lamps_field<LampSet>(1),
            forms_of<LampSet>(light_fields(), "keys of a lamp, for all lamps that do not give them"),
            changes_field<LampSet>(2),
            section("actuators", 3, actuators_fields(), "swivel and levelling of all lamps").heard_if(has_actuators),
            field("control", 4, &LampSet::control, law_fields(), "laws that move and dim the lamps; none: the drive's do not hold")
                .schema_by(control_schema),
        }
            .block();
    return fields;
}

LampSet read_lamp_set(const std::string& name, const YamlMap& keys, const Car& car, LampCache& cache) {
    LampSet lamp_set = read_lamps_of_set(name, keys, car, cache);
    read_changes({&keys}, lamp_set, cache);
    return lamp_set;
}

const Fields<Drive>& car_fields() {
    static const Fields<Drive> fields =
        Fields<Drive>{
            field("bumper_x_m", 1, &Drive::bumper_m, range(-20.0, 20.0), "of the front bumper, from which reach is measured"),
            field("wheelbase_m", 2, &Drive::wheelbase_m, range(0.5, 20.0), "from the rear axle to the front axle"),
            inlined(3, &Drive::own_car, body_fields()),
            form<Drive>("mounts", FieldKind::named, names(1, max_lamps), "places for lamps: x, y and z, or with a turn")
                .of(mount_fields())
                .short_list_for("position_m"),
            form<Drive>("lamps", FieldKind::named, names(1, max_lamps), "of a drive without lamp sets").of(lamp_fields()).short_for("file"),
        }
            .in_schema(needs_model);
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
    const YamlMap keys = given->map(keys_of(car_fields()));
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
        for (const auto& [name, place] : mounts->named(max_lamps)) {
            std::erase_if(car.mounts, [&, &given = name](const LampMount& mount) { return mount.name == given; });
            LampMount& mount = car.mounts.emplace_back(LampMount{name, {}, {}});
            if (place.is_list())
                read_value(field_named(mount_fields(), "position_m"), place, &mount);
            else
                read_group(mount_fields(), place, &mount);
        }
    }
    return car;
}

std::vector<LampSet> read_lamp_sets(const YamlMap& drive, const Car& car, LampCache& cache) {
    const auto named = drive.find("lamp_sets");
    if (named && car.lamps)
        car.lamps->refuse("lamps on the car beside lamp sets", "one of them");
    if (car.lamps)
        return {whole_lamp_set({"lamps", read_lamps(*car.lamps, nullptr, car, cache), {}}, drive, nullptr, cache)};
    if (!named)
        drive.refuse_missing("lamp_sets", "named lamp sets, or car.lamps for just one");
    std::vector<LampSet> lamp_sets;
    EachRead each;
    for (const auto& [name, entry] : named->named(max_lamp_sets))
        each([&, &name = name, &entry = entry] {
            const YamlMap keys = entry.map(keys_of(lamp_set_fields()));
            lamp_sets.push_back(whole_lamp_set(read_lamps_of_set(name, keys, car, cache), drive, &keys, cache));
        });
    each.end();
    return lamp_sets;
}

} // namespace fernlicht
