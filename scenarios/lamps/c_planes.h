// Type C photometry (IES type C, EULUMDAT): half planes C about the vertical, gamma from the nadir up.
#pragma once

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/lamps/measured_grid.h"

namespace fernlicht {

/// How the planes that a file stores stand for the whole turn.
enum class PlaneSymmetry { none, rotational, about_c0_c180, about_c90_c270, quadrants };

/// `planes`: h_deg = C (any turn), v_deg = gamma, 0..180, in order. C grows against the clock, seen from above (LM-63, CIE 121).
/// Axis horizontal: the horizon is gamma 90, and forward is the plane, out of 0, 90, 180 and 270, nearest to the mean direction of the
/// light. Axis nadir: forward is gamma 0, C 0 to the right, C 90 up. Automatic: nadir when the mean direction of the light (the
/// integral of I times the unit vector) lies within 45 degrees of gamma 0, else horizontal. Notes say which, and why.
/// Planes that end short of the whole turn are joined when the hole is at most 1.5 steps wide; a wider hole has no data.
void from_c_planes(const MeasuredGrid& planes, PlaneSymmetry symmetry, const LampReadOptions& options, LampFile& lamp);

} // namespace fernlicht
