// Moving along the network: one lane followed over the borders of sections, roads and junctions, and ways planned through it.
#pragma once

#include "scenarios/openscenario/osc_world.h"

namespace fernlicht::osc {

struct Moved {
    Spot spot;
    bool end_of_road = false; ///< the lane leads nowhere: the spot lies at its end
};

/// Moves along the lane that the spot is on (its offset kept), the way it looks; backwards for a distance below zero. `actual`: the
/// distance is that on the spot's own path; where the reference line bends with curvature k and the spot lies t beside it, s grows by
/// distance / (1 - k t). At junctions `path` decides, else the least turn.
Moved move_along(const World& world, const Spot& from, double distance_m, bool actual, RoadPath* path);

/// The shortest way over lanes (changes of lane count as `lane_change_m`) from a spot, the way it looks, through all goals in order. A
/// first goal that already lies behind is left out. nullopt: there is no way.
std::optional<RoadPath> plan_path(const World& world, const Spot& from, const std::vector<Spot>& goals);
inline constexpr double lane_change_m = 30.0;

/// Signed distance along reference lines from one spot to another, ahead of the first positive; nullopt where no road leads there within
/// `most_m` either way.
std::optional<double> distance_along(const World& world, const Spot& from, const Spot& to, double most_m = 2000.0);

} // namespace fernlicht::osc
