// Environments of a storyboard as a drive's daylight and weather, from its beginning and from each change on.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/openscenario/played_story.h"

namespace fernlicht {

/// What holds when the story begins becomes the drive's daylight and weather, what comes later its told skies (told_story.h), unless the
/// drive's file says daylight or weather itself (own_daylight, own_weather of its storyboard). A TimeOfDay becomes sun, moon and sky by
/// date, time and place: the storyboard's `site`, else the network's geoReference at the own car's first place, else a place of ours; with
/// a Sun in figures beside it only where it is animated. Nothing for a story without environments.
void tell_environment(Drive& drive, const osc::PlayedStory& story, const RoadNetwork& network);

/// 0 to 9 (or "fourOktas") as clear (to 2), partly cloudy (to 6) and overcast; the words of older files. nullopt: none of them.
std::optional<SkyCover> sky_cover_of(std::string_view clouds);

} // namespace fernlicht
