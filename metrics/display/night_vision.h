// What an eye loses at night: colours, since rods see none, and sharpness. Both follow the luminance to which the eye is adapted where it
// looks, the mean over one degree around the pixel.
#pragma once

#include "scenarios/values/image.h"

#include <glm/vec3.hpp>

namespace fernlicht {

/// Finest grating that an eye resolves, cycles a degree: 17.25 atan(1.4 lg L + 0.35) + 25.72 (Larson, Rushmeier, Piatko 1997, equation 13,
/// fitted to Shaler's data). L in cd/m2, > 0; 3.0 where the fit ends, at 1e-3 cd/m2 and below.
double acuity_cycles_per_deg(double adaptation_cdm2);

/// Share of the cones in what is seen: m of CIE 191 (metrics/seeing/visibility.h) for light of S/P 1. 1 from 5 cd/m2 on, 0 up to 0.005.
double cone_share(double adaptation_cdm2);

/// Rods' luminance of light in sRGB's primaries, cd/m2, so scaled that of white it is the photopic one: Y (1.33 (1 + (Y + Z) / X) - 1.68)
/// / 2.573 (Larson, Rushmeier, Piatko 1997, equation 9). Not below 0.
double rod_luminance_cdm2(const glm::dvec3& light);

/// Luminance of what one degree around each pixel has, cd/m2. A square window, cut at the picture's edges. 0 < pixel_deg.
Image<float> adaptation_cdm2(const Image<glm::vec3>& light, double pixel_deg);

/// m of the light as it is, 1 - m of it as rods see it, in grey. Pixels where m = 1 keep their bytes.
Image<glm::vec3> colours_at_night(const Image<glm::vec3>& light, double pixel_deg);

/// Blurred by a Gaussian that leaves a tenth of the finest grating: sigma = 0.3415 degrees / acuity. Where that is less than a fifth of a
/// pixel the pixels keep their bytes.
Image<glm::vec3> sharpness_at_night(const Image<glm::vec3>& light, double pixel_deg);

} // namespace fernlicht
