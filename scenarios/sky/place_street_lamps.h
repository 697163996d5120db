// Street lamps of a drive as lamps of a moment and as meshes.
#pragma once

#include "scenarios/drives/moment.h"
#include "scenarios/roads/route.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

/// Farther along the route than this a lamp is not part of a moment: 8 m up and 400 m away it gives 0.01 lx at most.
inline constexpr double street_lamps_within_m = 400.0;

/// Adds those lamps of the drive's rows that hang within so many metres along the route to Moment::other_lamps, fixed in the world.
void add_street_lamps(const Drive& drive, const Route& route, double within_m, Moment& moment);

/// Their poles, arms and heads as meshes; the light leaves just below the head, so that it shades nothing of what it lights.
void add_street_lamp_poles(const Drive& drive, const Route& route, Scene& scene);

} // namespace fernlicht
