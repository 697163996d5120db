// From a drive as it is read to one that can be played: everything in its place before the first moment.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/roads/route.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

/// Moves the own car, others and lamps along the drive (after tell_story(), which gives a storyboard's route), and returns the road with
/// all that stands on it: scenery, street lamps, ground up to the horizon where there is daylight, bodies of others and of the own car.
/// Adds to drive.opened what it reads. Throws InputError for what road or route lacks.
Scene staged_scene(Drive& drive, const RoadNetwork& network, const Route& route);

} // namespace fernlicht
