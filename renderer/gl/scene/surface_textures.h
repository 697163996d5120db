// The pictures of surfaces as one array texture with mipmaps.
#pragma once

#include "renderer/gl/device/objects.h"
#include "scenarios/values/scene.h"

namespace fernlicht::gl {

inline constexpr GLuint surface_texture_unit = 15;

/// One layer a texture, in the order given, repeating, looked up by the context's surface_filter. `encoded`: texels go through the sRGB
/// curve. Nothing for no textures. Throws InputError when sizes differ or are no powers of two; `bytes` gets the memory taken.
Texture upload_surface_textures(Context& context, const std::vector<SurfaceTexture>& textures, bool encoded, std::size_t& bytes);

} // namespace fernlicht::gl
