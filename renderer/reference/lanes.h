// Angles of a packet at a time: a function that is called a dozen times for every ray, in a form that compilers turn into SIMD.
#pragma once

#include "renderer/reference/embree_scene.h"

namespace fernlicht::reference {

using Lanes = std::array<double, packet_size>;

/// atan2(y, x) in every lane, radians, within 6e-16; (0, 0) gives 0. Cephes' rational function (Moshier 1989) on octants. The four basic
/// operations alone: the same bits with any width of SIMD. Lanes that hold no number give no number.
void angles(const Lanes& y, const Lanes& x, Lanes& angle_rad);

} // namespace fernlicht::reference
