// LightState of a storyboard as changes of lamps.
#pragma once

#include "scenarios/openscenario/played_story.h"
#include "scenarios/traffic/road_user.h"

namespace fernlicht {

/// Changes of level for the lamps whose functions the light names, until `end_s`: transitions as ramps of 20 ms, flashing as on and off.
/// A lamp is lit at the level that it has in `lamps` when that is above 0, else at 1. Sorted by time.
std::vector<LampChange> light_changes(const std::vector<osc::LightChange>& lights, const std::vector<TrafficLamp>& lamps, double end_s);

/// Lamps that OpenSCENARIO's name of a light means.
bool is_light(const std::string& light, LampFunction function);

} // namespace fernlicht
