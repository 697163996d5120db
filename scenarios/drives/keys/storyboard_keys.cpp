#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/values/errors.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_folders = 32, max_parameters = 1000;
constexpr double fastest_day = 86'400.0;

void read_folders(const YamlEntry& entry, osc::StoryboardOptions& options) {
    for (const YamlEntry& folder : entry.list(0, max_folders))
        options.road_folders.push_back(folder.path());
}

std::string folders_text(const osc::StoryboardOptions& options) {
    std::vector<std::string> folders;
    for (const auto& folder : options.road_folders)
        folders.push_back(quoted(folder.string()));
    return fmt::format("[{}]", fmt::join(folders, ", "));
}

void read_parameters(const YamlEntry& entry, StoryboardSource& source) {
    for (const auto& [name, value] : entry.named(max_parameters))
        source.options.parameters[name] = value.text();
}

std::string parameters_text(const StoryboardSource& source) {
    std::string text;
    for (const auto& [name, value] : source.options.parameters)
        text += fmt::format("\n    {}: {}", quoted(name), quoted(value));
    return text;
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

const Fields<StoryboardSource>& storyboard_fields() {
    using Source = StoryboardSource;
    static const Fields<Source> fields =
        Fields<Source>{
            field("file", 1, &Source::file, any(), "OpenSCENARIO XML; relative to the drive file").required(),
            field("ego", 2, &Source::ego, any(), "the entity that is the own car"),
            inlined(3, &Source::options,
                    Fields<osc::StoryboardOptions>{
                        field("lenient", 1, &osc::StoryboardOptions::lenient, any(), "what is not supported is left out with a note"),
                        own("road_folders", 2, read_folders, folders_text,
                            R"({"type": "array", "maxItems": 32, "items": {"type": "string", "minLength": 1}})",
                            "where its road is looked for, too"),
                    }),
            field("place", 4, &Source::site,
                  Fields<SkySite>{
                      field("latitude_deg", 1, &SkySite::latitude_deg, range(-90.0, 90.0), "north positive").required(),
                      field("longitude_deg", 2, &SkySite::longitude_deg, range(-180.0, 180.0), "east positive").required(),
                      field("utc_offset_h", 3, &SkySite::utc_offset_h, range(-14.0, 14.0),
                            "of times of day without one; by default the longitude's, in whole hours"),
                  },
                  "where an environment's sky is looked at; by default what the road's geoReference names, else 48.14 N, 11.58 E"),
            field("day_rate", 5, &Source::day_rate, range(0.0, fastest_day), "seconds of an animated time of day for one of the drive"),
            own("parameters", 6, read_parameters, parameters_text,
                R"({"type": "object", "minProperties": 1, "additionalProperties": {"type": ["string", "number", "boolean"]}})",
                "values of its declared parameters"),
        }
            .block();
    return fields;
}

void read_storyboard_keys(const YamlMap& keys, const DriveEdits& edits, Drive& drive) {
    const auto given = keys.find("storyboard");
    if (!given)
        return;
    for (const std::string_view other : {"route", "speed", "speed_kmh", "speed_mps", "vehicle", "mirrored_road"})
        if (const auto found = keys.find(other))
            found->refuse(fmt::format("{} beside a storyboard", other), "one of them: the storyboard says where the car goes");
    read_field(drive_fields(), "storyboard", keys, &drive);
    StoryboardSource& source = *drive.storyboard;
    if (!edits.ego.empty())
        source.ego = edits.ego;
    for (const auto& folder : edits.road_folders)
        source.options.road_folders.push_back(std::filesystem::absolute(folder).lexically_normal());
    source.options.lenient = source.options.lenient || edits.lenient;
    source.options.road = edits.road.value_or("");
    if (const auto duration = keys.find("duration_s"))
        source.max_s = duration->number_above(0.0, 1.0e4);
    const osc::Storyboard story = osc::read_storyboard(source.file, source.options);
    if (std::ranges::none_of(story.entities, [&](const osc::Entity& entity) { return entity.name == source.ego; }))
        given->refuse(fmt::format("no entity '{}' in the storyboard", printable(source.ego)),
                      fmt::format("ego: the name of the entity that is the own car, one of {}", names_of(story)));
    drive.road_file = story.road_file;
    drive.duration_s = source.max_s;
    drive.speed = {{0.0, 0.0}}; // until the story is told
    drive.notes.insert(drive.notes.end(), story.notes.begin(), story.notes.end());
    drive.opened.insert(drive.opened.end(), story.opened.begin(), story.opened.end());
}

void check_entities(const YamlMap& keys, const Drive& drive) {
    const auto rows = keys.find("traffic");
    if (!rows)
        return;
    std::optional<osc::Storyboard> story;
    for (const auto& [name, row] : rows->named(max_traffic_rows)) {
        const auto entries = row.named(max_traffic_rows);
        const auto given = std::ranges::find(entries, "entities", &std::pair<std::string, YamlEntry>::first);
        if (given == entries.end())
            continue;
        if (!drive.storyboard)
            given->second.refuse("entities in a drive without a storyboard", "oncoming, ahead or lane, or a storyboard that has them");
        if (!given->second.is_list())
            continue;
        if (!story)
            story = osc::read_storyboard(drive.storyboard->file, drive.storyboard->options);
        for (const YamlEntry& entity : given->second.list(1, max_traffic_rows)) {
            const std::string wanted = entity.text();
            if (wanted == drive.storyboard->ego)
                entity.refuse(fmt::format("'{}', the own car", printable(wanted)),
                              "another entity; the own car's lamps stand under lamp sets");
            if (std::ranges::find(story->entities, wanted, &osc::Entity::name) == story->entities.end())
                entity.refuse(fmt::format("no entity '{}' in the storyboard", printable(wanted)),
                              fmt::format("one of {}", names_of(*story)));
        }
    }
}

} // namespace fernlicht
