// The light of the sky, the weather and street lamps in a drive file. Readers throw InputError (yaml_entry.h).
#pragma once

#include "scenarios/drives/keys/lamp_sets.h"

namespace fernlicht {

/// `daylight`: "night", "twilight", "day"; figures of the sky, sun and moon; or date, time and place.
Daylight read_daylight(const YamlMap& drive);
/// `weather`: fog, rain and snow by name, or the medium's figures; wetness.
Weather read_weather(const YamlMap& drive);
/// `street_lamps`: rows by name.
std::vector<StreetLampRow> read_street_lamps(const YamlMap& drive, LampShelf& shelf);

/// YAML that is read back to the same; one line each, with its end. Nothing for clear and dry weather.
std::string write_daylight(const Daylight& daylight);
std::string write_weather(const Weather& weather);

} // namespace fernlicht
