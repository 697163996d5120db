// Tone mapper and display in a drive file. Readers throw InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/yaml/yaml_entry.h"

namespace fernlicht {

template <class Struct> struct Fields;

const Fields<ToneMapper>& tone_mapper_fields();
/// A kind, or a map with the keys that its kind uses.
void read_tone_mapper(const YamlEntry& given, ToneMapper& mapper);
const Fields<DisplaySettings>& display_fields();
/// A profile's file, which is opened, or a map.
void read_display(const YamlEntry& given, Drive& drive);

} // namespace fernlicht
