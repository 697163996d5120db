#include "renderer/gl/shadows/map_on_cpu.h"

#include <algorithm>

namespace fernlicht::gl {

TexelBox drawn_texels(const LampCasters& lamp, const ShadowSettings& settings) {
    const ShadowWindow& w = lamp.window;
    TexelBox box{settings.width, 0, settings.height, 0};
    for (const Caster& c : lamp.bodies) {
        const auto texel = [](double tangent, double low, double high, int texels) {
            return 1.0 + (std::clamp(tangent, low, high) - low) / (high - low) * (texels - 2);
        };
        const bool all = c.around;
        box.left = std::min(box.left, static_cast<int>(texel(all ? w.left : c.left, w.left, w.right, settings.width)));
        box.right = std::max(box.right, 1 + static_cast<int>(texel(all ? w.right : c.right, w.left, w.right, settings.width)));
        box.bottom = std::min(box.bottom, static_cast<int>(texel(all ? w.bottom : c.bottom, w.bottom, w.top, settings.height)));
        box.top = std::max(box.top, 1 + static_cast<int>(texel(all ? w.top : c.top, w.bottom, w.top, settings.height)));
    }
    box.right = std::min(box.right, settings.width);
    box.top = std::min(box.top, settings.height);
    return box.left < box.right && box.bottom < box.top ? box : TexelBox{};
}

void MapOnCpu::read(Context& context, GLuint texture, const ShadowSettings& settings, int layers, const TexelBox& drawn) {
    width_ = settings.width;
    height_ = settings.height;
    const std::size_t row = static_cast<std::size_t>(width_), map = row * static_cast<std::size_t>(height_);
    texels_.resize(map * static_cast<std::size_t>(layers));
    const GladGLContext& gl = context.gl;
    const int columns = drawn.right - drawn.left, rows = drawn.top - drawn.bottom;
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, width_);
    for (int layer = 0; layer < layers; ++layer) {
        float* const texels = texels_.data() + map * static_cast<std::size_t>(layer);
        for (int y = box_.bottom; y < box_.top; ++y)
            std::fill_n(texels + row * static_cast<std::size_t>(y) + box_.left, box_.right - box_.left, 0.0F);
        const std::size_t first = row * static_cast<std::size_t>(drawn.bottom) + static_cast<std::size_t>(drawn.left);
        if (columns > 0 && rows > 0)
            gl.GetTextureSubImage(texture, 0, drawn.left, drawn.bottom, layer, columns, rows, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                                  static_cast<GLsizei>((map - first) * sizeof(float)), texels + first);
    }
    gl.PixelStorei(GL_PACK_ROW_LENGTH, 0);
    box_ = drawn;
    context.check("reading a shadow map");
}

void MapOnCpu::tell(ShadowLookUp& look_up) const {
    look_up.width = width_;
    look_up.height = height_;
    look_up.depth = texels_.data();
    // Texels floor(x) and the next are looked up.
    const double box[4] = {box_.left - 1.001, static_cast<double>(box_.right), box_.bottom - 1.001, static_cast<double>(box_.top)};
    std::ranges::copy(box, look_up.box);
}

} // namespace fernlicht::gl
