// Actions of entities and of the world.
#pragma once

#include "scenarios/openscenario/osc_node.h"

namespace fernlicht::osc {

/// From PrivateAction or GlobalAction. nullopt: not supported, which the reading notes. Throws InputError.
std::optional<PrivateAction> read_private_action(const OscNode& node);
std::optional<GlobalAction> read_global_action(const OscNode& node);
SpeedLimits read_limits(const OscNode& node);

} // namespace fernlicht::osc
