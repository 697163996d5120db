// Shadows decided in picture space: before a view is drawn, each of its pixels gets one bit a lamp for its surface and one for a target
// raised above it, set where the lamp is hidden. What is hidden a method says by the stencil buffer, lamp by lamp.
//
// Closed hulls counted into the stencil buffer behind each pixel's surface (z-fail: W. Heidmann 1991 counted before it; J. Carmack, and
// B. Everitt and M. Kilgard 2002, behind it): a pixel's count is the number of hulls that its surface lies in, also where the camera lies
// in one. The depth buffer is reversed (1 near, 0 at infinity, test GREATER), so that what lies behind a surface fails the test as ever.
#pragma once

#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/shadows/shadows.h"

#include <list>

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
    VertexArray layout_;
    Buffer corners_;
    std::size_t capacity_ = 0;
};

class ShadowMask : public Shadows {
  public:
    ShadowMask(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use);

    void set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) override;
    void draw(const Shot& shot) override;
    void compile(const Shot& shot) override;
    std::vector<Program::Define> defines(const std::vector<const Beam*>& beams) const override;
    std::size_t texture_bytes() const override;

  protected:
    /// In the stencil buffer: of pixels that show ground. The bits below are 0 before mark_hidden() and count what it likes.
    static constexpr GLuint ground_bit = 0x80, count_bits = 0x7F;

    /// Whether shadows fall on ground alone. If not, ground_bit is 0 everywhere and counts have eight bits.
    virtual bool only_on_ground() const = 0;
    /// Draws into the stencil buffer so that pixels where the lamp with this number is hidden end with a count other than 0. Colour and
    /// depth cannot be written. `raised_m`: seen from points so far above the surfaces.
    virtual void mark_hidden(const Shot& shot, std::size_t lamp, double raised_m) = 0;
    /// Prepares what mark_hidden() draws with, before the first of a picture; passes begin with "shadow ...".
    virtual void before_marking(const Shot& /*shot*/) {}
    virtual const char* pass_title() const = 0;
    /// The same for all lamps: mark_hidden() is called for the first alone.
    virtual bool one_for_all_lamps() const { return false; }
    virtual bool hides_any(std::size_t lamp) const = 0;

    /// All of set() that a method needs which chooses its casters itself.
    void set_lamps(const std::vector<LitLamp>& lamps, const glm::dvec3& ego_m);
    const glm::dvec3& ego_m() const { return ego_m_; }

  private:
    struct Canvas {
        int width, height;
        Texture mask, depth;
        Framebuffer framebuffer;
    };
    Canvas make_canvas(int width, int height);
    const Canvas& canvas_for(const View& view);
    void draw_depth(const Shot& shot);
    void set_bits(GLuint bits) const;

    ShadowUse use_;
    Program depth_program_, mask_program_;
    VertexArray nothing_;
    DrawList list_;
    std::list<Canvas> canvases_; ///< of the sizes that shadows were drawn in; used last stands first
    std::vector<LitLamp> lamps_;
    glm::dvec3 ego_m_{0.0};
};

} // namespace fernlicht::gl
