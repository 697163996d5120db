// From a storyboard to the drive's own car and road users.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// Plays the drive's storyboard on its road and fills what follows from it: the own car's track, the route it drives and its speed, the
/// duration, the other entities as road users (with the lamps of the traffic row that names them), light states as lamp changes, and the
/// environment that holds when it begins. Nothing for a drive without a storyboard. Throws InputError with file and line.
void tell_story(Drive& drive, const RoadNetwork& network);

} // namespace fernlicht
