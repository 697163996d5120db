// Illuminance at a point from the lamps of a moment, by the candela tables themselves, in double: what rendered lux images are
// measured against. The air takes its share. There are no shadows here;
// callers that need them bring their own visibility.
// The colour of retroreflected light.
// How a surface under a film of water returns light, in double: darker all round, and mirroring. As the shader does (photometry.glsl,
// wet_albedo and wet_mirrored), with the roughness of scene.h.
#pragma once

#include "scenarios/drives/play/moment.h"
#include "scenarios/values/scene.h"

#include <glm/vec3.hpp>

namespace fernlicht {

/// Where in the lamp's own angles a world point lies; nullopt behind it.
std::optional<TwoAngles> angles_from(const LitLamp& lamp, const glm::dvec3& point_m);

/// Intensity in cd of the lamp towards a world point; 0 behind, outside its table, or switched off.
double intensity_towards_cd(const LitLamp& lamp, const glm::dvec3& point_m);

/// Of the uniform sky, and of sun or moon where one shines, on a surface of unit `normal`. lx.
double daylight_illuminance_lx(const Daylight& daylight, const glm::dvec3& normal);

/// E = I cos(alpha) / d^2 on a surface of unit `normal`, light of sky, sun and moon included. lx.
double surface_illuminance_lx(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal);

/// Sum over the lamps of I / d^2: a target that faces each lamp. lx. No sky. A lamp gives nothing at its own place.
double target_illuminance_lx(const Moment& moment, const glm::dvec3& point_m);

/// By what a material's retroreflected light is multiplied, channel by channel of linear sRGB: its retro_rgb at the scale at which light of
/// standard illuminant A (2856 K) keeps its luminance, since R_A and R_L are measured in that light (CIE 54.2, EN 1436, UN R3). In bluer
/// light a red reflector then returns less than its R_A says. A channel is at most some 4. Exactly 1 for a colour without hue. Three
/// channels stand for the spectrum: a filter's true loss in other light differs by a few per cent.
glm::dvec3 retro_tint(const Material& material);

/// Returned light has another colour than the lamp's.
inline bool is_tinted(const Material& material) {
    return material.retro_rl > 0.0F && (material.retro_rgb.r != material.retro_rgb.g || material.retro_rgb.r != material.retro_rgb.b);
}

/// Radiance as linear sRGB, cd/m2 for white light, of one source that gives `e_perp_lx` on a plane across its light. Unit vectors.
glm::dvec3 wet_light(const glm::dvec3& albedo, const glm::dvec3& normal, const glm::dvec3& to_light, const glm::dvec3& to_eye,
                     double e_perp_lx);

/// The same under the uniform sky, `e_lx` on the surface.
glm::dvec3 wet_sky_light(const glm::dvec3& albedo, const glm::dvec3& normal, const glm::dvec3& to_eye, double e_lx, double sky_cdm2);

/// The facets that a glossy surface shows while it is dry.
struct Facets {
    double share = 0.0, roughness = 0.5; ///< of the surface, 0..1; GGX alpha
};
inline Facets facets_of(const Material& material) {
    return {static_cast<double>(material.gloss), static_cast<double>(material.gloss_roughness)};
}
/// What they mirror of one source, cd/m2 as wet_light(); 0 without facets.
double gloss_light(const Facets& facets, const glm::dvec3& normal, const glm::dvec3& to_light, const glm::dvec3& to_eye, double e_perp_lx);
/// And of the uniform sky.
double gloss_sky_light(const Facets& facets, const glm::dvec3& normal, const glm::dvec3& to_eye, double sky_cdm2);

/// Of a surface that gets wet, `wetness` 0..1 of it: the rest stays dry.
inline glm::dvec3 partly_wet(const glm::dvec3& dry, const glm::dvec3& wet, double wetness) { return (1.0 - wetness) * dry + wetness * wet; }

} // namespace fernlicht
