#include "renderer/gl/device/objects.h"

#include "scenarios/values/errors.h"

#include <fmt/format.h>

namespace fernlicht::gl {

Buffer make_buffer(Context& context, std::span<const std::byte> bytes, GLbitfield flags) {
    GLuint name = 0;
    context.gl.CreateBuffers(1, &name);
    Buffer buffer(context, name);
    const std::byte nothing{};
    if (bytes.empty())
        bytes = {&nothing, 1};
    context.gl.NamedBufferStorage(name, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), flags);
    context.check("making a buffer");
    return buffer;
}

Buffer make_read_buffer(Context& context, std::size_t bytes) {
    GLuint name = 0;
    context.gl.CreateBuffers(1, &name);
    Buffer buffer(context, name);
    context.gl.NamedBufferStorage(name, static_cast<GLsizeiptr>(bytes > 0 ? bytes : 1), nullptr, GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT);
    context.check("making a read buffer");
    return buffer;
}

Texture new_texture(Context& context, GLenum target) {
    GLuint name = 0;
    context.gl.CreateTextures(target, 1, &name);
    return {context, name};
}

Texture make_texture(Context& context, GLenum internal_format, int width, int height) {
    GLint limit = 0;
    context.gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width < 1 || height < 1 || width > limit || height > limit)
        throw DeviceError(fmt::format("{} renders at most {} x {} pixels, {} x {} were asked for", context.info.gl_renderer, limit, limit,
                                      width, height));
    Texture texture = new_texture(context, GL_TEXTURE_2D);
    context.gl.TextureStorage2D(texture, 1, internal_format, width, height);
    context.gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    context.gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    context.gl.TextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    context.gl.TextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    context.check("making a texture");
    return texture;
}

VertexArray make_vertex_array(Context& context) {
    GLuint name = 0;
    context.gl.CreateVertexArrays(1, &name);
    return {context, name};
}

Framebuffer make_framebuffer(Context& context) {
    GLuint name = 0;
    context.gl.CreateFramebuffers(1, &name);
    return {context, name};
}

} // namespace fernlicht::gl
