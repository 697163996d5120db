#include "scenarios/drives/keys/storyboard_keys.h"

#include "scenarios/drives/keys/drive_texts.h"
#include "scenarios/values/errors.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_folders = 32, most_parameters = 1000, most_traffic_rows = 1000;
constexpr double fastest_day = 86'400.0;

SkySite read_site(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"latitude_deg", "longitude_deg", "utc_offset_h"});
    SkySite site{keys.require("latitude_deg").number(-90.0, 90.0), keys.require("longitude_deg").number(-180.0, 180.0), {}};
    if (const auto offset = keys.find("utc_offset_h"))
        site.utc_offset_h = offset->number(-14.0, 14.0);
    return site;
}

void read_options(const YamlMap& keys, StoryboardSource& source) {
    if (const auto ego = keys.find("ego"))
        source.ego = ego->text();
    if (const auto folders = keys.find("road_folders"))
        for (const YamlEntry& folder : folders->list(0, most_folders))
            source.options.road_folders.push_back(folder.path());
    source.options.lenient = keys.flag_or("lenient", false);
    if (const auto site = keys.find("place"))
        source.site = read_site(*site);
    source.day_rate = keys.number_or("day_rate", source.day_rate, 0.0, fastest_day);
    if (const auto parameters = keys.find("parameters"))
        for (const auto& [name, value] : parameters->named(most_parameters))
            source.options.parameters[name] = value.text();
}

/// The first of them.
std::string names_of(const osc::Storyboard& story) {
    constexpr std::size_t most = 8;
    std::string out;
    for (std::size_t i = 0; i < std::min(most, story.entities.size()); ++i)
        out += (i > 0 ? ", " : "") + printable(story.entities[i].name);
    return out + (story.entities.size() > most ? ", ..." : "");
}

} // namespace

std::optional<StoryboardSource> read_storyboard_keys(const YamlMap& keys, const DriveEdits& edits, Drive& drive) {
    const auto given = keys.find("storyboard");
    if (!given)
        return {};
    for (const std::string_view other : {"route", "speed", "speed_kmh", "speed_mps", "vehicle", "mirrored_road"})
        if (const auto found = keys.find(other))
            found->refuse(fmt::format("{} beside a storyboard", other), "one of them: the storyboard says where the car goes");
    StoryboardSource source;
    if (given->is_scalar()) {
        source.file = given->path();
    } else {
        const YamlMap inner = given->map({"file", "ego", "road_folders", "lenient", "parameters", "place", "day_rate"});
        source.file = inner.require("file").path();
        read_options(inner, source);
    }
    if (!edits.ego.empty())
        source.ego = edits.ego;
    for (const auto& folder : edits.road_folders)
        source.options.road_folders.push_back(std::filesystem::absolute(folder).lexically_normal());
    source.options.lenient = source.options.lenient || edits.lenient;
    if (const auto duration = keys.find("duration_s"))
        source.most_s = duration->number_above(0.0, 1.0e4);
    const osc::Storyboard story = osc::read_storyboard(source.file, source.options);
    if (std::ranges::none_of(story.entities, [&](const osc::Entity& entity) { return entity.name == source.ego; }))
        given->refuse(fmt::format("no entity '{}' in the storyboard", printable(source.ego)),
                      fmt::format("ego: the name of the entity that is the own car, one of {}", names_of(story)));
    drive.road_file = story.road_file;
    drive.duration_s = source.most_s;
    drive.speed = {{0.0, 0.0}}; // until the story is told
    drive.notes.insert(drive.notes.end(), story.notes.begin(), story.notes.end());
    drive.opened.insert(drive.opened.end(), story.opened.begin(), story.opened.end());
    return source;
}

void check_entities(const YamlMap& keys, const Drive& drive) {
    const auto rows = keys.find("traffic");
    if (!rows)
        return;
    std::optional<osc::Storyboard> story;
    for (const auto& [name, row] : rows->named(most_traffic_rows)) {
        const auto entries = row.named(most_traffic_rows);
        const auto given = std::ranges::find(entries, "entities", &std::pair<std::string, YamlEntry>::first);
        if (given == entries.end())
            continue;
        if (!drive.storyboard)
            given->second.refuse("entities in a drive without a storyboard", "oncoming, ahead or lane, or a storyboard that has them");
        if (!given->second.is_list())
            continue;
        if (!story)
            story = osc::read_storyboard(drive.storyboard->file, drive.storyboard->options);
        for (const YamlEntry& entity : given->second.list(1, most_traffic_rows)) {
            const std::string wanted = entity.text();
            if (wanted == drive.storyboard->ego)
                entity.refuse(fmt::format("'{}', the own car", printable(wanted)),
                              "another entity; the own car's lamps stand under variants");
            if (std::ranges::find(story->entities, wanted, &osc::Entity::name) == story->entities.end())
                entity.refuse(fmt::format("no entity '{}' in the storyboard", printable(wanted)),
                              fmt::format("one of {}", names_of(*story)));
        }
    }
}

std::string storyboard_text(const Drive& drive) {
    if (!drive.storyboard)
        return "";
    const StoryboardSource& source = *drive.storyboard;
    std::string folders;
    for (const auto& folder : source.options.road_folders)
        folders += fmt::format("{}{}", folders.empty() ? "" : ", ", quoted(folder.string()));
    std::string out = fmt::format("\n  file: {}\n  ego: {}\n  lenient: {}\n  road_folders: [{}]", quoted(source.file.string()),
                                  quoted(source.ego), source.options.lenient, folders);
    if (const auto& site = source.site)
        out += fmt::format("\n  place: {{latitude_deg: {}, longitude_deg: {}{}}}", site->latitude_deg, site->longitude_deg,
                           site->utc_offset_h ? fmt::format(", utc_offset_h: {}", *site->utc_offset_h) : "");
    out += fmt::format("\n  day_rate: {}", source.day_rate);
    if (!source.options.parameters.empty())
        out += "\n  parameters:";
    for (const auto& [name, value] : source.options.parameters)
        out += fmt::format("\n    {}: {}", quoted(name), quoted(value));
    return out;
}

std::string storyboard_bits(const Drive& drive) {
    return storyboard_text(drive) + (drive.storyboard && drive.storyboard->own_daylight ? "\nown daylight" : "") +
           (drive.storyboard && drive.storyboard->own_weather ? "\nown weather" : "");
}

} // namespace fernlicht
