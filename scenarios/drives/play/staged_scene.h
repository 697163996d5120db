// From a drive as it is read to one that can be played: everything in its place before the first moment.
// The own car's body: what its driver sees of it.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/roads/route.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

/// Moves the own car, others and lamps along the drive (after apply_storyboard(), which gives a storyboard's route), and returns the road
/// with all that stands on it: scenery, street lamps, ground up to the horizon where there is daylight, bodies of others and of the own
/// car. Adds to drive.opened what it reads. Throws InputError for what road or route lacks.
Scene staged_scene(Drive& drive, const RoadNetwork& network, const Route& route);

/// Of the drive's own_car adds what its driver cannot look through: triangles ahead of the eye of the first perspective view that lie
/// wholly below five sixths of its height (bonnet, doors, dashboard; no windows). They move with the last of Moment::bodies, stand in the
/// way of no light (the lamps sit at their front), and hide what lies behind them. Nothing without a model or a perspective view. After
/// add_road_users().
void add_own_car(Scene& scene, const Drive& drive);

} // namespace fernlicht
