// Luminance of the road in the light of one even lamp, worked out from the equations themselves.
#pragma once

#include "metrics/folds/place_fold.h"

#include <cmath>

namespace fernlicht {

/// Luminance of asphalt d metres before the lamp of `cd` (0.65 m up) and `left` of it, seen from an eye `eye_back` behind the lamp,
/// `eye_left` of it and `eye_up` above the road: rho E / pi and R_L E_perp exp((reference - angle) / falloff).
inline double asphalt_cdm2(double cd, double d, double left, double eye_back, double eye_left = 0.35, double eye_up = 1.2) {
    const Material road = material_named("asphalt");
    const glm::dvec3 to_lamp{-d, -left, 0.65}, to_eye{-d - eye_back, eye_left - left, eye_up};
    const double square = d * d + left * left + 0.65 * 0.65;
    const double angle = std::acos((to_lamp.x * to_eye.x + to_lamp.y * to_eye.y + to_lamp.z * to_eye.z) /
                                   std::sqrt(square * (to_eye.x * to_eye.x + to_eye.y * to_eye.y + to_eye.z * to_eye.z)));
    return 0.08 / pi * cd * 0.65 / std::pow(square, 1.5) +
           static_cast<double>(road.retro_rl) * cd / square *
               std::exp((static_cast<double>(road.retro_reference_rad) - angle) / static_cast<double>(road.retro_falloff_rad));
}

} // namespace fernlicht
