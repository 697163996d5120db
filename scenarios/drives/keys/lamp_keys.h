// The keys that describe one lamp, wherever they stand: in a lamp, in its lamp set, in a change, in a row of street lamps.
#pragma once

#include "scenarios/drives/keys/lamp_sets.h"
#include "scenarios/fields/field.h"

#include <cmath>

namespace fernlicht {

/// `file`, and how it is read.
const Fields<LampFile>& lamp_file_fields();
std::string file_text(const LampFile* file); ///< its path; "" without one
inline constexpr std::string_view file_schema = R"({"type": "string", "minLength": 1})";
const Fields<LampColour>& colour_fields();
const Fields<MountedLamp>& lamp_fields();
const Fields<LampChange>& change_fields();
const Fields<Turn>& turn_fields();
/// Those of a lamp that may stand beside lamps, too, for all that do not give them: all but its place.
const Group& light_fields();
/// `temperature_k` or `spectrum` in place of a colour.
template <class Lamp> FieldOf<Lamp> temperature_form() {
    return form<Lamp>("temperature_k", FieldKind::number, range(1000.0, 25'000.0), "of its colour, instead of it");
}
template <class Lamp> FieldOf<Lamp> spectrum_form() {
    return form<Lamp>("spectrum", FieldKind::path, any(), "CSV: wavelength in nm, relative power; instead of a colour");
}
template <class Lamp, class M> FieldOf<Lamp> source_field(int id, M Lamp::*source) {
    return field("source", id, source, words({"filament", "arc", "led"}),
                 "filament by default; decides the default colour (3200 K, 4300 K) and whether the voltage counts");
}

void check_aim_angles(const YamlMap& keys);
/// Keys of an `aim`: the angles, from where its rule starts.
template <class Lamp> const Fields<Lamp>& aim_angle_fields() {
    static const Fields<Lamp> fields =
        Fields<Lamp>{
            field("pitch", 1, &Lamp::pitch_rad, degrees_within("pitch", 90.0), "upwards"),
            field("yaw", 2, &Lamp::yaw_rad, degrees_within("yaw", 180.0), "to the left"),
            field("roll", 3, &Lamp::roll_rad, degrees_within("roll", 180.0), "lifts the left side"),
            form<Lamp>("percent_down", FieldKind::number, range(-100.0, 100.0), "lowers the beam: 1 = 1 cm in 1 m",
                       [](const YamlEntry& entry, Lamp& lamp) { lamp.pitch_rad = -std::atan(entry.number(-100.0, 100.0) / 100.0); }),
        }
            .checked([](const YamlMap& keys, const Lamp&) { check_aim_angles(keys); });
    return fields;
}
template <class Lamp, class M> FieldOf<Lamp> aim_rule_field(int id, M Lamp::*rule) {
    return field("rule", id, rule, words({"as-is", "auto"}),
                 "from where the angles count: as the file has its beam, or with its cut-off, a high beam's middle, put where it belongs");
}

/// Named lamps, and changes of them, as they stand in lamp sets and in rows of traffic.
template <class Set> FieldOf<Set> lamps_field(int id) {
    return named("lamps", id, &Set::lamps, max_lamps, lamp_fields(), "by name; a plain text is the lamp's file").short_for("file");
}

template <class Set> FieldOf<Set> changes_field(int id) {
    return list("changes", id, &Set::changes, 0, max_lamp_changes, change_fields(), "of lamps, over time");
}

/// While it lives, files of lamps are written as `drive` had them read: a lamp does not know where its file came from.
class LampsAreOf {
  public:
    explicit LampsAreOf(const Drive& drive);
    ~LampsAreOf();
    LampsAreOf(const LampsAreOf&) = delete;

  private:
    const Drive* before_; ///< whose they were until then
};

/// `file` with the keys that say how it is read; nullptr where none is named. `axis`: of a Type C file that does not give it.
std::shared_ptr<const LampFile> read_lamp_keys(const YamlMap& keys, LampCache& cache, TypeCAxis axis = TypeCAxis::automatic);

/// The recipe that a text grid is read by: a file beside the YAML, or the name of a shipped one.
std::filesystem::path recipe_of(const YamlEntry& entry);

/// Lamps of the high beam are told by their names.
inline bool is_high_beam(const std::string& lamp) { return lamp.find("high") != std::string::npos; }

std::optional<SourceKind> read_source(const YamlMap& keys);
/// `temperature_k`, `spectrum` or `colour`; else by the source: halogen 3200 K, xenon 4300 K. An LED's must be given.
LampColour read_colour(const YamlMap& keys, SourceKind source, LampCache& cache, const YamlEntry& asked_by);
bool gives_colour(const YamlMap& keys);

/// Throws InputError for the text of an IES or EULUMDAT file where another kind was `expected`: "a drive".
void refuse_lamp_text(const std::string& text, const std::filesystem::path& path, const char* expected);

} // namespace fernlicht
