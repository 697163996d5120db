// The colour of retroreflected light.
#pragma once

#include "scenarios/values/scene.h"

namespace fernlicht {

/// By what a material's retroreflected light is multiplied, channel by channel of linear sRGB: its retro_rgb at the scale at which light of
/// standard illuminant A (2856 K) keeps its luminance, since R_A and R_L are measured in that light (CIE 54.2, EN 1436, UN R3). In bluer
/// light a red reflector then returns less than its R_A says. A channel is at most some 4. Exactly 1 for a colour without hue. Three
/// channels stand for the spectrum: a filter's true loss in other light differs by a few per cent.
glm::dvec3 retro_tint(const Material& material);

/// Returned light has another colour than the lamp's.
inline bool is_tinted(const Material& material) {
    return material.retro_rl > 0.0F && (material.retro_rgb.r != material.retro_rgb.g || material.retro_rgb.r != material.retro_rgb.b);
}

} // namespace fernlicht
