#include "renderer/gl/shadows/shadow_texture.h"

#include "renderer/shadow_memory.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace fernlicht::gl {
namespace {

/// Throws ShadowMemoryError where making the texture failed; what the driver noted of it is taken away, for what is drawn next.
void check_room(Context& context, const ShadowTextureAsked& asked) {
    std::string said = std::exchange(context.last_error, {});
    while (const GLenum error = context.gl.GetError())
        said = said.empty() ? fmt::format("OpenGL error 0x{:04x}", error) : said;
    if (said.empty())
        return;
    const int maps = std::max(asked.layers, 1);
    throw ShadowMemoryError(
        fmt::format("shadows: found {} of {} x {} texels for {}, {:.0f} MiB, for which {} has no room ({}), expected {}",
                    maps == 1 ? "a map" : fmt::format("{} maps", maps), asked.width, asked.height, asked.owner,
                    4.0 * asked.width * asked.height * maps / (1 << 20), context.info.gl_renderer, said, asked.smaller));
}

} // namespace

Texture make_shadow_texture(Context& context, const ShadowTextureAsked& asked) {
    const GladGLContext& gl = context.gl;
    GLint limit = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (std::max(asked.width, asked.height) > limit)
        throw ShadowMemoryError(fmt::format("shadows: found a map of {} x {} texels for {}, expected at most {} each way (map_texels), "
                                            "which {} draws",
                                            asked.width, asked.height, asked.owner, limit, context.info.gl_renderer));
    context.check("drawing before a shadow map was made");
    GLuint name = 0;
    gl.CreateTextures(asked.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 1, &name);
    Texture texture(context, name);
    if (asked.layers > 0)
        gl.TextureStorage3D(name, 1, GL_DEPTH_COMPONENT32F, asked.width, asked.height, asked.layers);
    else
        gl.TextureStorage2D(name, 1, GL_DEPTH_COMPONENT32F, asked.width, asked.height);
    check_room(context, asked);
    gl.TextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TextureParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    context.check("making a shadow map");
    return texture;
}

} // namespace fernlicht::gl
