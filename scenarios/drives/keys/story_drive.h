// A storyboard alone as a drive: what a drive file would say has its default.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// By its name's end, .xosc.
bool is_storyboard_file(const std::filesystem::path& path);

/// The YAML of a drive that plays this storyboard: halogen low beams of the shipped library for the own car and for all other vehicles, the
/// driver's view and the map, road extent measured. The own car is `edits.ego`; else the entity named Ego; else one of its usual other
/// names (hero, ego_vehicle; upper or lower case); else the first vehicle. Throws InputError for storyboards that cannot be read, that have
/// no vehicle, and where no library is found above the program or the working folder.
std::string storyboard_drive_text(const std::filesystem::path& path, const DriveEdits& edits);

} // namespace fernlicht
