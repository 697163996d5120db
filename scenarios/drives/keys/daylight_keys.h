// The light of the sky, the weather and street lamps in a drive file. Readers throw InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/keys/lamp_sets.h"

namespace fernlicht {

template <class Struct> struct Fields;

const Fields<Daylight>& daylight_fields();
/// "night", "twilight", "day"; figures of the sky, sun and moon; or date, time and place.
void read_daylight(const YamlEntry& given, Drive& drive);
const Fields<Weather>& weather_fields();
/// Fog, rain and snow by name, or the medium's figures; wetness.
void read_weather(const YamlEntry& given, Drive& drive);
/// `street_lamps`: rows by name.
std::vector<StreetLampRow> read_street_lamps(const YamlMap& drive, LampShelf& shelf);

} // namespace fernlicht
