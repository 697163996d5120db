// Positions, routes and trajectories from their elements.
#pragma once

#include "scenarios/openscenario/osc_node.h"

namespace fernlicht::osc {

/// From an element that holds a Position (its child of that name), or from the Position itself. Throws InputError.
Position read_position(const OscNode& node);
/// From an element that holds a Route or Trajectory, or a CatalogReference to one. Throw InputError.
std::shared_ptr<const Route> read_route(const OscNode& holder);
std::shared_ptr<const Trajectory> read_trajectory(const OscNode& holder);
Orientation read_orientation(const OscNode& node);

} // namespace fernlicht::osc
