// Tone mapper and display in a drive file. Readers throw InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

/// `tone_mapper`: a kind, or a map with the keys that its kind uses.
ToneMapper read_tone_mapper(const YamlMap& drive);
/// `display`: a profile's file, or a map. `opened` gets the file.
DisplaySettings read_display(const YamlMap& drive, FilesRead& opened);

/// YAML that is read back to the same; "" for what was not asked for.
std::string write_tone_mapper(const ToneMapper& mapper);
std::string write_display(const DisplaySettings& display);

} // namespace fernlicht
