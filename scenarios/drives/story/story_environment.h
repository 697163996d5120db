// Environments of a storyboard as a drive's daylight and weather, from its beginning and from each change on.
// Where on the earth a road is, for its sky.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/openscenario/play_story.h"
#include "scenarios/openscenario/reader/read_storyboard.h"
#include "scenarios/values/pose.h"

#include <string_view>

namespace fernlicht {

/// What holds when the story begins becomes the drive's daylight and weather, what comes later its told skies (storyboard_timeline.h),
/// unless the drive's file says daylight or weather itself (own_daylight, own_weather of its storyboard). A TimeOfDay becomes sun, moon and
/// sky by date, time and place: the storyboard's `site`, else the network's geoReference at the own car's first place, else a place of
/// ours; with a Sun in figures beside it only where it is animated. Nothing for a story without environments.
void apply_environment(Drive& drive, const osc::PlayedStory& story, const RoadNetwork& network);

/// 0 to 9 (or "fourOktas") as clear (to 2), partly cloudy (to 6) and overcast; the words of older files. nullopt: none of them.
std::optional<SkyCover> sky_cover_of(std::string_view clouds);

/// From the projection that OpenDRIVE's geoReference names (PROJ's text: +lat_0 and +lon_0, else +proj=utm with +zone, or EPSG codes of UTM
/// zones 326zz, 327zz, 258zz) and a place in it: along the meridian by the arc of the WGS 84 ellipsoid, across it by the parallel's circle.
/// Within some 0.1 degrees where the place lies within 300 km of the projection's meridian, which moves the sun by as much. nullopt: it
/// names neither, or the place is not on the earth.
std::optional<SkySite> sky_site_of(std::string_view geo_reference, const glm::dvec3& position_m);

} // namespace fernlicht
