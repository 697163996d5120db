#include "scenarios/drives/drive.h"

#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/keys/bus_keys.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/drives/keys/story_drive.h"
#include "scenarios/drives/play/drive_log.h"
#include "scenarios/fields/field_bits.h"
#include "scenarios/fields/key_path.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/fields/write_fields.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/refusals.h"
#include "scenarios/values/version.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int schema_version = 1;
constexpr std::size_t max_bytes = std::size_t{4} << 20;
constexpr double max_ticks = 1.0e7;

void read_time(const YamlMap& keys, Drive& drive) {
    EachRead each;
    each([&] { drive.step_s = read_step_s(keys); });
    if (drive.storyboard)
        return each.end();
    each([&] { drive.speed = read_speed(keys); });
    each([&] {
        keys.require("duration_s");
        read_field(drive_fields(), "duration_s", keys, &drive);
    });
    each.end();
    if (drive.duration_s / drive.step_s > max_ticks)
        keys.require("duration_s")
            .refuse(fmt::format("{:.0f} steps of {} s", drive.duration_s / drive.step_s, drive.step_s),
                    fmt::format("at most {:.0f}", max_ticks));
}

/// Libraries of plug-ins and FMUs decide results as any input does: each is among what was opened, once.
void note_plugin_libraries(Drive& drive) {
    for (const LampSet& lamp_set : drive.lamp_sets) {
        if (!lamp_set.control)
            continue;
        for (const PluginParameters& plugin : lamp_set.control->plugins)
            if (std::ranges::none_of(drive.opened, [&](const FileRead& known) { return known.path == plugin.library; }))
                read_file(plugin.library, drive.opened);
    }
}

/// What of a drive says which lamps a car has, where, and how they move.
constexpr std::string_view lamp_sets_keys[] = {"car", "vehicle", "actuators", "control", "lamp_sets", "changes"};

YamlValue lamp_sets_document(const std::filesystem::path& path, FilesRead& opened) {
    return parse_yaml(to_utf8(read_file(path, opened, max_bytes)), path);
}

/// Of a whole drive nothing else is heard.
YamlMap lamp_sets_map(const YamlValue& document, const std::filesystem::path& path) {
    const YamlEntry whole(document, path, "");
    if (std::ranges::find(document.members, "fernlicht", &YamlMember::key) != document.members.end())
        return {whole, keys_of(drive_fields())};
    return {whole, lamp_sets_keys};
}

/// `of_car`: the keys of lamp_sets_keys, the drive's own or another file's.
Drive read_all(const YamlMap& keys, const YamlMap& of_car, const std::filesystem::path& path, const DriveEdits& edits, LampCache& cache) {
    Drive drive;
    EachRead each;
    const auto read = [&](std::initializer_list<const char*> described) {
        for (const char* const key : described)
            each([&] { read_field(drive_fields(), key, keys, &drive); });
    };
    drive.file = path;
    drive.name = name_from(path);
    read({"name"});
    drive.title = drive.name;
    read({"title"});
    const bool has_way = each([&] { read_storyboard_keys(keys, edits, drive); });
    const bool has_road = each([&] {
        if (const auto road = keys.find("road"); road || (!drive.storyboard && has_way)) {
            const YamlEntry given = keys.require("road");
            drive.road_file = given.path();
            check_file(drive.road_file, given);
        }
    });
    if (drive.road_file.empty() && !edits.road && has_way && has_road)
        each([&] { keys.require("storyboard").refuse("a scenario that names no road", "road: the OpenDRIVE file, or --road FILE"); });
    read({"mirrored_road", "route"});
    if (has_way)
        each([&] { read_time(keys, drive); });
    if (drive.storyboard) {
        drive.storyboard->own_daylight = keys.find("daylight").has_value();
        drive.storyboard->own_weather = keys.find("weather").has_value();
    }
    read({"daylight", "weather"});
    each([&] { drive.street_lamps = read_street_lamps(keys, cache); });
    Car car;
    const bool has_car = each([&] { car = read_car(of_car, drive); });
    const bool has_vehicle = each([&] { read_field(drive_fields(), "vehicle", of_car, &drive); });
    if (has_car && has_vehicle && each([&] { drive.lamp_sets = read_lamp_sets(of_car, car, cache); })) {
        each([&] { note_plugin_libraries(drive); });
        each([&] { read_can(keys, edits, drive); });
    }
    if (each([&] { read_traffic(keys, cache, drive); }) && has_way)
        each([&] { check_entities(keys, drive); });
    each([&] { drive.views = read_views(keys, drive.opened); });
    drive.extent = ExtentParameters{};
    read({"capture", "tone_mapper", "display", "technique", "scenery", "measure", "limits", "shadows", "beams", "textures", "dressing",
          "road_surface", "seed"});
    each.end();
    return drive;
}

/// What is set has no line in the file.
void take_off_lines(YamlValue& value) {
    value.line = value.column = 0;
    for (YamlValue& item : value.items)
        take_off_lines(item);
    for (YamlMember& member : value.members) {
        member.line = member.column = 0;
        take_off_lines(member.value);
    }
}

YamlValue document_of(const std::string& text, const std::filesystem::path& path, const DriveEdits& edits) {
    YamlValue document = parse_yaml(text, path);
    for (const auto& [key, yaml] : edits.values) {
        YamlValue value = parse_yaml(yaml, path);
        take_off_lines(value);
        set_value(document, drive_fields(), key, value, path);
    }
    return document;
}

} // namespace

Drive read_drive(const std::filesystem::path& path, const DriveEdits& edits) {
    FilesRead opened;
    const std::string text = is_storyboard_file(path) ? storyboard_drive_text(path, edits) : to_utf8(read_file(path, opened, max_bytes));
    refuse_lamp_text(text, path, "a drive");
    const YamlValue document = document_of(text, path, edits);
    if (std::ranges::find(document.members, "fernlicht_study", &YamlMember::key) != document.members.end())
        throw InputError({path, 0, 0, {}}, "is a study", "a drive; `fernlicht study` plays studies");
    const YamlMap keys(YamlEntry(document, path, ""), keys_of(drive_fields()));
    if (keys.require("fernlicht").whole(0, 1'000'000) != schema_version)
        keys.require("fernlicht").refuse(fmt::format("{}, the version of the drive file's schema", schema_version));
    LampCache cache;
    const std::filesystem::path lamp_sets = edits.lamp_sets.value_or("");
    const YamlValue of_lamp_sets = edits.lamp_sets ? lamp_sets_document(lamp_sets, opened) : YamlValue{};
    Drive drive = read_all(keys, edits.lamp_sets ? lamp_sets_map(of_lamp_sets, lamp_sets) : keys, path, edits, cache);
    apply_edits(drive, edits, cache);
    drive.lamp_sources = cache.sources();
    if (edits.replay)
        drive.replay = std::make_shared<const DriveLog>(read_drive_log(*edits.replay, opened));
    opened.insert(opened.end(), drive.opened.begin(), drive.opened.end());
    drive.opened = std::move(opened);
    drive.opened.insert(drive.opened.end(), cache.opened().begin(), cache.opened().end());
    read_adaptation_lamp(drive);
    return drive;
}

std::string write_drive(const Drive& drive) {
    const LampsAreOf lamps(drive);
    return fmt::format("# The resolved drive, written by fernlicht {}: running it again gives the same results.\nfernlicht: 1\n{}",
                       program_version, write_fields(drive_fields(), drive, 0));
}

std::string drive_bits(const Drive& drive) {
    const LampsAreOf lamps(drive);
    return field_bits(drive_fields(), &drive);
}

std::vector<std::pair<std::string, std::string>> drive_bits_by_key(const Drive& drive) {
    const LampsAreOf lamps(drive);
    return field_bits_by_key(drive_fields(), &drive);
}

} // namespace fernlicht
