// How a surface returns light at the place where a ray met it: its material with the texture applied, in double.
#pragma once

#include "renderer/reference/embree_scene.h"

#include <glm/vec4.hpp>

namespace fernlicht::reference {

struct SurfaceResponse {
    glm::dvec3 albedo{0.0}; ///< linear sRGB reflectances, 0..1
    double retro_rl = 0.0;  ///< cd/(m2 lx) at the reference observation angle
    double retro_reference_rad = 0.0, retro_inverse_falloff = 0.0;
    glm::dvec3 emission_cdm2{0.0};
    bool gets_wet = false;
    glm::dvec3 retro_tint{1.0}; ///< of retroreflected light
};

/// A texture between its texels: bilinear, repeating, texel centres at (i + 0.5) / width, as OpenGL's GL_LINEAR. No mipmaps: the average
/// over a footprint is the average over its samples. 0..1.
glm::dvec4 texel_at(const SurfaceTexture& texture, const glm::dvec2& uv);

/// Equations of photometry.glsl (combined_reflectance, textured_rl).
SurfaceResponse response_at(const Scene& scene, const SurfaceHit& hit);

/// Luminance of linear sRGB.
inline double luminance(const glm::dvec3& rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

} // namespace fernlicht::reference
