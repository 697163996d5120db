// Lamp control for the other side's traffic.
#pragma once

#include "scenarios/can/bus_mapping.h"
#include "scenarios/control/control_parameters.h"

namespace fernlicht {

/// Left and right exchanged: lamps' names, stops of the swivel, windows, signals that point to a side. Plug-ins are left as they are.
ControlParameters mirrored(ControlParameters control);
/// What a bus says of left and right is taken for the other side; lamps' names likewise.
BusMapping mirrored(BusMapping mapping);

} // namespace fernlicht
