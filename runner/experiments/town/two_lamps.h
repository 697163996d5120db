// A moment at night with two lamps on a car and nothing else: for models, which come without a drive.
#pragma once

#include "scenarios/drives/play/moment.h"

#include <glm/mat3x3.hpp>
#include <optional>
#include <string>

namespace fernlicht {

inline constexpr double two_lamps_x_m = 3.6, two_lamps_y_m = 0.6, two_lamps_z_m = 0.65; ///< in the car's frame, the right one at -y

/// The driver's eye, in the car's frame.
inline const glm::dvec3 two_lamps_eye_m{1.3, 0.35, 1.2};

/// `lamp`: a lamp's file, or one of our models (halogen-low, halogen-high, xenon-low, xenon-high); 3200 K, or 4300 K of xenon. Throws
/// InputError naming --lamp.
Moment in_two_lamps(const std::string& lamp, const Pose& car);

/// What an eye adapted to these lamps at night makes of light, as in a run's pictures: for RendererSettings::white.
std::optional<glm::dmat3> white_of(const Moment& in_two_lamps);

} // namespace fernlicht
