#include "scenarios/studies/study.h"

#include "scenarios/drives/edits/adapting_white.h"
#include "scenarios/drives/edits/mirrored_drive.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/key_path.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/studies/axes_on_drive.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <string_view>

namespace fernlicht {
namespace {

/// "aim-1.5": what tells a cell's condition from the study's others; "" where the study has one value.
std::string part(bool several, const std::string& text) { return several ? "_" + text : std::string(); }

/// "p007": points have numbers of one length, from 1.
std::string point_name(const Study& study, std::size_t point) {
    return fmt::format("p{:0{}}", point + 1, std::max<std::size_t>(2, fmt::formatted_size("{}", study.points.size())));
}

std::string condition_part(const Study& study, const StudyCell& cell) {
    const StudyConditions& c = study.conditions;
    return part(c.times_of_day.size() > 1, c.times_of_day[cell.time_of_day].name) +
           part(c.aim_percent.size() > 1, fmt::format("aim{:g}", c.aim_percent[cell.aim])) +
           part(c.voltage_v.size() > 1, fmt::format("{:g}V", c.voltage_v[cell.voltage])) + part(c.mirror[cell.mirror], "mirrored") +
           part(!study.axes.empty(), point_name(study, cell.point));
}

StudyCell named(const Study& study, StudyCell cell) {
    const StudyConditions& c = study.conditions;
    cell.name = fmt::format("{}_{}{}{}", name_from(study.drives[cell.drive]), study.lamps[cell.lamp].name,
                            part(study.techniques.size() > 1, study.techniques[cell.technique]), condition_part(study, cell));
    const StudyConditions usual; // what nobody asked for is no condition: a file of whatever aim is at -1 % of its own
    cell.condition = c.times_of_day[cell.time_of_day].name;
    if (c.aim_percent != usual.aim_percent)
        cell.condition += fmt::format(", aim {:g} %", c.aim_percent[cell.aim]);
    if (c.voltage_v != usual.voltage_v)
        cell.condition += fmt::format(", {:g} V", c.voltage_v[cell.voltage]);
    cell.condition += c.mirror[cell.mirror] ? ", mirrored" : "";
    for (std::size_t i = 0; i < study.axes.size(); ++i)
        cell.axes.push_back({study.axes[i].name, study.points[cell.point][i]});
    std::vector<StudyAxis> told;
    StudyPoint values;
    for (std::size_t i = 0; i < study.axes.size(); ++i)
        if (varies(study, i)) {
            told.push_back(study.axes[i]);
            values.push_back(study.points[cell.point][i]);
        }
    if (!told.empty())
        cell.condition += ", " + point_text(told, values);
    return cell;
}

DriveEdits edits_for(const Study& study, const StudyLamp& lamp, const StudyCell& cell) {
    DriveEdits edits;
    edits.lamps.emplace_back("", lamp.left); // every low beam, whatever its name
    if (lamp.right != lamp.left)
        edits.lamps.emplace_back("right", lamp.right);
    edits.lamp_recipe = lamp.recipe;
    edits.technique = study.techniques[cell.technique];
    edits.resolution = study.resolution_px;
    edits.values = values_of_point(study.axes, study.points[cell.point]);
    return edits;
}

/// High beams come with the lamp set, or the drive has none.
void put_high_beams(const Study& study, const StudyLamp& lamp, Drive& drive, DriveEdits& edits) {
    if (!std::ranges::any_of(drive.lamp_sets.front().lamps, is_high_beam, &MountedLamp::name))
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
    add(everywhere.tolerances, own.tolerances);
}

/// Where no cut-off is looked for: the aim of the study is that of the cut-off, and the file has its own dip already. Equal ones turn
/// nothing, to the last bit.
double pitch_from_file_rad(const StudyLamp& lamp, double aim_percent) {
    return std::atan(aim_percent / 100.0) - std::atan(lamp.file_aim_percent / 100.0);
}

void aim_lamp(const Study& study, const StudyLamp& lamp, double aim_percent, MountedLamp& mounted) {
    mounted.aim_rule = lamp.aim.value_or(mounted.aim_rule);
    mounted.pitch_rad = lamp.pitch_rad.value_or(mounted.pitch_rad);
    mounted.yaw_rad = lamp.yaw_rad.value_or(mounted.yaw_rad);
    mounted.roll_rad = lamp.roll_rad.value_or(mounted.roll_rad);
    if (mounted.aim_rule == BeamAim::as_is) {
        mounted.pitch_rad += pitch_from_file_rad(lamp, aim_percent);
        return;
    }
    if (lamp.file_aim_percent != StudyLamp{}.file_aim_percent)
        throw InputError({study.file, 0, 0, fmt::format("lamps.{}.file_aim_percent", lamp.name)},
                         fmt::format("found {:g} %, and a drive aims its lamps by their cut-off", lamp.file_aim_percent),
                         "aim: as-is beside it, or no file_aim_percent");
    if (!(aim_percent >= lowest_cut_off_percent && aim_percent <= highest_cut_off_percent))
        throw InputError({study.file, 0, 0, "conditions.aim_percent"},
                         fmt::format("found {:g} beside `aim: auto`, which puts the cut-off of {} there", aim_percent, lamp.name),
                         fmt::format("{} to {}: below the horizon", lowest_cut_off_percent, highest_cut_off_percent));
    mounted.cut_off_percent = aim_percent;
}

/// Of an automatic aim they count from where that put the beam.
void aim_changes(const StudyLamp& lamp, double aim_percent, LampSet& lamp_set) {
    for (LampChange& change : lamp_set.changes) {
        const auto changed = std::ranges::find(lamp_set.lamps, change.lamp, &MountedLamp::name);
        if (change.pitch_rad && changed != lamp_set.lamps.end() && changed->aim_rule == BeamAim::as_is)
            *change.pitch_rad += pitch_from_file_rad(lamp, aim_percent);
    }
}

} // namespace

bool varies(const Study& study, std::size_t axis) {
    return std::ranges::any_of(study.points, [&](const StudyPoint& point) { return point.at(axis) != study.points.front().at(axis); });
}

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
                            for (cell.point = 0; cell.point < study.points.size(); ++cell.point)
                                for (cell.lamp = 0; cell.lamp < study.lamps.size(); ++cell.lamp)
                                    cells.push_back(named(study, cell));
    std::set<std::string_view> names;
    for (const StudyCell& one : cells)
        if (!names.insert(one.name).second)
            throw InputError({study.file, 0, 0, "drives"}, "found two cells '" + one.name + "'", "drive files of different names");
    return cells;
}

namespace {

Drive drive_of_cell(const Study& study, const StudyCell& cell) {
    const StudyLamp& lamp = study.lamps[cell.lamp];
    DriveEdits edits = edits_for(study, lamp, cell);
    Drive drive = read_drive(study.drives[cell.drive], edits);
    put_high_beams(study, lamp, drive, edits);
    add_measures(study.measure, drive.seeing);
    if (!is_daylight_an_axis(study.axes))
        drive.daylight = study.conditions.times_of_day[cell.time_of_day];
    if (drive.storyboard)
        drive.storyboard->own_daylight = true; // of the study: no environment of the storyboard changes it
    drive.lamp_sets.resize(1);
    LampSet& lamp_set = drive.lamp_sets.front();
    lamp_set.name = lamp.name + condition_part(study, cell);
    const double aim_percent = study.conditions.aim_percent[cell.aim];
    for (MountedLamp& mounted : lamp_set.lamps) {
        mounted.source = lamp.source;
        mounted.colour = lamp.colour;
        mounted.voltage_v = study.conditions.voltage_v[cell.voltage];
        aim_lamp(study, lamp, aim_percent, mounted);
        mounted.reference_voltage_v = lamp.reference_voltage_v;
        mounted.function = is_high_beam(mounted.name) ? std::nullopt : lamp.function;
    }
    aim_changes(lamp, aim_percent, lamp_set);
    set_named_axes(study.axes, study.points[cell.point], drive);
    if (study.conditions.mirror[cell.mirror])
        mirror_traffic(drive, lamp.mirrors);
    read_adaptation_lamp(drive);
    close_white(drive, white_of_studies());
    drive.capture.all = false;
    drive.capture.per_second = study.pictured_moments / drive.duration_s;
    // Of what the reader decided, that only one lamp set is left is the study's own doing.
    std::erase_if(drive.notes, [](const std::string& note) { return note.starts_with("every lamp set would have"); });
    return drive;
}

/// "changes.0.level" of "changes[0].level".
std::string path_in_dots(std::string key) {
    std::erase(key, ']');
    std::ranges::replace(key, '[', '.');
    return key;
}

/// A drive that is read as it is refuses a point: the axes are the reason, one of them where the refused key is its own.
[[noreturn]] void refuse_point(const Study& study, const StudyCell& cell, const InputError& error) {
    const StudyPoint& point = study.points[cell.point];
    const StudyAxis* named = nullptr;
    std::string values = point_text(study.axes, point);
    for (std::size_t i = 0; i < point.size(); ++i)
        if (!point[i].empty() && !error.where().key.empty() && paths_overlap(study.axes[i].key, path_in_dots(error.where().key))) {
            named = &study.axes[i];
            values = point[i];
        }
    const StudyAxis& at = named ? *named : study.axes.front();
    throw InputError({study.file, at.line, at.column, named ? "axes." + at.name : "axes"},
                     fmt::format("found {}, which this drive refuses: {}", values, error.what()));
}

} // namespace

Drive cell_drive(const Study& study, const StudyCell& cell) {
    try {
        return drive_of_cell(study, cell);
    } catch (const InputError& error) {
        if (study.axes.empty())
            throw;
        Study plain = study;
        plain.axes.clear();
        plain.points = {{}};
        StudyCell without = cell;
        without.point = 0;
        drive_of_cell(plain, without); // what it refuses, too, is not the axes' doing
        refuse_point(study, cell, error);
    }
}

} // namespace fernlicht
