// The parts of a drive file, each read by one function. Every one throws InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/fields/group.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

template <class Struct> struct Fields;

inline constexpr std::size_t most_views = 64;
inline constexpr int largest_view_px = 16384; ///< to a side; the least that OpenGL 4.5 promises

/// `speed_kmh`, `speed_mps` or `speed` (a list of {at_s, speed_kmh or speed_mps}, times ascending).
std::vector<SpeedPoint> read_speed(const YamlMap& drive);
/// `step_s` or `rate_hz`; 30 per second by default.
double read_step_s(const YamlMap& drive);
/// `view_set`, a file of views, and named `views` that come after it or take the place of its own; a map where neither has one; a
/// driver's view and a map by default. `opened` gets the file.
std::vector<View> read_views(const YamlMap& drive, FilesRead& opened);
const Fields<View>& view_fields();
/// The drive's own keys (fields/field.h), in the order of resolved drives.
const Group& drive_fields();

/// Position from [x, y, z], each within 100 m of the car's origin.
glm::dvec3 read_position(const YamlEntry& entry);
/// A file's stem, made a name that YamlEntry::name accepts.
std::string name_from(const std::filesystem::path& path);

} // namespace fernlicht
