// Street lamps of a drive as lamps of a moment and as meshes.
#pragma once

#include "scenarios/drives/play/moment.h"
#include "scenarios/roads/route.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

/// Farther along the route than this a lamp is not part of a moment: 8 m up and 400 m away it gives 0.01 lx at most.
inline constexpr double street_lamps_within_m = 400.0;
/// Arms up to this are none: the lamp stands on top of its pole, which ends below it.
inline constexpr double street_lamp_min_arm_m = 0.14;

/// Finds what the rows with on_objects ask for among the road's objects: StreetLampRow::found. Lamps hang 0.1 m below the top of their
/// object, or at the row's height_m; with an arm of at most 0.14 m just above the top. Throws InputError where a row finds nothing, naming
/// what stands there.
void find_street_lamps(Drive& drive, const RoadNetwork& network);

/// Adds those lamps of the drive's rows that hang within so many metres along the route, or as the crow flies from the car for those on the
/// road's objects, to Moment::other_lamps, fixed in the world.
void add_street_lamps(const Drive& drive, const Route& route, double within_m, Moment& moment);

/// Their poles (where the road has none), arms and heads as meshes; the light leaves just below the head, so that it shades nothing of what
/// it lights.
void add_street_lamp_poles(const Drive& drive, const Route& route, Scene& scene);

} // namespace fernlicht
