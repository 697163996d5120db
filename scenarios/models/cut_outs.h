// Leaves, fences and other surfaces with holes in their pictures' opacity: cut out of their triangles, so that light, shadow, picture and
// reference all meet the same shape.
#pragma once

#include "scenarios/models/triangle_soup.h"

namespace fernlicht {

class CutOuts {
  public:
    /// A triangle of the soup: nothing is where texture `texture` (-1: everywhere opaque) has less opacity than `level` / 256.
    struct Cut {
        std::size_t triangle;
        int texture, level;
    };
    void add(const Cut& cut) { cuts_.push_back(cut); }

    /// Cuts them, into pieces down to 2 cm or a texel; all of them into half a million more at most. Whether anything was cut
    /// away.
    bool apply(TriangleSoup& soup, const std::vector<SurfaceTexture>& textures);

  private:
    std::vector<Cut> cuts_;
};

} // namespace fernlicht
