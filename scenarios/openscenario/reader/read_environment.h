// Environments: time of day, weather and the road's condition as the file gives them.
#pragma once

#include "scenarios/openscenario/osc_node.h"

namespace fernlicht::osc {

Environment read_environment(const OscNode& node);

} // namespace fernlicht::osc
