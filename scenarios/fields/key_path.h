// Key paths, as messages and axes of studies write them: `weather.fog.visibility_m`, `traffic.*.oncoming.gap_m`, `changes.0.level`.
// A dot before each key, name or number of an item (from 0); `*` is all names or items that are there.
#pragma once

#include "scenarios/fields/group.h"
#include "scenarios/yaml/yaml_tree.h"

namespace fernlicht {

/// What is wrong with a path by the description of its keys, as what is said to be expected: "'wetness', the nearest known key of
/// weather"; "" where nothing is. Names that the user chooses, and what functions of their own read, are not looked at.
std::string unknown_in_path(const Group& group, const std::string& path);

/// Puts `value` in place of what stands there, or where nothing does. Short forms on the way (`lamps: {left: low.ies}`, `visibility: true`)
/// become maps of what they say; other ways to give the same key (`speed_mps` for `speed_kmh`) go. Throws InputError with `file` and path
/// where the document has nothing of such a name, nothing that `*` stands for, or a value without keys on the way.
void set_value(YamlValue& document, const Group& group, const std::string& path, const YamlValue& value, const std::filesystem::path& file);

/// True where one path lies within the other, or both say the same (`speed_kmh`, `speed_mps`); `*` is any name.
bool paths_overlap(const std::string& a, const std::string& b);

} // namespace fernlicht
