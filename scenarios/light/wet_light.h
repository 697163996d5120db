// How a surface under a film of water returns light, in double: darker all round, and mirroring. As the shader does (photometry.glsl,
// wet_albedo and wet_mirrored), with the roughness of scene.h.
#pragma once

#include <glm/vec3.hpp>

namespace fernlicht {

/// Radiance as linear sRGB, cd/m2 for white light, of one source that gives `e_perp_lx` on a plane across its light. Unit vectors.
glm::dvec3 wet_light(const glm::dvec3& albedo, const glm::dvec3& normal, const glm::dvec3& to_light, const glm::dvec3& to_eye,
                     double e_perp_lx);

/// The same under the uniform sky, `e_lx` on the surface.
glm::dvec3 wet_sky_light(const glm::dvec3& albedo, const glm::dvec3& normal, const glm::dvec3& to_eye, double e_lx, double sky_cdm2);

/// Of a surface that gets wet, `wetness` 0..1 of it: the rest stays dry.
inline glm::dvec3 partly_wet(const glm::dvec3& dry, const glm::dvec3& wet, double wetness) { return (1.0 - wetness) * dry + wetness * wet; }

} // namespace fernlicht
