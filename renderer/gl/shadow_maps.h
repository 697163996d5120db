// Depth as each lamp sees it, of what can cast a shadow: what stands on the ground, the far side of crests, bridges.
//
// Ground that faces the lamp casts no shadow: light that passes through such a sheet comes out of it again only through a part that
// faces away, which is drawn, or at a bridge, which is drawn too. Receivers are looked up from a point raised above their surface by
// what a texel spans there (docs/decisions/0005), so that nothing shades itself.
#pragma once

#include "renderer/gl/beams.h"
#include "renderer/gl/draw_list.h"
#include "renderer/gl/pass_clock.h"
#include "renderer/gl/program.h"
#include "renderer/renderer.h"

namespace fernlicht::gl {

inline constexpr double shadow_near_m = 0.05;
inline constexpr double shadow_farthest_m = 300.0;
/// A shadow counts while the lamp's light on a surface facing it, without the shadow, is at least this: the beam's last contour.
inline constexpr double last_contour_lx = 0.01;
inline constexpr GLuint first_shadow_unit = 8;

struct ShadowSize {
    int width = 1024, height = 512;
};

/// From positions relative to the car to a lamp's window, depth = shadow_near_m / z.
glm::dmat4 lamp_clip(const LitLamp& lamp, const ShadowWindow& window, const glm::dvec3& ego_m);

/// Largest distance between texel centres as a tangent.
double texel_tangent(const ShadowWindow& window, const ShadowSize& size);

class ShadowMaps {
  public:
    ShadowMaps(Context& context, const SceneBuffers& scene, ShadowSize size);

    /// Chooses the casters of each lamp.
    void set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m);
    /// Whether anything casts a shadow.
    bool needed() const;
    /// Whether a shadow of any lamp may fall on the piece, or on targets so high above it. Errs towards yes.
    bool reach(const Piece& piece, double raised_m) const;
    /// Draws the maps unless they stand already as they would be drawn, and binds them.
    void draw(Work& work);
    void compile();

    std::size_t texture_bytes() const;

  private:
    struct Caster { ///< a body as a lamp sees it: tangents in lamp space, with a margin, and where it begins
        double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
        double nearest_m = 0.0; ///< along the lamp's axis
        bool around = false;    ///< some of it lies beside or behind the lamp: no tangents
    };
    struct Map {
        LitLamp lamp;
        glm::dvec3 lamp_m{0.0}; ///< relative to the car
        glm::dmat4 clip{1.0};
        std::vector<std::uint32_t> pieces;
        std::vector<Caster> casters;
    };
    static Caster caster_of(const Corners& in_lamp_space, double margin);
    static bool shades(const Caster& caster, const Corners& in_lamp_space);
    bool faces_lamp(const Piece& piece, const glm::dvec3& lamp_m) const;

    Context& context_;
    const SceneBuffers& scene_;
    ShadowSize size_;
    Program program_;
    GLint matrix_;
    DrawList list_;
    Framebuffer target_;
    std::vector<Texture> textures_;
    std::vector<Map> maps_;
    glm::dvec3 ego_m_{0.0};
    std::vector<glm::dmat4> drawn_clips_; ///< what the textures hold
    std::vector<std::vector<std::uint32_t>> drawn_pieces_;
    glm::dvec3 drawn_ego_m_{0.0};
    std::uint64_t drawn_placed_ = 0;
};

} // namespace fernlicht::gl
