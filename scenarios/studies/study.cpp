#include "scenarios/studies/study.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/key_path.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/studies/axes_on_drive.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"
#include "scenarios/values/refusals.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <string_view>

namespace fernlicht {
namespace {

constexpr int schema_version = 1;
constexpr std::size_t max_bytes = std::size_t{1} << 20, max_entries = 100;

std::filesystem::path existing(const YamlEntry& entry) {
    check_file(entry.path(), entry);
    return entry.path();
}

void read_beams(const YamlMap& keys, StudyLamp& lamp) {
    const auto low = keys.find("low"), left = keys.find("left"), right = keys.find("right");
    if (low && (left || right))
        low->refuse("low beside left or right", "low, or left and right");
    if (!low && !(left && right))
        keys.refuse_missing(left ? "right" : "low", "low, or left and right");
    lamp.left = existing(low ? *low : *left);
    lamp.right = existing(low ? *low : *right);
    if (const auto high = keys.find("high"))
        lamp.high = existing(*high);
}

/// Where the cut-off is to lie is the condition's affair.
const Fields<StudyLamp>& study_lamp_aim_fields() {
    static const Fields<StudyLamp> fields = [] {
        Fields<StudyLamp> of = aim_angle_fields<StudyLamp>();
        of.fields.insert(of.fields.begin(), aim_rule_field(4, &StudyLamp::aim));
        return of;
    }();
    return fields;
}

const Fields<StudyLamp>& study_lamp_fields() {
    using Lamp = StudyLamp;
    static const Fields<Lamp> fields =
        Fields<Lamp>{
            form<Lamp>("low", FieldKind::path, any(), "lamp file of both low beams"),
            form<Lamp>("left", FieldKind::path, any(), "of the left one"),
            form<Lamp>("right", FieldKind::path, any(), "of the right one"),
            form<Lamp>("high", FieldKind::path, any(), "of both high beams, for drives that have some"),
            source_field(1, &Lamp::source),
            temperature_form<Lamp>(),
            spectrum_form<Lamp>(),
            field("colour", 2, &Lamp::colour, colour_fields(), "what a spectrum comes to"),
            section("aim", 5, study_lamp_aim_fields(), "how its beams are turned; the drives' lamps' own by default").short_for("rule"),
            field("file_aim_percent", 3, &Lamp::file_aim_percent, range(-10.0, 10.0),
                  "the dip that the lamp's file already holds; not beside rule auto, which finds it"),
            field("mirrors", 4, &Lamp::mirrors, any(), "false: its tables stay as they are where the condition mirrors"),
            field("recipe", 10, &Lamp::recipe, any(), "how those of its files that are text grids are laid out, as in a drive")
                .read_by([](const YamlEntry& given, Lamp& lamp) { lamp.recipe = recipe_of(given); }),
            field("reference_voltage_v", 8, &Lamp::reference_voltage_v, range(12.0, 13.8),
                  "at which its files were measured (UN 13.2, FMVSS 108 12.8); taken as 13.2 where it is not stated"),
            field("function", 9, &Lamp::function, words({"low", "high", "other"}),
                  "what `low`, or `left` and `right` are for, for the check of the files; recognised where it is not stated"),
        }
            .in_schema(R"({"oneOf": [{"required": ["left", "right"], "not": {"required": ["low"]}},
                {"required": ["low"], "not": {"anyOf": [{"required": ["left"]}, {"required": ["right"]}]}}],
                "not": {"required": ["aim", "file_aim_percent"], "properties": {"aim": {"anyOf": [{"enum": ["auto"]},
                {"type": "object", "required": ["rule"], "properties": {"rule": {"enum": ["auto"]}}}]}}}})");
    return fields;
}

void read_study_lamps(const YamlEntry& entry, Study& study) {
    LampCache cache;
    EachRead each;
    const auto read = [&](const std::string& name, const YamlEntry& given) {
        StudyLamp& lamp = study.lamps.emplace_back();
        lamp.name = name;
        const YamlMap keys = given.map(keys_of(study_lamp_fields()));
        EachRead part;
        part([&] { read_beams(keys, lamp); });
        part([&] {
            lamp.source = read_source(keys).value_or(SourceKind::filament);
            lamp.colour = read_colour(keys, lamp.source, cache, given);
        });
        for (const char* const key : {"aim", "file_aim_percent", "mirrors", "recipe", "reference_voltage_v", "function"})
            part([&] { read_field(study_lamp_fields(), key, keys, &lamp); });
        part.end();
        const YamlValue& place = keys.find("aim") ? keys.find("aim")->value() : given.value();
        lamp.line = place.line;
        lamp.column = place.column;
        if (const auto dip = keys.find("file_aim_percent"); dip && lamp.aim == BeamAim::automatic)
            dip->refuse("file_aim_percent beside aim: auto", "one of them: auto finds the cut-off in the file");
    };
    for (const auto& [name, given] : entry.named(max_entries))
        each([&, &name = name, &given = given] { read(name, given); });
    each.end();
    study.opened.insert(study.opened.end(), cache.opened().begin(), cache.opened().end());
}

/// Each value once: a value twice would be two cells of one name. Where it `may_be_one`, a value may stand without its list.
template <class Struct, class Value>
FieldOf<Struct> values_form(std::string_view key, std::vector<Value> Struct::*values, Value (*read)(const YamlEntry&), bool may_be_one,
                            std::string_view schema_of_one, std::string_view meaning, std::size_t most = max_entries) {
    FieldOf<Struct> made = form<Struct>(key, FieldKind::own, {}, meaning);
    made.read = [=](const YamlEntry& entry, void* whole) {
        std::vector<Value>& all = static_cast<Struct*>(whole)->*values;
        all.clear();
        EachRead each;
        for (const YamlEntry& one : may_be_one && !entry.is_list() ? std::vector{entry} : entry.list(1, most))
            each([&] { all.push_back(read(one)); });
        each.end();
        for (auto value = all.begin(); value != all.end(); ++value)
            if (const auto first = std::find(all.begin(), value, *value); first != value)
                entry.refuse(fmt::format("value {} again, the same as value {}", value - all.begin() + 1, first - all.begin() + 1),
                             "each value once");
    };
    made.schema = fmt::format(R"({{"type": "array", "items": {}, "minItems": 1, "maxItems": {}}})", schema_of_one, most);
    if (may_be_one)
        made.schema = fmt::format(R"({{"anyOf": [{}, {}]}})", schema_of_one, made.schema);
    return made;
}

double aim_percent(const YamlEntry& entry) { return entry.number(-10.0, 10.0); }
double voltage_v(const YamlEntry& entry) { return entry.number(12.0, 13.8); }
bool is_mirrored(const YamlEntry& entry) { return entry.flag(); }
std::string technique_name(const YamlEntry& entry) { return entry.name(); }
std::string name_or_pattern(const YamlEntry& entry) { return entry.text(); }

const Fields<StudyConditions>& condition_fields() {
    using Conditions = StudyConditions;
    static const Fields<Conditions> fields{
        values_form("time_of_day", &Conditions::times_of_day, known_daylight, true, R"({"enum": ["night", "twilight", "day"]})",
                    "as a drive's daylight; night by default"),
        values_form("aim_percent", &Conditions::aim_percent, aim_percent, true, R"({"type": "number", "minimum": -10, "maximum": 10})",
                    "of the cut-off: -1, the default, is 1 cm down in 1 m; by aim: auto from the horizon, else on top of file_aim_percent"),
        values_form("voltage_v", &Conditions::voltage_v, voltage_v, true, R"({"type": "number", "minimum": 12, "maximum": 13.8})",
                    "supply; 13.2 by default"),
        values_form("mirror", &Conditions::mirror, is_mirrored, true, R"({"type": "boolean"})",
                    "true: roads, drives and lamps in a mirror; left-hand traffic on our roads", 2),
    };
    return fields;
}

std::string lamp_name(const YamlEntry& entry, const std::vector<StudyLamp>& lamps) {
    std::string name = entry.name();
    std::vector<std::string> known;
    for (const StudyLamp& lamp : lamps) {
        if (lamp.name == name)
            return name;
        known.push_back(lamp.name);
    }
    entry.refuse(fmt::format("no lamp '{}' in this study", name), one_of_names(name, known));
}

const Fields<StudyComparison>& comparison_fields() {
    static const Fields<StudyComparison> fields{
        field("new", 1, &StudyComparison::tested, any(), "a lamp of the study").required(),
        field("against", 2, &StudyComparison::against, any(), "another").required(),
    };
    return fields;
}

void read_comparisons(const YamlEntry& given, Study& study) {
    EachRead each;
    for (const YamlEntry& entry : given.list(0, max_entries))
        each([&] {
            const YamlMap pair = entry.map(keys_of(comparison_fields()));
            study.comparisons.push_back({lamp_name(pair.require("new"), study.lamps), lamp_name(pair.require("against"), study.lamps)});
            if (study.comparisons.back().tested == study.comparisons.back().against)
                entry.refuse("a lamp compared with itself", "two lamps");
        });
    each.end();
}

const Fields<StudyLimit>& study_limit_fields() {
    using Limits = StudyLimit;
    const FieldRule numbers = range(-1.0e12, 1.0e12);
    static const Fields<Limits> fields{
        field("reading", 1, &Limits::reading, any(), "its name").required(),
        field("lamp", 2, &Limits::lamp, any(), "of which lamp; of every lamp by default"),
        field("at_least", 3, &Limits::at_least, numbers, "in the reading's unit"),
        field("at_most", 4, &Limits::at_most, numbers, "in the reading's unit"),
        field("change_at_least", 5, &Limits::change_at_least, numbers, "of every comparison"),
        field("change_at_most", 6, &Limits::change_at_most, numbers, "of every comparison"),
    };
    return fields;
}

void read_study_limits(const YamlEntry& given, Study& study) {
    EachRead each;
    const auto read = [&](const YamlEntry& entry) {
        const YamlMap keys = entry.map(keys_of(study_limit_fields()));
        StudyLimit& limit = study.limits.emplace_back();
        limit.line = entry.value().line;
        for (const char* const key : {"reading", "at_least", "at_most", "change_at_least", "change_at_most"})
            read_field(study_limit_fields(), key, keys, &limit);
        const bool is_change = limit.change_at_least || limit.change_at_most;
        if (!is_change && !limit.at_least && !limit.at_most)
            entry.refuse("a limit without a number", "at_least, at_most, change_at_least or change_at_most");
        if (is_change && (limit.at_least || limit.at_most))
            entry.refuse("a limit on a reading and on its change in one", "two limits");
        if (const auto lamp = keys.find("lamp")) {
            limit.lamp = lamp_name(*lamp, study.lamps);
            if (is_change)
                lamp->refuse("a lamp beside a limit on a change", "none: it holds for every comparison");
        }
    };
    for (const YamlEntry& entry : given.list(0, max_entries))
        each([&] { read(entry); });
    each.end();
}

void read_study_resolution(const YamlEntry& entry, Study& study) {
    const std::vector<YamlEntry> sides = entry.list(2, 2);
    study.resolution_px = {sides[0].whole(1, largest_view_px), sides[1].whole(1, largest_view_px)};
}

void refuse_too_many(const Study& study, const YamlEntry& entry) {
    const StudyConditions& c = study.conditions;
    std::size_t cells = 1;
    for (const std::size_t values : {study.drives.size(), study.lamps.size(), study.techniques.size(), c.times_of_day.size(),
                                     c.aim_percent.size(), c.voltage_v.size(), c.mirror.size()})
        cells *= values; // seven factors of at most 100 each stay below 2^64
    const std::size_t points = number_of_points(study.axes, study.sample);
    if (points > max_study_cells || cells > max_study_cells || cells * points > max_study_cells)
        entry.refuse(fmt::format("{} cells (drives x lamps x techniques x conditions{})",
                                 points > max_study_cells ? fmt::format("{} x {}", cells, points) : fmt::format("{}", cells * points),
                                 study.axes.empty() ? "" : " x points of axes"),
                     fmt::format("at most {}", max_study_cells));
}

} // namespace

const std::vector<std::string>& decides_by_default() {
    static const std::vector<std::string> readings{
        "reach_5lx_target_own_right_edge_m",
        "reach_5lx_target_own_m",
        "reach_5lx_target_own_left_edge_m",
        "reach_3lx_target_own_m",
        "reach_1lx_target_own_m",
        "glare_*_facing_from_30_to_60m_max_lx",
        "glare_*_facing_from_60_to_120m_max_lx",
        "glare_mirrors_at_*_facing_max_lx",
        "detection_card_own_m",
        "detection_pedestrian-light_right_m",
        "detection_pedestrian-light_left_m",
        "width_3lx_target_all_at_20m_m",
        "width_3lx_target_all_at_50m_m",
        "uniformity_target_own_at_20m",
        "uniformity_target_own_at_50m",
    };
    return readings;
}

const Fields<Study>& study_fields() {
    constexpr std::string_view text = R"({"type": "string"})";
    static const Fields<Study> fields{
        form<Study>("fernlicht_study", FieldKind::own, {}, "version of this schema").schema_by(R"({"const": 1})").required(),
        field("name", 1, &Study::name, a_name(), "of the study; the file's by default"),
        field("title", 2, &Study::title, any(), "for people; the name by default"),
        named("lamps", 3, &Study::lamps, max_entries, study_lamp_fields(), "lamp sets under comparison")
            .read_by(read_study_lamps)
            .required(),
        values_form("drives", &Study::drives, existing, false, text, "drive files; relative to the study file").required(),
        values_form("techniques", &Study::techniques, technique_name, false, text, "how the drives are rendered; photometric by default"),
        field("conditions", 4, &Study::conditions, condition_fields(), "every combination is played"),
        form<Study>("axes", FieldKind::own, {},
                    "any key of the drives, or mounts, aim, load and speed of the car, over values; each point is a condition", read_axes)
            .schema_by(axes_schema()),
        form<Study>("sample", FieldKind::own, {}, "points of the axes: grid (default), one_at_a_time, or {low_discrepancy: N, seed: 0}",
                    read_sample)
            .schema_by(sample_schema()),
        form<Study>("compare", FieldKind::list, names(0, max_entries), "all with the first by default", read_comparisons)
            .of(comparison_fields()),
        field("measure", 5, &Study::measure, seeing_fields(), "in every drive that does not ask itself"),
        values_form("decide", &Study::decide, name_or_pattern, false, text,
                    "readings that decide, by name or pattern, the most important first"),
        list("limits", 6, &Study::limits, 0, max_entries, study_limit_fields(), "beyond these the study fails").read_by(read_study_limits),
        field("pictured_moments", 7, &Study::pictured_moments, range(1.0, 12.0), "stored moments of each cell"),
        form<Study>("resolution_px", FieldKind::own, {}, "width, height of the cameras' views; the drives' own by default",
                    read_study_resolution)
            .schema_by(R"({"type": "array", "minItems": 2, "maxItems": 2,
                "items": {"type": "integer", "minimum": 1, "maximum": 16384}})"),
        values_form("timed_cells", &Study::timed_cells, name_or_pattern, false, text,
                    "with --history: cells, by name or pattern, that are also played by themselves for their times"),
        field("resources", 8, &Study::resources, study_resources_fields(), "what each cell may take of the machine that plays it"),
        form<Study>("lamp_noise_percent", FieldKind::number, range(0.0, 100.0), "standard deviation of the lamps' intensities",
                    [](const YamlEntry& entry, Study& study) { study.noise_relative = entry.number(0.0, 100.0) / 100.0; }),
    };
    return fields;
}

namespace {

void refuse_unknown_cells(const Study& study, const YamlEntry& patterns) {
    const std::vector<StudyCell> cells = cells_of(study);
    for (const YamlEntry& pattern : patterns.list(1, max_entries))
        if (std::ranges::none_of(cells, [&](const StudyCell& cell) { return matches(pattern.text(), cell.name); }))
            pattern.refuse("found '" + printable(pattern.text()) + "', which fits no cell",
                           "a name or a pattern of cells; --list names them");
}

} // namespace

Study read_study(const std::filesystem::path& path) {
    Study study;
    study.file = path;
    study.text = to_utf8(read_file(path, study.opened, max_bytes));
    refuse_lamp_text(study.text, path, "a study");
    const YamlValue document = parse_yaml(study.text, path);
    const auto has = [&](const char* key) { return std::ranges::find(document.members, key, &YamlMember::key) != document.members.end(); };
    if (has("fernlicht") && !has("fernlicht_study"))
        throw InputError({path, 0, 0, {}}, "is a drive", "a study; `fernlicht run` plays drives");
    const YamlEntry whole(document, path, "");
    const YamlMap keys(whole, keys_of(study_fields()));
    if (keys.require("fernlicht_study").whole(0, 1'000'000) != schema_version)
        keys.require("fernlicht_study").refuse(fmt::format("{}, the version of the study file's schema", schema_version));
    study.name = name_from(path);
    study.conditions.times_of_day = {Daylight{}};
    study.decide = decides_by_default();
    read_group(study_fields(), keys, &study);
    if (study.title.empty())
        study.title = study.name;
    for (std::size_t i = 1; i < study.lamps.size() && !keys.find("compare"); ++i) // all with the first
        study.comparisons.push_back({study.lamps[i].name, study.lamps.front().name});
    check_axes(whole, study);
    refuse_too_many(study, whole);
    study.points = points_of(study.axes, study.sample);
    if (is_daylight_an_axis(study.axes))
        study.conditions.times_of_day.front().name = "daylight by axis";
    if (const std::optional<YamlEntry> timed = keys.find("timed_cells"))
        refuse_unknown_cells(study, *timed);
    return study;
}

} // namespace fernlicht
