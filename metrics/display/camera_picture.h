// What a camera stores of the light in front of it.
#pragma once

#include "scenarios/display/display_profile.h"
#include "scenarios/values/image.h"

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace fernlicht {

/// Codes of 8 bits. Light, linear in sRGB's primaries and Y in cd/m2, is spread by the lens (CameraSettings::bloom, as windscreen_scatter),
/// balanced by `white` (light_adaptation), and brings each channel saturation_e L / saturation_cdm2 electrons. To these comes a normal
/// deviate of the variance electrons + read_noise_e^2, shot and read noise; what is above saturation or below 0 is cut, the rest goes
/// through the tone curve. Same light and seed, same bytes.
Image<glm::u16vec3> camera_picture(const CameraSettings& camera, const Image<glm::vec3>& light, double vertical_fov_rad,
                                   const std::optional<glm::dmat3>& white, std::uint64_t seed);

/// Code, 0..1, without noise, for a share of saturation.
double camera_code(const CameraSettings& camera, double share);

} // namespace fernlicht
