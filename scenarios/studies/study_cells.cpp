#include "scenarios/drives/edits/mirrored_drive.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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

} // namespace fernlicht
