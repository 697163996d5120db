#include "renderer/gl/scene/scene_buffers.h"

#include "scenarios/photometry.h"
#include "scenarios/values/errors.h"

#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht::gl {
namespace {

void check_sizes(const std::vector<SurfaceTexture>& textures) {
    const auto power_of_two = [](int n) { return n > 0 && std::has_single_bit(static_cast<unsigned>(n)); };
    for (const SurfaceTexture& t : textures) {
        const std::size_t bytes = std::size_t{4} * static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height);
        if (t.width != textures[0].width || t.height != textures[0].height || !power_of_two(t.width) || !power_of_two(t.height) ||
            t.rgba.size() != bytes)
            throw InputError({{}, 0, 0, t.name}, fmt::format("found {} x {} texels in {} bytes", t.width, t.height, t.rgba.size()),
                             fmt::format("powers of two, the size of the first texture ({} x {}), 4 bytes a texel", textures[0].width,
                                         textures[0].height));
    }
}

std::array<std::uint8_t, 256> srgb_curve() {
    std::array<std::uint8_t, 256> curve{};
    for (std::size_t i = 0; i < curve.size(); ++i)
        curve[i] = static_cast<std::uint8_t>(std::lround(255.0 * photometry::srgb_encoded(static_cast<double>(i) / 255.0)));
    return curve;
}

void set_filter(const GladGLContext& gl, GLuint texture, SurfaceFilter filter) {
    const GLint smaller = filter == SurfaceFilter::none        ? GL_NEAREST
                          : filter == SurfaceFilter::trilinear ? GL_LINEAR_MIPMAP_LINEAR
                                                               : GL_LINEAR_MIPMAP_NEAREST;
    gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, smaller);
    gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, filter == SurfaceFilter::none ? GL_NEAREST : GL_LINEAR);
}

} // namespace

Texture upload_surface_textures(Context& context, const std::vector<SurfaceTexture>& textures, bool encoded, std::size_t& bytes) {
    bytes = 0;
    if (textures.empty())
        return {};
    check_sizes(textures);
    const GladGLContext& gl = context.gl;
    const int width = textures[0].width, height = textures[0].height;
    const auto levels = static_cast<GLsizei>(std::bit_width(static_cast<unsigned>(std::max(width, height))));
    Texture array = new_texture(context, GL_TEXTURE_2D_ARRAY);
    gl.TextureStorage3D(array, levels, GL_RGBA8, width, height, static_cast<GLsizei>(textures.size()));
    set_filter(gl, array, context.surface_filter);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const std::array<std::uint8_t, 256> curve = srgb_curve();
    for (std::size_t layer = 0; layer < textures.size(); ++layer) {
        std::vector<std::uint8_t> texels = textures[layer].rgba;
        for (std::size_t i = 0; encoded && i < texels.size(); ++i)
            if (i % 4 != 3)
                texels[i] = curve[texels[i]];
        gl.TextureSubImage3D(array, 0, 0, 0, static_cast<GLint>(layer), width, height, 1, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    }
    gl.GenerateTextureMipmap(array);
    bytes = std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * textures.size() * 4 / 3;
    context.check("uploading surface textures");
    return array;
}

} // namespace fernlicht::gl

void fernlicht::use_surface_filter(Device& device, SurfaceFilter filter) { device.context().surface_filter = filter; }
