// From other systems of angles to the UN goniometer's H = atan2(x, z), V = asin(y), by resampling with a bounded error.
#pragma once

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/lamps/measured_grid.h"

namespace fernlicht {

/// IES type B, horizontal polar axis: h = asin(x), v = atan2(y, z).
AngleSystem type_b();
/// Angles as read off a flat screen square to the axis: h = atan(x / z), v = atan(y / z).
AngleSystem flat_screen();
/// C planes about a beam that points along the luminaire's gamma = 0, here forward: h = -C, v = gamma - 90, C 0 to the right, C 90 up,
/// as a plan view of the luminaire is read.
AngleSystem beam_along_nadir();

/// Sets lamp.measured to the table `native` over the angles of `system`, and lamp.table to the same brought onto H and V. The axes hold the
/// native angles, the peak's direction, and as many more as bring the difference between the two tables below 0.1 % of the peak, up to half
/// a million samples. Of the cells in which the native data end, at most 0.1 degrees wide where the samples suffice, as many are data as
/// hold the light of those parts that have data: the flux stays, and the border runs to the cell. The others are gaps. Adds a note with the
/// size and the worst difference found by probing.
void bring_onto_goniometer(CandelaTable native, AngleSystem system, LampFile& lamp);

} // namespace fernlicht
