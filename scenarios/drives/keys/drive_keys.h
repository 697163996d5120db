// The parts of a drive file: descriptions of their keys, and their readers, one function each. Every reader throws InputError
// (yaml_entry.h).
#pragma once

#include "scenarios/drives/keys/lamp_sets.h"

namespace fernlicht {

template <class Struct> struct Fields;

inline constexpr std::size_t max_views = 64, max_models = 10'000, max_speed_points = 10'000, max_traffic_rows = 1000,
                             max_street_lamp_rows = 32;
inline constexpr int largest_view_px = 16384; ///< to a side; the least that OpenGL 4.5 promises

/// The drive's own keys (fields/field.h), in the order of resolved drives.
const Fields<Drive>& drive_fields();
/// What hashes of a drive are taken over: ids and bits of what is off its defaults (fields/field_bits.h).
std::string drive_bits(const Drive& drive);
std::vector<std::pair<std::string, std::string>> drive_bits_by_key(const Drive& drive);
/// Applies what flags change, and notes what the user would not guess. Throws InputError for a side that no lamp has.
void apply_edits(Drive& drive, const DriveEdits& edits, LampCache& cache);
/// A file's stem, made a name that YamlEntry::name accepts.
std::string name_from(const std::filesystem::path& path);

const Fields<Route::Start>& start_fields();
const Fields<SpeedPoint>& speed_point_fields();
/// `speed_kmh`, `speed_mps` or `speed` (a list of {at_s, speed_kmh or speed_mps}, times ascending).
std::vector<SpeedPoint> read_speed(const YamlMap& drive);
/// `step_s` or `rate_hz`; 30 per second by default.
double read_step_s(const YamlMap& drive);

const Fields<StoryboardSource>& storyboard_fields();
/// `storyboard`: a file, or a map. Reads the storyboard: what it cannot play is refused here. Takes road, longest time and notes from it.
/// `edits` may add folders and make it lenient.
void read_storyboard_keys(const YamlMap& keys, const DriveEdits& edits, Drive& drive);
/// Names in the `entities` of traffic rows: each must be an entity of the storyboard and not the own car; without a storyboard `entities`
/// is refused.
void check_entities(const YamlMap& keys, const Drive& drive);

const Fields<Daylight>& daylight_fields();
std::string daylight_schema();
/// "night", "twilight", "day"; figures of the sky, sun and moon; or date, time and place.
void read_daylight(const YamlEntry& given, Drive& drive);
Daylight known_daylight(const YamlEntry& word); ///< by such a word
const Fields<Weather>& weather_fields();
const Fields<StreetLampRow>& street_lamp_fields();
std::vector<StreetLampRow> read_street_lamps(const YamlMap& drive, LampCache& cache);

const Fields<VehicleParameters>& vehicle_fields();
const Fields<ActuatorParameters>& actuator_fields();
const Fields<LevellingParameters>& levelling_fields();
const Fields<LampSet>& actuators_fields();
/// `actuators` of the lamp set's keys, else of the drive: levelling and swivel. Refused in a drive without a vehicle.
void read_actuators(const YamlMap& drive, const YamlMap* keys, LampSet& lamp_set);
/// none, static, dynamic, or a map. `own_period`: it may have a control period of its own.
std::optional<LevellingParameters> read_levelling(const YamlEntry& given, bool own_period = true);

const Fields<TrafficRow>& traffic_fields();
/// Rows of other road users, and what light of theirs is left out.
void read_traffic(const YamlMap& keys, LampCache& cache, Drive& drive);

const Fields<View>& view_fields();
/// `view_set`, a file of views, and named `views` that come after it or take the place of its own; a map where neither has one; a
/// driver's view and a map by default. `opened` gets the file.
std::vector<View> read_views(const YamlMap& drive, FilesRead& opened);

/// How a model is turned and scaled says nothing without one.
inline constexpr std::string_view needs_model = R"({"anyOf": [{"required": ["model"]}, {"allOf": [
    {"not": {"required": ["yaw_deg"]}}, {"not": {"required": ["yaw_rad"]}}, {"not": {"required": ["scale"]}}]}]})";
const Fields<PlacedModel>& body_fields(); ///< a car's body, in its frame
const Fields<RoadSurface>& road_surface_fields();
const Fields<PlacedModel>& scenery_fields();
/// Models with their places. Each file is read once; what of it is left out goes to the drive's notes.
void read_scenery(const YamlEntry& given, Drive& drive);

const Fields<ToneMapper>& tone_mapper_fields();
std::string tone_mapper_schema();
/// A kind, or a map with the keys that its kind uses.
void read_tone_mapper(const YamlEntry& given, ToneMapper& mapper);
const Fields<DisplaySettings>& display_fields();
/// A profile's file, which is opened, or a map.
void read_display(const YamlEntry& given, Drive& drive);

inline constexpr std::string_view across_words[] = {"own-centre", "oncoming-centre", "right-edge", "left-edge"}; ///< Across
const Fields<Limit>& limit_fields();
const Fields<ToleranceParameters>& tolerances_fields();
/// `measure`'s keys of seeing and glare: sensors, glare, visibility, homogeneity, places and tolerances of them.
const Fields<SeeingParameters>& seeing_fields();
/// Reads the lamp that `measure.glare.adaptation_lamp` names into Drive::adaptation_lamp, its file among what was opened. Throws InputError
/// (lamp_file.h).
void read_adaptation_lamp(Drive& drive);

} // namespace fernlicht
