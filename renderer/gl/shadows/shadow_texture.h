// The depth textures of shadow maps.
#pragma once

#include "renderer/gl/device/objects.h"

#include <string>

namespace fernlicht::gl {

struct ShadowTextureAsked {
    int width = 0, height = 0; ///< texels
    int layers = 0;            ///< maps in an array of textures; 0: one map, a plain texture
    std::string owner;         ///< "each lamp by 'map'"
    std::string smaller;       ///< what takes less: "a smaller map_texels"
};
/// Depths that are compared while they are looked up. Throws ShadowMemoryError where the driver has no room for them.
Texture make_shadow_texture(Context& context, const ShadowTextureAsked& asked);

} // namespace fernlicht::gl
