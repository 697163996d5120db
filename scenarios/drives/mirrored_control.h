// Lamp control for the other side's traffic.
#pragma once

#include "scenarios/control/control_parameters.h"

namespace fernlicht {

/// Left and right exchanged: lamps' names, stops of the swivel, windows, signals that point to a side. Plug-ins are left as they are.
ControlParameters mirrored(ControlParameters control);

} // namespace fernlicht
