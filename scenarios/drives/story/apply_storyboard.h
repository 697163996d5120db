// From a storyboard to the drive's own car and road users.
// LightState of a storyboard as changes of lamps.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/openscenario/play_story.h"
#include "scenarios/traffic/road_user.h"

namespace fernlicht {

/// Plays the drive's storyboard on its road and fills what follows from it: the own car's track, the route it drives and its speed, the
/// duration, the other entities as road users (with the lamps of the traffic row that names them), light states as lamp changes, and the
/// environment that holds when it begins. Nothing for a drive without a storyboard. Throws InputError with file and line.
void apply_storyboard(Drive& drive, const RoadNetwork& network);

/// Changes of level for the lamps whose functions the light names, until `end_s`: transitions as ramps of 20 ms, flashing as on and off.
/// A lamp is lit at the level that it has in `lamps` when that is above 0, else at 1. Sorted by time.
std::vector<LampChange> light_changes(const std::vector<osc::LightChange>& lights, const std::vector<TrafficLamp>& lamps, double end_s);

/// Lamps that OpenSCENARIO's name of a light means.
bool is_light(const std::string& light, LampFunction function);

} // namespace fernlicht
