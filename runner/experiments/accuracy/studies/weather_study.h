// Error against run time of what is in the air, on the road and in the sky of a drive: each as it is drawn, coarser, finer, and left out.
#pragma once

#include "runner/experiments/accuracy/studies/studies.h"

namespace fernlicht {

/// One diagram for each of fog, wet road, sun or moon and lamps beside the road that the middle moment has; none where it has none. Error
/// of luminance, 95 % of the pixels with at least 0.001 cd/m2, against the reference's direct light by the ray through each pixel's centre,
/// surfaces without their textures and other road users' lamps switched off, so that nothing but this light is compared; over the
/// time of a frame. Throws DeviceError.
std::vector<WorkPrecision> weather_study(const Stage& stage, const Variant& variant, Device& device, const StudyGoesOn& go_on);

} // namespace fernlicht
