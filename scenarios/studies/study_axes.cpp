#include "scenarios/studies/study_axes.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/key_path.h"
#include "scenarios/studies/axes_on_drive.h"
#include "scenarios/studies/sobol.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"
#include "scenarios/yaml/yaml_entry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <string_view>

namespace fernlicht {
namespace {

constexpr double largest_number = 1.0e12;

/// As short as twelve digits say it: 0.6, not 0.6000000000000001.
std::string number_text(double value) {
    double rounded = value;
    const std::string digits = fmt::format("{:.12g}", value);
    std::from_chars(digits.data(), digits.data() + digits.size(), rounded);
    return fmt::format("{}", rounded == 0.0 ? 0.0 : rounded);
}

std::string flow_yaml(const YamlValue& value) {
    std::vector<std::string> parts;
    switch (value.kind) {
    case YamlValue::Kind::null:
        return "null";
    case YamlValue::Kind::scalar:
        return value.quoted || value.text.find_first_of(",[]{}#:\n") != std::string::npos ? quoted(value.text) : value.text;
    case YamlValue::Kind::list:
        for (const YamlValue& item : value.items)
            parts.push_back(flow_yaml(item));
        return fmt::format("[{}]", fmt::join(parts, ", "));
    case YamlValue::Kind::map:
        for (const YamlMember& member : value.members)
            parts.push_back(fmt::format("{}: {}", quoted(member.key), flow_yaml(member.value)));
        return fmt::format("{{{}}}", fmt::join(parts, ", "));
    }
    return "";
}

/// "a drive's key, or one of mount_height_m, ...".
std::string expected_key(const std::string& key) {
    const std::vector<std::string> names = drive_axis_names();
    if (const std::string near = nearest_name(key, names); !near.empty() && key.find('.') == std::string::npos)
        return fmt::format("'{}', or a key of a drive", near);
    return fmt::format("{}; or one of {}", unknown_in_path(drive_fields(), key), fmt::join(names, ", "));
}

std::string key_of_axis(const YamlEntry& at, const std::string& key) {
    if (!drive_axis_named(key) && !unknown_in_path(drive_fields(), key).empty())
        at.refuse(fmt::format("'{}', which no drive has", printable(key, 200)), expected_key(key));
    return key;
}

/// A value of one of the named axes is a number in its limits; what a key of a drive may be, its reader says.
std::string value_of_axis(const StudyAxis& axis, const YamlEntry& entry) {
    if (const auto named = drive_axis_named(axis.key)) {
        const auto [least, greatest] = limits_of(*named);
        return number_text(entry.number(least, greatest));
    }
    if (entry.value().kind == YamlValue::Kind::null)
        entry.refuse("a value");
    return flow_yaml(entry.value());
}

void read_values(const YamlEntry& list, StudyAxis& axis) {
    for (const YamlEntry& entry : list.list(1, max_axis_values))
        axis.values.push_back(value_of_axis(axis, entry));
    std::vector<std::string> sorted = axis.values;
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
        list.refuse(fmt::format("the value {} given twice", *twice), "each value once");
}

double end_of_range(const StudyAxis& axis, const YamlEntry& entry) {
    const auto named = drive_axis_named(axis.key);
    const auto [least, greatest] = named ? limits_of(*named) : std::pair(-largest_number, largest_number);
    return entry.number(least, greatest);
}

void read_range(const YamlMap& keys, StudyAxis& axis) {
    const double from = end_of_range(axis, keys.require("from")), to = end_of_range(axis, keys.require("to"));
    if (!(from < to))
        keys.require("to").refuse(fmt::format("to {} and from {}", to, from), "a range that goes up");
    const auto count = keys.find("count"), step = keys.find("step");
    if (count && step)
        step->refuse("step beside count", "one of them");
    axis.range = {from, to};
    if (count) {
        const int n = count->whole(2, static_cast<int>(max_axis_values));
        for (int i = 0; i < n; ++i)
            axis.values.push_back(number_text((from * (n - 1 - i) + to * i) / (n - 1)));
    } else if (step) {
        const double width = step->number_above(0.0, to - from), steps = std::floor((to - from) / width + 1e-9);
        if (steps >= static_cast<double>(max_axis_values))
            step->refuse(fmt::format("{:.0f} steps", steps), fmt::format("at most {}", max_axis_values - 1));
        if (from + width * steps < to - 1e-6 * (to - from))
            step->refuse(fmt::format("{:g}, which leads past {:g} from {:g}", width, to, from),
                         fmt::format("a step that ends there, such as {:g}", (to - from) / std::ceil((to - from) / width)));
        for (int i = 0; i <= static_cast<int>(steps); ++i)
            axis.values.push_back(number_text(from + width * i));
    }
    if (!axis.values.empty())
        axis.range.reset();
}

StudyAxis read_axis(const std::string& name, const YamlMember& member, const YamlEntry& entry) {
    StudyAxis axis{.name = name, .key = name, .values = {}, .range = {}, .line = member.line, .column = member.column};
    if (entry.is_list()) {
        key_of_axis(entry, axis.key);
        read_values(entry, axis);
        return axis;
    }
    const YamlMap keys = entry.map({"key", "values", "from", "to", "count", "step"});
    const auto key = keys.find("key");
    axis.key = key ? key_of_axis(*key, key->text()) : key_of_axis(entry, name);
    if (const auto values = keys.find("values")) {
        for (const char* const other : {"from", "to", "count", "step"})
            if (const auto given = keys.find(other))
                given->refuse(fmt::format("{} beside values", other), "one of them");
        read_values(*values, axis);
    } else
        read_range(keys, axis);
    return axis;
}

std::size_t times(std::size_t a, std::size_t b) {
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    return b != 0 && a > most / b ? most : a * b;
}

void add_grid(const std::vector<StudyAxis>& axes, std::vector<StudyPoint>& points) {
    std::vector<std::size_t> at(axes.size(), 0);
    for (std::size_t left = number_of_points(axes, {}); left > 0; --left) {
        StudyPoint& point = points.emplace_back();
        for (std::size_t i = 0; i < axes.size(); ++i)
            point.push_back(axes[i].values[at[i]]);
        for (std::size_t i = axes.size(); i-- > 0 && ++at[i] == axes[i].values.size();)
            at[i] = 0;
    }
}

void add_each_alone(const std::vector<StudyAxis>& axes, std::vector<StudyPoint>& points) {
    points.emplace_back(axes.size());
    for (std::size_t i = 0; i < axes.size(); ++i)
        for (const std::string& value : axes[i].values)
            points.emplace_back(axes.size())[i] = value;
}

std::string sampled(const StudyAxis& axis, double share) {
    if (axis.range)
        return number_text(axis.range->first + share * (axis.range->second - axis.range->first));
    return axis.values[std::min(static_cast<std::size_t>(share * static_cast<double>(axis.values.size())), axis.values.size() - 1)];
}

/// Where an axis stands in the study's file.
[[noreturn]] void refuse_at(const Study& study, const StudyAxis& axis, const std::string& found, const std::string& expected) {
    throw InputError({study.file, axis.line, axis.column, "axes." + axis.name}, found, expected);
}

bool is_below(const std::string& key, std::string_view beginning) {
    return key.starts_with(beginning) && (key.size() == beginning.size() || key[beginning.size()] == '.');
}

bool is_of_lamps(const std::string& key) { return is_below(key, "lamp_sets") || is_below(key, "car.lamps"); }

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

/// Angle of a lamp's aim that an axis sets: "pitch", "yaw", "roll"; "" for others.
std::string_view aim_angle(const StudyAxis& axis) {
    const std::string last = last_part(axis.key);
    if (!is_of_lamps(axis.key) && !drive_axis_named(axis.key))
        return "";
    for (const std::string_view angle : {"pitch", "yaw", "roll"})
        if (last == std::string(angle) + "_deg" || last == std::string(angle) + "_rad")
            return angle;
    return last == "percent_down" || last == "aim" ? "pitch" : "";
}

/// What the study itself puts into each drive, after the drive was read.
void refuse_overridden(const Study& study, const StudyAxis& axis) {
    struct Owned {
        std::string_view beginning, by;
    };
    for (const Owned& owned : {Owned{"technique", "techniques"},
                               {"capture", "pictured_moments"},
                               {"fernlicht", "another key"},
                               {"name", "another key"},
                               {"title", "another key"},
                               {"limits", "limits, of the study"}})
        if (is_below(axis.key, owned.beginning))
            refuse_at(study, axis, fmt::format("'{}', which the study itself decides", axis.key), std::string(owned.by));
    constexpr std::string_view of_study[] = {"file",   "source",        "voltage_v", "reference_voltage_v", "function", "colour",
                                             "recipe", "temperature_k", "spectrum"};
    if (is_of_lamps(axis.key) && std::ranges::count(of_study, last_part(axis.key)) > 0)
        refuse_at(study, axis, "a key that the study's lamps and conditions decide", "lamps, or conditions.voltage_v");
    if (is_below(axis.key, "car.lamps") || is_below(axis.key, "lamp_sets"))
        if (axis.key.find('.') == std::string::npos || axis.key == "car.lamps")
            refuse_at(study, axis, "the lamps, which the study decides", "lamps");
}

void refuse_conflicts(const Study& study, const StudyAxis& axis) {
    const std::string_view angle = aim_angle(axis);
    if (angle == "pitch" && study.conditions.aim_percent.size() > 1)
        refuse_at(study, axis, "a pitch of the lamps beside several conditions.aim_percent", "one of them: both lower the cut-off");
    if (is_below(axis.key, "daylight") && study.conditions.times_of_day != std::vector{Daylight{}})
        refuse_at(study, axis, "daylight beside conditions.time_of_day", "one of them");
    if (axis.key == "mirrored_road" && study.conditions.mirror != std::vector<bool>{false})
        refuse_at(study, axis, "mirrored_road beside conditions.mirror", "one of them");
    for (const StudyLamp& lamp : study.lamps) {
        const bool own = (angle == "pitch" && lamp.pitch_rad) || (angle == "yaw" && lamp.yaw_rad) || (angle == "roll" && lamp.roll_rad);
        if (own && !drive_axis_named(axis.key))
            refuse_at(study, axis, fmt::format("a {} that lamps.{}.aim takes the place of", angle, lamp.name),
                      fmt::format("{}_deg, which is added to it", angle));
    }
    if (drive_axis_named(axis.key) && axis.key.starts_with("mount_"))
        for (const StudyAxis& other : study.axes)
            if (is_below(other.key, "car.mounts") || last_part(other.key) == "position_m")
                refuse_at(study, axis, fmt::format("{} beside {}", axis.key, other.key), "one of them: both move the lamps");
}

} // namespace

void read_axes(const YamlEntry& given, Study& study) {
    const YamlValue& value = given.value();
    if (value.kind != YamlValue::Kind::map || value.members.empty() || value.members.size() > max_axes)
        given.refuse(fmt::format("1 to {} axes: a map of key paths of a drive, each with its values", max_axes));
    for (const YamlMember& member : value.members) {
        const YamlEntry entry(member.value, given.file(), given.key_path() + "." + printable(member.key, 200));
        const StudyAxis axis = read_axis(member.key, member, entry);
        for (const StudyAxis& other : study.axes)
            if (paths_overlap(axis.key, other.key))
                entry.refuse(fmt::format("'{}' beside the axis '{}': both set the same", axis.key, other.name), "one of them");
        study.axes.push_back(axis);
    }
}

void read_sample(const YamlEntry& given, Study& study) {
    if (given.is_scalar()) {
        study.sample.kind = given.choice({"grid", "one_at_a_time"}) == 1 ? SampleKind::one_at_a_time : SampleKind::grid;
        return;
    }
    const YamlMap keys = given.map({"low_discrepancy", "seed"});
    study.sample.kind = SampleKind::low_discrepancy;
    study.sample.count = static_cast<std::size_t>(keys.require("low_discrepancy").whole(1, static_cast<int>(max_study_cells)));
    if (const auto seed = keys.find("seed"))
        study.sample.seed = seed->count();
}

std::string axes_schema() {
    const std::string values =
        fmt::format(R"({{"type": "array", "minItems": 1, "maxItems": {}, "items": {{"not": {{"type": "null"}}}}}})", max_axis_values);
    return fmt::format(R"({{"type": "object", "minProperties": 1, "maxProperties": {}, "additionalProperties": {{"anyOf": [{}, {{
        "type": "object", "additionalProperties": false, "properties": {{
        "key": {{"type": "string", "description": "path of a drive's key; the axis's name by default"}}, "values": {},
        "from": {{"type": "number"}}, "to": {{"type": "number"}},
        "count": {{"type": "integer", "minimum": 2, "maximum": {}, "description": "of even values, both ends among them"}},
        "step": {{"type": "number", "exclusiveMinimum": 0}}}},
        "oneOf": [{{"required": ["values"], "not": {{"anyOf": [{{"required": ["from"]}}, {{"required": ["to"]}}, {{"required": ["count"]}},
        {{"required": ["step"]}}]}}}}, {{"required": ["from", "to"], "not": {{"anyOf": [{{"required": ["values"]}},
        {{"required": ["count", "step"]}}]}}}}]}}]}}}})",
                       max_axes, values, values, max_axis_values);
}

std::string sample_schema() {
    return fmt::format(R"({{"anyOf": [{{"enum": ["grid", "one_at_a_time"]}}, {{"type": "object", "additionalProperties": false,
        "required": ["low_discrepancy"], "properties": {{"low_discrepancy": {{"type": "integer", "minimum": 1, "maximum": {}}},
        "seed": {{"type": "integer", "minimum": 0}}}}}}]}})",
                       max_study_cells);
}

std::size_t number_of_points(const std::vector<StudyAxis>& axes, const StudySample& sample) {
    if (axes.empty())
        return 1;
    if (sample.kind == SampleKind::low_discrepancy)
        return sample.count;
    std::size_t grid = 1, alone = 1;
    for (const StudyAxis& axis : axes) {
        grid = times(grid, axis.values.size());
        alone += axis.values.size();
    }
    return sample.kind == SampleKind::grid ? grid : alone;
}

std::vector<StudyPoint> points_of(const std::vector<StudyAxis>& axes, const StudySample& sample) {
    std::vector<StudyPoint> points;
    if (axes.empty())
        return {{}};
    switch (sample.kind) {
    case SampleKind::grid:
        add_grid(axes, points);
        break;
    case SampleKind::one_at_a_time:
        add_each_alone(axes, points);
        break;
    case SampleKind::low_discrepancy:
        for (const std::vector<double>& shares : sobol_points(sample.count, axes.size(), sample.seed)) {
            StudyPoint& point = points.emplace_back();
            for (std::size_t i = 0; i < axes.size(); ++i)
                point.push_back(sampled(axes[i], shares[i]));
        }
        break;
    }
    return points;
}

std::string point_text(const std::vector<StudyAxis>& axes, const StudyPoint& point) {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < point.size(); ++i)
        if (!point[i].empty())
            parts.push_back(axes[i].name + " " + point[i]);
    return parts.empty() && !point.empty() ? "base" : fmt::format("{}", fmt::join(parts, ", "));
}

bool is_daylight_an_axis(const std::vector<StudyAxis>& axes) {
    return std::ranges::any_of(axes, [](const StudyAxis& axis) { return is_below(axis.key, "daylight"); });
}

void check_axes(const YamlEntry& file, const Study& study) {
    if (study.axes.empty() && (study.sample.kind != SampleKind::grid || study.sample.count > 0))
        file.refuse("a sample without axes", "axes beside it");
    for (const StudyAxis& axis : study.axes) {
        refuse_overridden(study, axis);
        refuse_conflicts(study, axis);
        if (axis.range && study.sample.kind != SampleKind::low_discrepancy)
            refuse_at(study, axis, "a range without count or step", "one of them, or sample: {low_discrepancy: N}");
    }
}

} // namespace fernlicht
