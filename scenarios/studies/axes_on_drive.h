// How a point of a study's axes becomes a drive.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/studies/study_axes.h"

namespace fernlicht {

/// What is built or loaded otherwise and no single key says.
enum class DriveAxis {
    mount_height_m,  ///< z of all lamps of the own car above the road
    mount_spacing_m, ///< from the left low beam to the right one, along y; other lamps keep their distance from the one of their side
    yaw_deg,         ///< added to the aim of all lamps of the own car, left positive; pitch up, roll lifting the left side
    pitch_deg,
    roll_deg,
    load_kg,     ///< over the rear axle since the lamps were aimed, in place of the drive's own (docs/control.md)
    speed_factor ///< times the own car's speed; the drive stays as long in time
};

std::vector<std::string> drive_axis_names();
/// By its name; nullopt for others.
std::optional<DriveAxis> drive_axis_named(const std::string& name);
/// What it may be, both ends included.
std::pair<double, double> limits_of(DriveAxis axis);

/// Keys of the drive file that a point sets; of named axes nothing.
std::vector<std::pair<std::string, std::string>> values_of_point(const std::vector<StudyAxis>& axes, const StudyPoint& point);
/// Sets the named axes of a drive that was read; keys of its file are left alone. The first lamp set alone. Throws InputError for what this
/// drive cannot have: a spacing without a left and a right low beam or with lamps that would change sides, a speed that a storyboard says.
void set_named_axes(const std::vector<StudyAxis>& axes, const StudyPoint& point, Drive& drive);

} // namespace fernlicht
