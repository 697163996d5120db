// Before a run draws anything: does this driver compute light rightly?
#pragma once

#include "renderer/device.h"

namespace fernlicht {

/// Draws a wall 25 m before a lamp of 6250 cd and compares every pixel with E = I cos^3(angle) / 625.
/// Throws DeviceError naming the worst pixel when the error is beyond `sanity_bound`. Returns the worst relative error.
double check_sanity(Device& device);

/// float positions at 25 m are exact to 1e-7; bilinear, division and dot products add a few units in the last place each.
inline constexpr double sanity_bound = 5e-6;

} // namespace fernlicht
