#include "scenarios/studies/study.h"

#include "scenarios/drives/edits/mirrored_drive.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

bool is_high_beam(const MountedLamp& lamp) { return lamp.name.find("high") != std::string::npos; }

/// "aim-1.5": what tells a cell's condition from the study's others; "" where the study has one value.
std::string part(bool several, const std::string& text) { return several ? "_" + text : std::string(); }

std::string condition_part(const Study& study, const StudyCell& cell) {
    const StudyConditions& c = study.conditions;
    return part(c.times_of_day.size() > 1, c.times_of_day[cell.time_of_day].name) +
           part(c.aim_percent.size() > 1, fmt::format("aim{:g}", c.aim_percent[cell.aim])) +
           part(c.voltage_v.size() > 1, fmt::format("{:g}V", c.voltage_v[cell.voltage])) + part(c.mirror[cell.mirror], "mirrored");
}

StudyCell named(const Study& study, StudyCell cell) {
    const StudyConditions& c = study.conditions;
    cell.name = fmt::format("{}_{}{}{}", name_from(study.drives[cell.drive]), study.lamps[cell.lamp].name,
                            part(study.techniques.size() > 1, study.techniques[cell.technique]), condition_part(study, cell));
    cell.condition = fmt::format("{}, aim {:g} %, {:g} V{}", c.times_of_day[cell.time_of_day].name, c.aim_percent[cell.aim],
                                 c.voltage_v[cell.voltage], c.mirror[cell.mirror] ? ", mirrored" : "");
    return cell;
}

DriveEdits edits_for(const Study& study, const StudyLamp& lamp, const StudyCell& cell) {
    DriveEdits edits;
    edits.lamps.emplace_back("", lamp.left); // every low beam, whatever its name
    if (lamp.right != lamp.left)
        edits.lamps.emplace_back("right", lamp.right);
    edits.technique = study.techniques[cell.technique];
    edits.resolution = study.resolution_px;
    return edits;
}

/// High beams come with the lamp set, or the drive has none.
void put_high_beams(const Study& study, const StudyLamp& lamp, Drive& drive, DriveEdits& edits) {
    if (!std::ranges::any_of(drive.variants.front().lamps, is_high_beam))
        return;
    if (lamp.high.empty())
        throw InputError({study.file, 0, 0, "lamps." + lamp.name}, "found no high beam, and " + drive.file.string() + " has some",
                         "high: a lamp file");
    edits.lamps.emplace_back("high", lamp.high);
    drive = read_drive(drive.file, edits);
}

/// What the study measures everywhere; a drive that asks for the same kind keeps its own.
void add_measures(const SeeingParameters& everywhere, SeeingParameters& own) {
    const auto add = [](const auto& from, auto& to) {
        if (!to)
            to = from;
    };
    add(everywhere.sensors, own.sensors);
    add(everywhere.glare, own.glare);
    add(everywhere.visibility, own.visibility);
    add(everywhere.homogeneity, own.homogeneity);
    add(everywhere.places, own.places);
}

/// The aim of the study is that of the cut-off; the file has its own dip already. Equal ones turn nothing, to the last bit.
double pitch_rad(const StudyLamp& lamp, double aim_percent) {
    return std::atan(aim_percent / 100.0) - std::atan(lamp.file_aim_percent / 100.0);
}

} // namespace

std::vector<StudyCell> cells_of(const Study& study) {
    const StudyConditions& c = study.conditions;
    std::vector<StudyCell> cells;
    StudyCell cell;
    for (cell.drive = 0; cell.drive < study.drives.size(); ++cell.drive)
        for (cell.technique = 0; cell.technique < study.techniques.size(); ++cell.technique)
            for (cell.time_of_day = 0; cell.time_of_day < c.times_of_day.size(); ++cell.time_of_day)
                for (cell.aim = 0; cell.aim < c.aim_percent.size(); ++cell.aim)
                    for (cell.voltage = 0; cell.voltage < c.voltage_v.size(); ++cell.voltage)
                        for (cell.mirror = 0; cell.mirror < c.mirror.size(); ++cell.mirror)
                            for (cell.lamp = 0; cell.lamp < study.lamps.size(); ++cell.lamp)
                                cells.push_back(named(study, cell));
    for (std::size_t i = 0; i < cells.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (cells[i].name == cells[k].name)
                throw InputError({study.file, 0, 0, "drives"}, "found two cells '" + cells[i].name + "'", "drive files of different names");
    return cells;
}

Drive cell_drive(const Study& study, const StudyCell& cell) {
    const StudyLamp& lamp = study.lamps[cell.lamp];
    DriveEdits edits = edits_for(study, lamp, cell);
    Drive drive = read_drive(study.drives[cell.drive], edits);
    put_high_beams(study, lamp, drive, edits);
    add_measures(study.measure, drive.seeing);
    drive.daylight = study.conditions.times_of_day[cell.time_of_day];
    if (drive.storyboard)
        drive.storyboard->own_daylight = true; // of the study: no environment of the storyboard changes it
    drive.variants.resize(1);
    Variant& variant = drive.variants.front();
    variant.name = lamp.name + condition_part(study, cell);
    const double pitch = pitch_rad(lamp, study.conditions.aim_percent[cell.aim]);
    for (MountedLamp& mounted : variant.lamps) {
        mounted.source = lamp.source;
        mounted.colour = lamp.colour;
        mounted.voltage_v = study.conditions.voltage_v[cell.voltage];
        mounted.pitch_rad += pitch;
    }
    for (LampChange& change : variant.changes)
        if (change.pitch_rad)
            *change.pitch_rad += pitch;
    if (study.conditions.mirror[cell.mirror])
        mirror_traffic(drive, lamp.mirrors);
    drive.capture.all = false;
    drive.capture.per_second = study.pictured_moments / drive.duration_s;
    // Of what the reader decided, that only one lamp set is left is the study's own doing.
    std::erase_if(drive.notes, [](const std::string& note) { return note.starts_with("every lamp set would have"); });
    return drive;
}

namespace {

constexpr int schema_version = 1;
constexpr std::size_t most_bytes = std::size_t{1} << 20, most_entries = 100;

/// What decides unless the study says otherwise: how far a target and the road are lit, how wide, how much.
const std::vector<std::string> readings_that_decide{"reach_1lx_target_own_m",      "reach_5lx_target_own_m",      "reach_1lx_road_own_m",
                                                    "width_1lx_road_all_at_20m_m", "width_1lx_road_all_at_50m_m", "area_1lx_road_all_m2"};

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

StudyLamp read_lamp(const std::string& name, const YamlEntry& entry, LampShelf& shelf) {
    StudyLamp lamp;
    lamp.name = name;
    const YamlMap keys =
        entry.map({"low", "left", "right", "high", "source", "temperature_k", "spectrum", "colour", "file_aim_percent", "mirrors"});
    read_beams(keys, lamp);
    lamp.source = read_source(keys).value_or(SourceKind::filament);
    lamp.colour = read_colour(keys, lamp.source, shelf, entry);
    lamp.file_aim_percent = keys.number_or("file_aim_percent", lamp.file_aim_percent, -10.0, 10.0);
    lamp.mirrors = keys.flag_or("mirrors", lamp.mirrors);
    return lamp;
}

std::vector<StudyLamp> read_lamps(const YamlEntry& entry, FilesRead& opened) {
    LampShelf shelf;
    std::vector<StudyLamp> lamps;
    for (const auto& [name, lamp] : entry.named(most_entries))
        lamps.push_back(read_lamp(name, lamp, shelf));
    if (lamps.empty())
        entry.refuse("no lamps", "at least one");
    opened.insert(opened.end(), shelf.opened().begin(), shelf.opened().end());
    return lamps;
}

/// Each value once: a value twice would be two cells of one name. Of a key that `may_be_one` a value may stand without its list.
template <class Value>
void read_each(const YamlEntry& entry, std::vector<Value>& values, bool may_be_one, const auto& read, std::size_t most = most_entries) {
    values.clear();
    for (const YamlEntry& one : may_be_one && !entry.is_list() ? std::vector{entry} : entry.list(1, most))
        values.push_back(read(one));
    for (auto value = values.begin(); value != values.end(); ++value)
        if (std::find(values.begin(), value, *value) != value)
            entry.refuse("a value given twice", "each value once");
}

StudyConditions read_conditions(const YamlMap& study) {
    StudyConditions conditions;
    conditions.times_of_day = {Daylight{}};
    const auto given = study.find("conditions");
    if (!given)
        return conditions;
    const YamlMap keys = given->map({"time_of_day", "aim_percent", "voltage_v", "mirror"});
    if (const auto times = keys.find("time_of_day"))
        read_each(*times, conditions.times_of_day, true, known_daylight);
    if (const auto aims = keys.find("aim_percent"))
        read_each(*aims, conditions.aim_percent, true, [](const YamlEntry& aim) { return aim.number(-10.0, 10.0); });
    if (const auto voltages = keys.find("voltage_v"))
        read_each(*voltages, conditions.voltage_v, true, [](const YamlEntry& voltage) { return voltage.number(12.0, 13.8); });
    if (const auto mirror = keys.find("mirror"))
        read_each(
            *mirror, conditions.mirror, true, [](const YamlEntry& entry) { return entry.flag(); }, 2);
    return conditions;
}

std::string lamp_name(const YamlEntry& entry, const std::vector<StudyLamp>& lamps) {
    const std::string name = entry.name();
    std::vector<std::string> known;
    for (const StudyLamp& lamp : lamps) {
        if (lamp.name == name)
            return name;
        known.push_back(lamp.name);
    }
    entry.refuse(fmt::format("no lamp '{}' in this study", name), one_of_names(name, known));
}

std::vector<StudyComparison> read_comparisons(const YamlMap& keys, const std::vector<StudyLamp>& lamps) {
    std::vector<StudyComparison> comparisons;
    const auto given = keys.find("compare");
    if (!given) { // all with the first
        for (std::size_t i = 1; i < lamps.size(); ++i)
            comparisons.push_back({lamps[i].name, lamps.front().name});
        return comparisons;
    }
    for (const YamlEntry& entry : given->list(0, most_entries)) {
        const YamlMap pair = entry.map({"new", "against"});
        comparisons.push_back({lamp_name(pair.require("new"), lamps), lamp_name(pair.require("against"), lamps)});
        if (comparisons.back().tested == comparisons.back().against)
            entry.refuse("a lamp compared with itself", "two lamps");
    }
    return comparisons;
}

StudyLimit read_limit(const YamlEntry& entry, const std::vector<StudyLamp>& lamps) {
    const YamlMap keys = entry.map({"reading", "lamp", "at_least", "at_most", "change_at_least", "change_at_most"});
    StudyLimit limit;
    limit.reading = keys.require("reading").text();
    for (const auto& [key, value] :
         {std::pair("at_least", &limit.at_least), std::pair("at_most", &limit.at_most),
          std::pair("change_at_least", &limit.change_at_least), std::pair("change_at_most", &limit.change_at_most)})
        if (const auto given = keys.find(key))
            *value = given->number(-1.0e12, 1.0e12);
    const bool is_change = limit.change_at_least || limit.change_at_most;
    if (!is_change && !limit.at_least && !limit.at_most)
        entry.refuse("a limit without a number", "at_least, at_most, change_at_least or change_at_most");
    if (is_change && (limit.at_least || limit.at_most))
        entry.refuse("a limit on a reading and on its change in one", "two limits");
    if (const auto lamp = keys.find("lamp")) {
        limit.lamp = lamp_name(*lamp, lamps);
        if (is_change)
            lamp->refuse("a lamp beside a limit on a change", "none: it holds for every comparison");
    }
    return limit;
}

void read_measuring(const YamlMap& keys, Study& study) {
    if (const auto measure = keys.find("measure"))
        study.measure = read_fields(seeing_fields(), *measure);
    study.readings = usual_readings();
    if (const auto readings = keys.find("readings"))
        read_each(*readings, study.readings, false, [](const YamlEntry& reading) { return reading.text(); });
    if (const auto limits = keys.find("limits"))
        for (const YamlEntry& entry : limits->list(0, most_entries))
            study.limits.push_back(read_limit(entry, study.lamps));
    if (const auto moments = keys.find("pictured_moments"))
        study.pictured_moments = moments->whole(1, 12);
    if (const auto resolution = keys.find("resolution_px")) {
        const std::vector<YamlEntry> sides = resolution->list(2, 2);
        study.resolution_px = {sides[0].whole(1, largest_view_px), sides[1].whole(1, largest_view_px)};
    }
    study.noise_relative = keys.number_or("lamp_noise_percent", 0.0, 0.0, 100.0) / 100.0;
}

void refuse_too_many(const Study& study, const YamlEntry& entry) {
    const StudyConditions& c = study.conditions;
    std::size_t cells = 1;
    for (const std::size_t values : {study.drives.size(), study.lamps.size(), study.techniques.size(), c.times_of_day.size(),
                                     c.aim_percent.size(), c.voltage_v.size(), c.mirror.size()})
        cells *= values; // seven factors of at most 100 each stay below 2^64
    if (cells > most_study_cells)
        entry.refuse(fmt::format("{} cells (drives x lamps x techniques x conditions)", cells),
                     fmt::format("at most {}", most_study_cells));
}

} // namespace

const std::vector<std::string>& usual_readings() { return readings_that_decide; }

Study read_study(const std::filesystem::path& path) {
    Study study;
    study.file = path;
    study.text = to_utf8(read_file(path, study.opened, most_bytes));
    const YamlValue document = parse_yaml(study.text, path);
    const YamlEntry whole(document, path, "");
    const YamlMap keys(whole, {"fernlicht_study", "name", "title", "lamps", "drives", "techniques", "conditions", "measure", "compare",
                               "readings", "limits", "pictured_moments", "resolution_px", "lamp_noise_percent"});
    if (keys.require("fernlicht_study").whole(0, 1'000'000) != schema_version)
        keys.require("fernlicht_study").refuse(fmt::format("{}, the version of the study file's schema", schema_version));
    const auto name = keys.find("name"), title = keys.find("title");
    study.name = name ? name->name() : name_from(path);
    study.title = title ? title->text() : study.name;
    study.lamps = read_lamps(keys.require("lamps"), study.opened);
    read_each(keys.require("drives"), study.drives, false, existing);
    if (const auto techniques = keys.find("techniques"))
        read_each(*techniques, study.techniques, false, [](const YamlEntry& technique) { return technique.name(); });
    study.conditions = read_conditions(keys);
    study.comparisons = read_comparisons(keys, study.lamps);
    read_measuring(keys, study);
    refuse_too_many(study, whole);
    return study;
}

} // namespace fernlicht
