// Environments of a storyboard as a drive's daylight and weather.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/openscenario/played_story.h"

namespace fernlicht {

/// What holds when the story begins becomes daylight and weather, unless the drive's file says daylight or weather itself (has_daylight,
/// has_weather of its storyboard). Later changes are noted: they change nothing yet.
void tell_environment(Drive& drive, const osc::PlayedStory& story);

} // namespace fernlicht
