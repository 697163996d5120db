// Pictures of models on their way into a scene: linear, powers of two, one size for all.
#pragma once

#include "scenarios/values/scene.h"

namespace fernlicht {

/// `rgba` of width x height texels, sRGB-encoded colours with linear opacity, made linear and brought to the powers of two nearest to its
/// sides, at most `max_px`. Means of reflectance are kept to the rounding of 8 bits. Sizes of at least 1.
SurfaceTexture surface_texture(std::string name, int width, int height, const std::vector<std::uint8_t>& rgba, int max_px);

/// Brings all textures of a scene to the largest width and height among them, by repeating texels: means and, from the first mipmap on,
/// what is looked up stay what they are. Nothing changes where they have one size already.
void unify_texture_sizes(Scene& scene);

} // namespace fernlicht
