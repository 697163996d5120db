#include "scenarios/drives/keys/story_drive.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/library_folders.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

std::string lower_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

/// In double quotes, as YAML reads it back.
std::string quoted_text(const std::string& text) {
    std::string out = "\"";
    for (const char c : text)
        if (c == '"' || c == '\\')
            out += {'\\', c};
        else
            out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    return out + '"';
}

fs::path shipped_lamp(const fs::path& storyboard) {
    if (fs::path lamp = shipped_path("lamps/halogen-low.ies"); !lamp.empty())
        return lamp;
    throw InputError({storyboard, 0, 0, {}},
                     "no drive says which lamps the cars have, and there is no lamps/halogen-low.ies in " + library_places(),
                     "a drive file with `storyboard:` and lamps");
}

std::string own_car(const osc::Storyboard& story) {
    for (const std::string_view usual : {"ego", "hero", "ego_vehicle", "egovehicle", "ego vehicle"}) {
        const osc::Entity* found = nullptr;
        for (const osc::Entity& entity : story.entities)
            if (lower_case(entity.name) == usual && (!found || entity.name == "Ego"))
                found = &entity;
        if (found)
            return found->name;
    }
    const auto vehicle = std::ranges::find(story.entities, osc::EntityKind::vehicle, &osc::Entity::kind);
    if (vehicle == story.entities.end())
        throw InputError({story.file, 0, 0, "Entities"}, "no vehicle", "a Vehicle that is the own car");
    return vehicle->name;
}

} // namespace

bool is_storyboard_file(const fs::path& path) { return lower_case(path.extension().string()) == ".xosc"; }

std::string storyboard_drive_text(const fs::path& path, const DriveEdits& edits) {
    osc::StoryboardOptions options;
    options.lenient = edits.lenient;
    options.road = edits.road.value_or("");
    for (const fs::path& folder : edits.road_folders)
        options.road_folders.push_back(fs::absolute(folder).lexically_normal());
    const osc::Storyboard story = osc::read_storyboard(path, options);
    const std::string lamp = quoted_text(shipped_lamp(path).string());
    return fmt::format("fernlicht: 1\n"
                       "name: {}\n"
                       "title: {}\n"
                       "storyboard: {{file: {}, ego: {}}}\n"
                       "lamp_sets: {{halogen: {{source: filament, file: {}}}}}\n"
                       "traffic: {{others: {{entities: all, file: {}}}}}\n",
                       quoted_text(name_from(path)), quoted_text(story.description.empty() ? path.stem().string() : story.description),
                       quoted_text(fs::absolute(path).lexically_normal().string()),
                       quoted_text(edits.ego.empty() ? own_car(story) : edits.ego), lamp, lamp);
}

} // namespace fernlicht
