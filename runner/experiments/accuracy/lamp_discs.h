// How large lamps are in the rays that a drive's pictures are held against.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// Metres: of the discs that the drive's technique draws lamps as, by `soft-map`; 0: points, as everything else draws them. `auto` is to be
/// chosen before.
double lamp_disc_radius_m(const Drive& drive);

} // namespace fernlicht
