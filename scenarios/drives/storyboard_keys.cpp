#include "scenarios/drives/storyboard_keys.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_folders = 32, most_parameters = 1000;

void read_options(const YamlMap& keys, StoryboardSource& source) {
    if (const auto ego = keys.find("ego"))
        source.ego = ego->text();
    if (const auto folders = keys.find("road_folders"))
        for (const YamlEntry& folder : folders->list(0, most_folders))
            source.options.road_folders.push_back(folder.path());
    source.options.lenient = keys.flag_or("lenient", false);
    if (const auto parameters = keys.find("parameters"))
        for (const auto& [name, value] : parameters->named(most_parameters))
            source.options.parameters[name] = value.text();
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += '\\';
        out += c;
    }
    return out + '"';
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
        const YamlMap inner = given->map({"file", "ego", "road_folders", "lenient", "parameters"});
        source.file = inner.require("file").path();
        read_options(inner, source);
    }
    for (const auto& folder : edits.road_folders)
        source.options.road_folders.push_back(std::filesystem::absolute(folder).lexically_normal());
    source.options.lenient = source.options.lenient || edits.lenient;
    if (const auto duration = keys.find("duration_s"))
        source.most_s = duration->number_above(0.0, 1.0e4);
    const osc::Storyboard story = osc::read_storyboard(source.file, source.options);
    if (std::ranges::none_of(story.entities, [&](const osc::Entity& entity) { return entity.name == source.ego; }))
        given->refuse(fmt::format("no entity '{}' in the storyboard", source.ego), "ego: the name of the entity that is the own car");
    drive.road_file = story.road_file;
    drive.duration_s = source.most_s;
    drive.speed = {{0.0, 0.0}}; // until the story is told
    drive.notes.insert(drive.notes.end(), story.notes.begin(), story.notes.end());
    drive.opened.insert(drive.opened.end(), story.opened.begin(), story.opened.end());
    return source;
}

std::string write_storyboard(const StoryboardSource& source) {
    std::string out = fmt::format("storyboard:\n  file: {}\n  ego: {}\n  lenient: {}\n", quoted(source.file.string()), quoted(source.ego),
                                  source.options.lenient);
    std::string folders;
    for (const auto& folder : source.options.road_folders)
        folders += fmt::format("{}{}", folders.empty() ? "" : ", ", quoted(folder.string()));
    out += fmt::format("  road_folders: [{}]\n", folders);
    if (!source.options.parameters.empty())
        out += "  parameters:\n";
    for (const auto& [name, value] : source.options.parameters)
        out += fmt::format("    {}: {}\n", quoted(name), quoted(value));
    return out;
}

} // namespace fernlicht
