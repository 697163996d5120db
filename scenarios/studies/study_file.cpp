#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/drives/keys/seeing_keys.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
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
    const Layers layers{keys};
    lamp.source = read_source(layers).value_or(SourceKind::filament);
    lamp.colour = read_colour(layers, lamp.source, shelf, entry);
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

/// Each value once: a value twice would be two cells of one name.
template <class Value> void refuse_repeats(const std::vector<Value>& values, const YamlEntry& entry) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::find(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values[i]) !=
            values.begin() + static_cast<std::ptrdiff_t>(i))
            entry.refuse("a value given twice", "each value once");
}

std::vector<double> read_values(const YamlMap& keys, std::string_view key, std::vector<double> otherwise, double least, double greatest) {
    const auto given = keys.find(key);
    if (!given)
        return otherwise;
    std::vector<double> values;
    for (const YamlEntry& entry : given->is_list() ? given->list(1, most_entries) : std::vector{*given})
        values.push_back(entry.number(least, greatest));
    refuse_repeats(values, *given);
    return values;
}

void read_times_of_day(const YamlMap& keys, StudyConditions& conditions) {
    static const Daylight known[] = {{"night", 0.0}, {"twilight", 3.4}, {"day", 27000.0}}; // as a drive's `daylight`
    const auto given = keys.find("time_of_day");
    if (!given) {
        conditions.times_of_day = {known[0]};
        return;
    }
    for (const YamlEntry& entry : given->is_list() ? given->list(1, most_entries) : std::vector{*given})
        conditions.times_of_day.push_back(known[entry.choice({"night", "twilight", "day"})]);
    refuse_repeats(conditions.times_of_day, *given);
}

StudyConditions read_conditions(const YamlMap& study) {
    StudyConditions conditions;
    const auto given = study.find("conditions");
    if (!given) {
        conditions.times_of_day = {Daylight{}};
        return conditions;
    }
    const YamlMap keys = given->map({"time_of_day", "aim_percent", "voltage_v", "mirror"});
    read_times_of_day(keys, conditions);
    conditions.aim_percent = read_values(keys, "aim_percent", conditions.aim_percent, -10.0, 10.0);
    conditions.voltage_v = read_values(keys, "voltage_v", conditions.voltage_v, 12.0, 13.8);
    if (const auto mirror = keys.find("mirror")) {
        conditions.mirror.clear();
        for (const YamlEntry& entry : mirror->is_list() ? mirror->list(1, 2) : std::vector{*mirror})
            conditions.mirror.push_back(entry.flag());
        refuse_repeats(conditions.mirror, *mirror);
    }
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
    const std::string near = nearest_name(name, known);
    entry.refuse(fmt::format("no lamp '{}' in this study", name),
                 fmt::format("one of {}{}", fmt::join(known, ", "), near.empty() ? "" : fmt::format(" (nearest: '{}')", near)));
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
    const auto number = [&](std::string_view key, std::optional<double>& value) {
        if (const auto given = keys.find(key))
            value = given->number(-1.0e12, 1.0e12);
    };
    number("at_least", limit.at_least);
    number("at_most", limit.at_most);
    number("change_at_least", limit.change_at_least);
    number("change_at_most", limit.change_at_most);
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
        study.measure = read_seeing(*measure);
    study.readings = usual_readings();
    if (const auto readings = keys.find("readings")) {
        study.readings.clear();
        for (const YamlEntry& entry : readings->list(1, most_entries))
            study.readings.push_back(entry.text());
        refuse_repeats(study.readings, *readings);
    }
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
    const YamlEntry drives = keys.require("drives");
    for (const YamlEntry& entry : drives.list(1, most_entries))
        study.drives.push_back(existing(entry));
    refuse_repeats(study.drives, drives);
    if (const auto techniques = keys.find("techniques")) {
        study.techniques.clear();
        for (const YamlEntry& entry : techniques->list(1, most_entries))
            study.techniques.push_back(entry.name());
        refuse_repeats(study.techniques, *techniques);
    }
    study.conditions = read_conditions(keys);
    study.comparisons = read_comparisons(keys, study.lamps);
    read_measuring(keys, study);
    refuse_too_many(study, whole);
    return study;
}

} // namespace fernlicht
