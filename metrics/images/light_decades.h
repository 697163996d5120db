// Light as an eye and a log scale take it: in decades, for metrics that compare structure.
#pragma once

#include "scenarios/values/image.h"

namespace fernlicht {

/// How far below the reference's largest value structure is looked at: four decades are headlamps on the road (100 lx) down to moonlight
/// (0.01 lx).
inline constexpr double decades_below_peak = 4.0;

/// log10(value / peak) + decades_below_peak, 0 for everything darker than that (also for 0 and below), so 0..4 for a picture with this
/// peak. The range to hand to ssim() is decades_below_peak. Throws std::invalid_argument for a peak that is not above 0.
Image<float> decades_of(const Image<float>& picture, double peak);

/// The largest value; 0 for a picture without light.
double peak_of(const Image<float>& picture);

} // namespace fernlicht
