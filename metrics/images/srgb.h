// sRGB as IEC 61966-2-1 encodes it.
#pragma once

#include <array>
#include <cstdint>

namespace fernlicht {

/// 0..1 to 0..1.
double srgb_decoded(double encoded);
/// Of all 8-bit values.
const std::array<float, 256>& srgb_table();

} // namespace fernlicht
