// Shadow maps for the CPU's light.
#pragma once

#include "renderer/gl/shadows/shadows.h"

namespace fernlicht::gl {

/// Columns and rows of a map, from the first to before the end.
struct TexelBox {
    int left = 0, right = 0, bottom = 0, top = 0;
};

/// A depth texture's texels, read back where something is drawn; 0 elsewhere.
class MapOnCpu {
  public:
    void read(Context& context, GLuint texture, const ShadowSettings& settings, int layers, const TexelBox& drawn);
    void tell(ShadowLookUp& look_up) const; ///< size, texels and box
    const float* depth() const { return texels_.data(); }

  private:
    std::vector<float> texels_;
    int width_ = 0, height_ = 0;
    TexelBox box_;
};

/// Where the bodies of a plain map lie, their margin included.
TexelBox drawn_texels(const LampCasters& lamp, const ShadowSettings& settings);

} // namespace fernlicht::gl
