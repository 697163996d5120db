// Where a road is cut across: at every place where something begins or ends, and between them as the chord error asks.
#pragma once

#include "scenarios/roads/mesh/mesh_cross_section.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <vector>

namespace fernlicht {

/// A stretch between two neighbouring stations; all of it lies in one lane section and one chunk.
struct RoadStretch {
    std::size_t profile = 0; ///< into the road's profiles
    double from_s_m = 0.0, to_s_m = 0.0;
    std::size_t chunk = 0;
    double layout_s_m() const { return 0.5 * (from_s_m + to_s_m); }
};

/// Lateral positions, constant in t, that every row has where it reaches so far: the knots of the lateral shape and what
/// bisection adds between them. Empty without shape.
std::vector<double> crown_lines(const RoadNetwork& network, const Road& road, double chord_error_m);

/// Stretches of the whole road in order. `crown` from crown_lines.
/// Where the surface itself jumps (a profile with a step), stretches are not cut below 2 cm: the step becomes a steep ramp.
std::vector<RoadStretch> stretches_of(const RoadNetwork& network, const Road& road, const std::vector<SectionProfile>& profiles,
                                      const std::vector<double>& crown, const RoadMeshOptions& options);

} // namespace fernlicht
