#include "scenarios/drives/drive.h"

#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/keys/bus_keys.h"
#include "scenarios/drives/keys/daylight_keys.h"
#include "scenarios/drives/keys/display_keys.h"
#include "scenarios/drives/keys/drive_edits.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/scenery_keys.h"
#include "scenarios/drives/keys/story_drive.h"
#include "scenarios/drives/keys/storyboard_keys.h"
#include "scenarios/drives/keys/traffic_keys.h"
#include "scenarios/drives/play/drive_log.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int schema_version = 1;
constexpr std::size_t most_bytes = std::size_t{4} << 20;
constexpr double most_ticks = 1.0e7;

void read_route(const YamlMap& keys, Drive& drive) {
    const auto given = keys.find("route");
    if (!given)
        return;
    const YamlMap route = given->map({"road", "lane", "s_m", "via"});
    if (const auto road = route.find("road"))
        drive.start.road = road->text();
    if (const auto lane = route.find("lane"))
        drive.start.lane = lane->whole(-1000, 1000);
    drive.start.s_m = route.number_or("s_m", 0.0, 0.0, 1.0e6);
    if (const auto via = route.find("via"))
        for (const YamlEntry& road : via->list(0, 10'000))
            drive.via.push_back(road.text());
}

/// float, eight-bit, or size and depth.
std::optional<BeamTexels> read_beams(const YamlEntry& given) {
    if (given.is_scalar())
        return given.choice({"float", "eight-bit"}) == 1 ? std::optional(eight_bit_texels) : std::nullopt;
    const YamlMap keys = given.map({"width", "height", "bits"});
    const YamlEntry bits = keys.require("bits");
    BeamTexels texels{keys.require("width").whole(least_beam_texels, most_beam_texels),
                      keys.require("height").whole(least_beam_texels, most_beam_texels), bits.whole(0, 1000)};
    if (texels.bits != 8 && texels.bits != 16 && texels.bits != 32)
        bits.refuse("8, 16 or 32");
    return texels;
}

void read_time(const YamlMap& keys, Drive& drive) {
    drive.step_s = read_step_s(keys);
    if (drive.storyboard)
        return;
    drive.speed = read_speed(keys);
    const YamlEntry duration = keys.require("duration_s");
    drive.duration_s = duration.number_above(0.0, 1.0e6);
    if (drive.duration_s / drive.step_s > most_ticks)
        duration.refuse(fmt::format("{:.0f} steps of {} s", drive.duration_s / drive.step_s, drive.step_s),
                        fmt::format("at most {:.0f}", most_ticks));
}

/// Libraries of plug-ins decide results as any input does: each is among what was opened, once.
void note_plugin_libraries(Drive& drive) {
    for (const Variant& variant : drive.variants) {
        if (!variant.control)
            continue;
        for (const PluginParameters& plugin : variant.control->plugins)
            if (std::ranges::none_of(drive.opened, [&](const FileRead& known) { return known.path == plugin.library; }))
                read_file(plugin.library, drive.opened);
    }
}

Drive read_all(const YamlMap& keys, const std::filesystem::path& path, const DriveEdits& edits, LampShelf& shelf) {
    Drive drive;
    drive.file = path;
    const auto name = keys.find("name"), title = keys.find("title");
    drive.name = name ? name->name() : name_from(path);
    drive.title = title ? title->text() : drive.name;
    drive.storyboard = read_storyboard_keys(keys, edits, drive);
    if (const auto road = keys.find("road"); road || !drive.storyboard) {
        const YamlEntry given = keys.require("road");
        drive.road_file = given.path();
        check_file(drive.road_file, given);
    }
    if (drive.road_file.empty() && !edits.road)
        keys.require("storyboard").refuse("a scenario that names no road", "road: the OpenDRIVE file, or --road FILE");
    drive.mirrored_road = keys.flag_or("mirrored_road", drive.mirrored_road);
    read_route(keys, drive);
    read_time(keys, drive);
    if (drive.storyboard) {
        drive.storyboard->own_daylight = keys.find("daylight").has_value();
        drive.storyboard->own_weather = keys.find("weather").has_value();
    }
    drive.daylight = read_daylight(keys);
    drive.weather = read_weather(keys);
    drive.street_lamps = read_street_lamps(keys, shelf);
    const Car car = read_car(keys);
    drive.bumper_m = car.bumper_m;
    drive.wheelbase_m = car.wheelbase_m;
    drive.own_car = car.model;
    if (car.model) {
        drive.opened.insert(drive.opened.end(), car.model->model->opened.begin(), car.model->model->opened.end());
        for (const std::string& note : car.model->model->notes)
            drive.notes.push_back(fmt::format("model {}: {}", car.model->model->name, note));
    }
    read_field(drive_fields(), "vehicle", keys, &drive);
    drive.variants = read_variants(keys, car, shelf);
    note_plugin_libraries(drive);
    read_can(keys, edits, drive);
    read_traffic(keys, shelf, drive);
    check_entities(keys, drive);
    drive.views = read_views(keys, drive.opened);
    read_field(drive_fields(), "capture", keys, &drive);
    drive.tone_mapper = read_tone_mapper(keys);
    drive.display = read_display(keys, drive.opened);
    if (const auto technique = keys.find("technique"))
        drive.technique = technique->name();
    read_scenery(keys, drive);
    drive.extent = ExtentParameters{};
    read_field(drive_fields(), "measure", keys, &drive);
    read_field(drive_fields(), "limits", keys, &drive);
    read_field(drive_fields(), "shadows", keys, &drive);
    if (const auto beams = keys.find("beams"))
        drive.beams = read_beams(*beams);
    if (const auto textures = keys.find("textures"))
        drive.textured = textures->choice({"none", "shipped"}) == 1;
    if (const auto seed = keys.find("seed"))
        drive.seed = seed->count();
    return drive;
}

} // namespace

Drive read_drive(const std::filesystem::path& path, const DriveEdits& edits) {
    FilesRead opened;
    const std::string text = is_storyboard_file(path) ? storyboard_drive_text(path, edits) : to_utf8(read_file(path, opened, most_bytes));
    const YamlValue document = parse_yaml(text, path);
    const YamlMap keys(YamlEntry(document, path, ""),
                       {"fernlicht", "name",     "title",        "road",       "route",         "speed_kmh", "speed_mps", "speed",
                        "step_s",    "rate_hz",  "duration_s",   "daylight",   "car",           "vehicle",   "actuators", "control",
                        "variants",  "changes",  "views",        "capture",    "tone_mapper",   "technique", "measure",   "limits",
                        "shadows",   "textures", "beams",        "seed",       "mirrored_road", "weather",   "traffic",   "traffic_light",
                        "scenery",   "view_set", "street_lamps", "storyboard", "can",           "display"});
    if (keys.require("fernlicht").whole(0, 1'000'000) != schema_version)
        keys.require("fernlicht").refuse(fmt::format("{}, the version of the drive file's schema", schema_version));
    LampShelf shelf;
    Drive drive = read_all(keys, path, edits, shelf);
    apply_edits(drive, edits, shelf);
    drive.lamp_sources = shelf.sources();
    if (edits.replay)
        drive.replay = std::make_shared<const DriveLog>(read_drive_log(*edits.replay, opened));
    opened.insert(opened.end(), drive.opened.begin(), drive.opened.end());
    drive.opened = std::move(opened);
    drive.opened.insert(drive.opened.end(), shelf.opened().begin(), shelf.opened().end());
    return drive;
}

} // namespace fernlicht
