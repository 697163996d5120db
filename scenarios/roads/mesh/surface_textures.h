// Pictures for the surfaces of a road scene, drawn by formula.
#pragma once

#include "scenarios/values/scene.h"

#include <cstdint>
#include <vector>

namespace fernlicht {

/// Texels along each side of every texture here. With mesh_builder.h's texture_repeat_m that is 31 mm a texel.
constexpr int road_texture_px = 256;

/// asphalt (mean level 128), concrete (190) and grass (112 of 255) are to modulate: R, G and B each have exactly that mean, so that no
/// mipmap needs to round it. paint-wear is a decal: the colour of bare asphalt everywhere, opaque where paint is gone; as the colour
/// does not vary, averaging it apart from the opacity, as mipmaps do, averages the reflectance. All repeat without a seam, and averages
/// over 0.5 m of the first three differ by 2 to 6 % (rms): from afar nothing shows the repetition. The same seed gives the same bytes.
std::vector<SurfaceTexture> road_textures(std::uint64_t seed);

/// Mean reflectance of a surface of colour `own` under the texture. `blend_colour` counts for blend only.
glm::dvec3 mean_reflectance(const SurfaceTexture& texture, TextureMode mode, const glm::dvec3& own, const glm::dvec3& blend_colour);

/// Gives the materials of build_scene (road_materials()) their textures: asphalt; concrete and objects; verge and terrain; both kinds of
/// paint. Albedo and retro_rl become such that their means over a repetition are what they were.
void add_road_textures(Scene& scene, std::uint64_t seed);

} // namespace fernlicht
