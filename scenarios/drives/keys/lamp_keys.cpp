#include "scenarios/drives/keys/lamp_keys.h"

#include "scenarios/fields/read_fields.h"
#include "scenarios/lamps/eulumdat.h"
#include "scenarios/lamps/grid_recipe.h"
#include "scenarios/lamps/ies.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

namespace fernlicht {
namespace {

constexpr std::string_view colour_keys[] = {"temperature_k", "spectrum", "colour"};

thread_local const Drive* written = nullptr;

const LampSource* source_of(const LampFile& file) {
    if (written)
        for (const LampSource& source : written->lamp_sources)
            if (source.file.get() == &file)
                return &source;
    return nullptr;
}

void* options_of_file(void* file) {
    const LampSource* const source = source_of(*static_cast<const LampFile*>(file));
    return source ? const_cast<LampReadOptions*>(&source->options) : nullptr;
}

template <double (LampReadOptions::*edges)[2], int limit_deg> void read_extent(const YamlEntry& entry, LampReadOptions& options) {
    const std::vector<double> values = entry.numbers(2, 2, -limit_deg, limit_deg);
    if (values[0] >= values[1])
        entry.refuse("edges that do not ascend", "[lower, upper]");
    std::ranges::copy(values, options.*edges);
}

template <double (LampReadOptions::*edges)[2]> std::string extent_text(const LampReadOptions& options) {
    const double(&e)[2] = options.*edges;
    return e[0] == e[1] ? "" : fmt::format("[{}, {}]", e[0], e[1]);
}

template <double (LampReadOptions::*edges)[2], int limit_deg>
FieldOf<LampReadOptions> extent(std::string_view key, int id, std::string_view meaning) {
    const std::string schema = fmt::format(
        R"({{"type": "array", "minItems": 2, "maxItems": 2, "items": {{"type": "number", "minimum": -{0}, "maximum": {0}}}}})", limit_deg);
    return own(key, id, read_extent<edges, limit_deg>, extent_text<edges>, schema, meaning);
}

const Fields<LampReadOptions>& option_fields() {
    using Options = LampReadOptions;
    static const Fields<Options> fields{
        field("between_samples", 1, &Options::rule, words({"linear_cd", "log_cd"}), "how intensity runs between the table's samples"),
        field("type_c_axis", 2, &Options::type_c_axis, words({"automatic", "horizontal", "nadir"}),
              "where a Type C or EULUMDAT file points its beam"),
        section(
            "texture", 3,
            Fields<LampReadOptions>{
                field("scale_lx", 1, &LampReadOptions::texture_scale_lx, range(0.0, 1.0e6),
                      "of a pixel of value 1.0; 0: as the image says"),
                field("distance_m", 2, &LampReadOptions::texture_distance_m, range(0.1, 1000.0), "at which that is so"),
                extent<&LampReadOptions::texture_h_extent_deg, 180>("h_extent_deg", 3, "left and right edge; as the image says by default"),
                extent<&LampReadOptions::texture_v_extent_deg, 90>("v_extent_deg", 4, "lower and upper edge"),
            },
            "only for beam textures without metadata"),
        field("mirrored", 4, &Options::mirrored, any(), "left and right exchanged: a lamp for the other side of the road")
            .written_off_default(),
        field("recipe", 5, &Options::recipe, any(),
              "how a text grid is laid out, as a goniometer exports it: a file, or the name of a shipped recipe; docs/lamps.md")
            .read_by([](const YamlEntry& entry, Options& options) { options.recipe = recipe_of(entry); })
            .written_off_default(),
    };
    return fields;
}

void check_lamp_aim(const YamlMap& keys, const MountedLamp& lamp) {
    check_aim_angles(keys);
    if (const auto percent = keys.find("cut_off_percent"); percent && lamp.aim_rule != BeamAim::automatic)
        percent->refuse("cut_off_percent without rule: auto", "rule: auto beside it, which finds the cut-off");
}

void read_cut_off(const YamlEntry& entry, MountedLamp& lamp) {
    lamp.cut_off_percent = entry.number(-HUGE_VAL, HUGE_VAL);
    if (!(lamp.cut_off_percent >= lowest_cut_off_percent && lamp.cut_off_percent <= highest_cut_off_percent))
        entry.refuse(fmt::format("a number from {} to {}: a low beam's cut-off lies below the horizon, and -1 is 1 cm down in 1 m",
                                 lowest_cut_off_percent, highest_cut_off_percent));
}

/// Of an aim that starts from the file's axis nothing is written but its angles.
std::string cut_off_text(const MountedLamp& lamp) {
    return lamp.aim_rule == BeamAim::automatic ? fmt::format("{}", lamp.cut_off_percent) : "";
}

const Fields<MountedLamp>& lamp_aim_fields() {
    using Lamp = MountedLamp;
    static const Fields<Lamp> fields = [] {
        Fields<Lamp> of = aim_angle_fields<Lamp>();
        of.fields.push_back(aim_rule_field(4, &Lamp::aim_rule).written_off_default());
        of.fields.push_back(field("cut_off_percent", 5, &Lamp::cut_off_percent, range(lowest_cut_off_percent, highest_cut_off_percent),
                                  "where rule auto puts it: -1, the default, is 1 cm down in 1 m; a high beam then points straight ahead")
                                .read_by(read_cut_off)
                                .text_by(cut_off_text));
        std::rotate(of.fields.begin(), of.fields.end() - 2, of.fields.end());
        return std::move(of)
            .checked(check_lamp_aim)
            .in_schema(
                R"({"anyOf": [{"not": {"required": ["cut_off_percent"]}}, {"required": ["rule"], "properties": {"rule": {"enum": ["auto"]}}}]})");
    }();
    return fields;
}

bool is_turned(const void* lamp) { return static_cast<const MountedLamp*>(lamp)->mount != Turn{}; }

} // namespace

std::string file_text(const LampFile* file) {
    if (!written || !file)
        return "";
    if (const LampSource* const source = source_of(*file))
        return quoted(source->path.string());
    if (file->opened.empty()) // at its defaults, never read
        return "";
    throw std::invalid_argument("write_drive: a lamp's file is not among the drive's lamp_sources");
}

const Fields<LampFile>& lamp_file_fields() {
    static const Fields<LampFile> fields = [] {
        static const std::string meaning = lamp_format_list() + "; relative to the drive file";
        static constexpr MemberType options{.look = options_of_file};
        return Fields<LampFile>{
            own<LampFile>(
                "file", 1, nullptr, [](const LampFile& file) { return file_text(&file); }, file_schema, meaning),
            FieldOf<LampFile>("", 2, FieldKind::inlined, {0, &options}, "").of(option_fields()),
        };
    }();
    return fields;
}

const Fields<LampColour>& colour_fields() {
    static const Fields<LampColour> fields{
        field("linear_srgb", 1, &LampColour::linear_srgb, range(-100.0, 100.0), "of luminance 1").required(),
        field("sp_ratio", 2, &LampColour::sp_ratio, range(0.0, 100.0), "scotopic over photopic").required(),
        field("cct_k", 3, &LampColour::cct_k, range(0.0, 1.0e6), "its temperature, for people"),
    };
    return fields;
}

const Fields<Turn>& turn_fields() {
    static const Fields<Turn> fields{
        field("yaw", 1, &Turn::yaw_rad, degrees_within("yaw", 360.0), "to the left"),
        field("pitch", 2, &Turn::pitch_rad, degrees_within("pitch", 90.0), "upwards"),
        field("roll", 3, &Turn::roll_rad, degrees_within("roll", 360.0), "lifts the left side"),
    };
    return fields;
}

const Fields<MountedLamp>& lamp_fields() {
    using Lamp = MountedLamp;
    static const Fields<Lamp> fields =
        Fields<Lamp>{
            inlined(1, &Lamp::file, lamp_file_fields()),
            form<Lamp>("mount", FieldKind::name, a_name(), "a place of car.mounts; the lamp's own name by default"),
            field("position_m", 2, &Lamp::position_m, range(-100.0, 100.0),
                  "x forward, y left, z up from the road under the rear axle, instead of a mount"),
            field("mount_turn", 3, &Lamp::mount, turn_fields(), "how the place is turned, beside position_m").heard_if(is_turned),
            section("aim", 4, lamp_aim_fields(), "how the beam is turned").short_for("rule"),
            field("level", 5, &Lamp::level, range(0.0, 1.0), "dimming, 1 = full"),
            source_field(6, &Lamp::source),
            field("voltage_v", 7, &Lamp::voltage_v, range(12.0, 13.8), "supply"),
            field("reference_voltage_v", 8, &Lamp::reference_voltage_v, range(12.0, 13.8),
                  "at which the file was measured (UN 13.2, FMVSS 108 12.8); taken as 13.2 where it is not stated"),
            field("function", 12, &Lamp::function, words({"low", "high", "other"}),
                  "what the beam is for, for the check of its file; recognised from the table where it is not stated")
                .bits_by([](const Lamp&) { return std::string(); }), // it decides no result
            temperature_form<Lamp>(),
            spectrum_form<Lamp>(),
            field("colour", 9, &Lamp::colour, colour_fields(), "what a spectrum comes to"),
            field("photometric_distance_m", 10, &Lamp::photometric_distance_m, range(0.0, 1000.0),
                  "results nearer than this are marked near-field"),
            field("flux_factor", 11, &Lamp::flux_factor, range(0.001, 1000.0), "light of this very lamp against its file's, as measured")
                .written_off_default(),
            field("levels", 13, &Lamp::levels_file, any(), "of a pixel lamp: a CSV of its pixels' levels over time; docs/pixel-lamps.md")
                .written_off_default(),
        }
            .block()
            .defined_as("lamp");
    return fields;
}

const Group& light_fields() {
    static const Group fields = [] {
        Group of = lamp_fields();
        of.definition = {};
        std::erase_if(of.fields, [](const Field& field) {
            return field.key.starts_with("mount") || field.key == "position_m" || field.key == "levels";
        });
        return of;
    }();
    return fields;
}

const Fields<LampChange>& change_fields() {
    using Change = LampChange;
    static const Fields<Change> fields =
        Fields<Change>{
            field("at_s", 1, &Change::time_s, range(0.0, 1.0e6), "what is not given stays as it was").required(),
            field("lamp", 2, &Change::lamp, a_name(), "whose; without it and `lamps` all of them"),
            form<Change>("lamps", FieldKind::names, names(1, max_lamps), "several of them"),
            field("level", 3, &Change::level, range(0.0, 1.0), "dimming, 1 = full"),
            section("aim", 4, aim_angle_fields<Change>(), "how the beam is turned, as the lamp's aim").written_off_default(),
            inlined(5, &Change::file, lamp_file_fields()),
            source_field(6, &Change::source),
            temperature_form<Change>(),
            spectrum_form<Change>(),
            field("colour", 7, &Change::colour, colour_fields(), "what a spectrum comes to"),
        }
            .block()
            .defined_as("change")
            .in_schema(R"({"not": {"required": ["lamp", "lamps"]}})");
    return fields;
}

void check_aim_angles(const YamlMap& keys) {
    if (const auto percent = keys.find("percent_down"); percent && (keys.find("pitch_deg") || keys.find("pitch_rad")))
        percent->refuse("percent_down beside a pitch", "one of them");
}

LampsAreOf::LampsAreOf(const Drive& drive) : before_(std::exchange(written, &drive)) {}
LampsAreOf::~LampsAreOf() { written = before_; }

std::shared_ptr<const LampFile> read_lamp_keys(const YamlMap& keys, LampCache& cache, TypeCAxis axis) {
    const auto file = keys.find("file");
    if (!file)
        return nullptr;
    LampReadOptions options;
    options.type_c_axis = axis;
    read_group(option_fields(), keys, &options);
    const LampReadOptions usual{.type_c_axis = axis};
    std::shared_ptr<const LampFile> lamp = cache.lamp(file->path(), options, &*file);
    // What stands in written drives is at its defaults.
    const auto refuse = [&](const char* key) {
        keys.require(key).refuse(fmt::format("{} of a pixel lamp", key), "none: its parts are read as their files say");
    };
    if (lamp->pixels && options.type_c_axis != axis)
        refuse("type_c_axis");
    LampReadOptions without = options;
    without.texture_scale_lx = usual.texture_scale_lx;
    without.texture_distance_m = usual.texture_distance_m;
    std::ranges::copy(usual.texture_h_extent_deg, without.texture_h_extent_deg);
    std::ranges::copy(usual.texture_v_extent_deg, without.texture_v_extent_deg);
    if (lamp->pixels && without != options)
        refuse("texture");
    return lamp;
}

std::filesystem::path recipe_of(const YamlEntry& entry) {
    return recipe_file(entry.text(), entry.file().parent_path(),
                       {entry.file(), entry.value().line, entry.value().column, entry.key_path()});
}

std::optional<SourceKind> read_source(const YamlMap& keys) {
    LampChange change;
    read_field(change_fields(), "source", keys, &change);
    return change.source;
}

bool gives_colour(const YamlMap& keys) {
    return std::ranges::any_of(colour_keys, [&](std::string_view key) { return keys.find(key).has_value(); });
}

LampColour read_colour(const YamlMap& keys, SourceKind source, LampCache& cache, const YamlEntry& asked_by) {
    if (const auto given = keys.one_of({colour_keys[0], colour_keys[1], colour_keys[2]})) {
        if (given->first == "temperature_k")
            return colour_of_temperature(given->second.number(1000.0, 25'000.0));
        return given->first == "spectrum" ? cache.spectrum(given->second.path(), given->second)
                                          : read_fields(colour_fields(), given->second);
    }
    if (source == SourceKind::led)
        asked_by.refuse("an LED without a colour", "temperature_k or spectrum");
    return colour_of_temperature(source == SourceKind::arc ? 4300.0 : 3200.0);
}

void refuse_lamp_text(const std::string& text, const std::filesystem::path& path, const char* expected) {
    if (looks_like_ies(text) || looks_like_eulumdat(text))
        throw InputError({path, 0, 0, {}}, "is a lamp",
                         fmt::format("{} that names it; `fernlicht new drive` and `new study` write one with comments, `fernlicht lamp` "
                                     "tells of a lamp by itself",
                                     expected));
}

} // namespace fernlicht
