// Left-hand traffic from a drive made for right-hand traffic, or the other way round.
// Lamp control for the other side's traffic.
#pragma once

#include "scenarios/can/bus_mapping.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/drive.h"

#include <optional>

namespace fernlicht {

/// Mirrors the drive's road and all that the drive places to the left or the right: views, probes, sensors, mirrors. With `lamps` the car's
/// lamps too: tables, mounts, how they are turned aside, ranges of bend lighting; without, the car keeps the lamps that it has, made for
/// the other side. Poles of street lamps go to the other side. Other road users go on the mirrored road with mirrored lamps. "left" and
/// "right" change places in names and in readings that have limits, and signals from and to a bus point to the other side.
void mirror_traffic(Drive& drive, bool lamps);

/// The other sign, and never a negative zero, which files would show.
inline void change_sign(double& value) { value = 0.0 - value; }
inline void change_sign(std::optional<double>& value) {
    if (value)
        change_sign(*value);
}

/// "high-left" of "high-right"; within longer words they stay ("bright").
std::string other_side(const std::string& name);

/// Left and right exchanged: lamps' names, stops of the swivel, windows, signals that point to a side. Plug-ins and FMUs keep
/// their sides, by whatever name: they are a car's laws, told of the mirrored world.
ControlParameters mirrored(ControlParameters control);
/// What a bus says of left and right is taken for the other side; lamps' names likewise.
BusMapping mirrored(BusMapping mapping);

} // namespace fernlicht
