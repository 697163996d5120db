// Illuminance in a byte, for what a page shows under the pointer.
#pragma once

#include "scenarios/values/image.h"

#include <cstdint>

namespace fernlicht {

/// Codes 2 to 254 stand for 0.05 to 500 lx in equal ratios of 1.037, so that a code's lux is within 1.9 % of what was encoded; 1 stands for
/// less, 255 for more, and 0 for NaN: not computed.
inline constexpr double least_code_lx = 0.05, most_code_lx = 500.0;
std::uint8_t lux_code(double lx);
double lux_of(std::uint8_t code); ///< 0 of 0 and 1; most_code_lx of 255

/// Of every n-th pixel both ways, the middle one of each block, such that no side is longer than `most_px`; a side of fewer
/// than n gives one.
Image<std::uint8_t> lux_codes(const Image<float>& lx, int most_px);

} // namespace fernlicht
