// The key `storyboard` of a drive.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

/// A file, or {file, ego, road_folders, lenient, parameters, place, day_rate}. Reads the storyboard: what it cannot play is refused here.
/// Takes road, longest time and notes from it. `edits` may add folders and make it lenient. nullopt: the drive has none.
std::optional<StoryboardSource> read_storyboard_keys(const YamlMap& keys, const DriveEdits& edits, Drive& drive);

/// Names in the `entities` of traffic rows: each must be an entity of the storyboard and not the own car; without a storyboard `entities`
/// is refused.
void check_entities(const YamlMap& keys, const Drive& drive);

} // namespace fernlicht
