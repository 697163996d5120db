// Distances between entities and places: straight, along the road, across it; from reference points or between boxes.
#pragma once

#include "scenarios/openscenario/osc_world.h"

namespace fernlicht::osc {

/// By the measure; nullopt where no road leads from one to the other. Longitudinal and lateral ones have a sign: ahead and left of the
/// first are positive; straight ones have none.
std::optional<double> distance(const World& world, const EntityState& from, const EntityState& to, const Measure& measure);
std::optional<double> distance(const World& world, const EntityState& from, const Spot& to, const Measure& measure);

/// Along the road, where none leads there along the first one's axis; ahead positive.
double longitudinal_gap(const World& world, const EntityState& from, const EntityState& to, bool freespace);
/// How far an entity still has to go to a place: along the road, else straight; below 0 beyond it.
double way_to(const World& world, const EntityState& from, const Spot& to);
/// The boxes overlap, seen from above.
bool touching(const EntityState& a, const EntityState& b);

} // namespace fernlicht::osc
