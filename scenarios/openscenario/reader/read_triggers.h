// Triggers and their conditions.
#pragma once

#include "scenarios/openscenario/osc_node.h"

namespace fernlicht::osc {

/// nullopt when `element` ("StartTrigger", "StopTrigger") is not there. One without groups is there and never true. Throws InputError.
std::optional<Trigger> read_trigger(const OscNode& holder, const char* element);

} // namespace fernlicht::osc
