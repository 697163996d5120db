// Closed hulls counted into the stencil buffer behind each pixel's surface (z-fail: W. Heidmann 1991 counted before it; J. Carmack, and
// B. Everitt and M. Kilgard 2002, behind it): a pixel's count is the number of hulls that its surface lies in, also where the camera lies
// in one. The depth buffer is reversed (1 near, 0 at infinity, test GREATER), so that what lies behind a surface fails the test as ever.
#pragma once

#include "renderer/gl/device/objects.h"
#include "renderer/gl/device/program.h"
#include "scenarios/drives/play/camera.h"

namespace fernlicht::gl {

class StencilVolumes {
  public:
    explicit StencilVolumes(Context& context);

    /// Where hulls lie and which lamp they belong to.
    struct Placed {
        glm::dvec3 offset_m{0.0};               ///< of their frame from the car
        glm::vec4 turn{0.0F, 0.0F, 0.0F, 1.0F}; ///< quaternion
        glm::dvec3 lamp_m{0.0};                 ///< relative to the car
        double gap_m = 0.0, gap_share = 0.0;    ///< by which near corners are moved away from the lamp, in metres and of the distance
        double lowered_m = 0.0;                 ///< by which all of it lies lower
        std::size_t first = 0, count = 0;       ///< corners, of those uploaded
    };
    /// Triangles, three corners each: w = 1 as it stands, w = 0 moved away from the lamp to infinity. All hulls of an upload must be turned
    /// the same way round, inwards or outwards.
    void upload(const std::vector<glm::vec4>& corners);
    /// Sets stencil operations and culling for what follows, in the view of the camera.
    void begin(const Camera& camera) const;
    void draw(const Placed& placed) const;
    void end() const;

  private:
    Context& context_;
    Program program_;
    GLint clip_, offset_, turn_, lamp_, gap_, farthest_;
    VertexArray layout_;
    Buffer corners_;
    std::size_t capacity_ = 0;
};

} // namespace fernlicht::gl
