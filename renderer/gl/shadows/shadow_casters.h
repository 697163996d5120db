// What can cast a shadow in each lamp's light, and on what: what stands on the ground, the far side of crests, bridges.
//
// Ground that faces the lamp casts no shadow: light that passes through such a sheet comes out of it again only through a part that
// faces away, which is drawn, or at a bridge, which is drawn too.
#pragma once

#include "renderer/gl/scene/beams.h"
#include "renderer/gl/scene/scene_buffers.h"
#include "scenarios/drives/shadow_settings.h"

#include <map>

namespace fernlicht::gl {

inline constexpr double shadow_near_m = 0.05;
inline constexpr double shadow_farthest_m = 300.0;
/// A shadow counts while the lamp's light on a surface facing it, without the shadow, is at least this: the beam's last contour.
inline constexpr double last_contour_lx = 0.01;

/// Receivers are looked up from points raised by the tolerance.
inline constexpr double shadow_slack_m = 0.05;

/// From positions relative to the car to a lamp's window, depth = shadow_near_m / z.
glm::dmat4 lamp_clip(const LitLamp& lamp, const ShadowWindow& window, const glm::dvec3& ego_m);

/// Largest distance between texel centres of a lamp's map as a tangent; the outermost texels lie outside the window.
double texel_tangent(const ShadowWindow& window, const ShadowSettings& settings);

/// A body as a lamp sees it: tangents in lamp space, with a margin, and where it begins.
struct Caster {
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
    double nearest_m = 0.0; ///< along the lamp's axis
    bool around = false;    ///< some of it lies beside or behind the lamp: no tangents of its own
};
/// Moves all four sides of a caster or window outwards.
template <class Sides> void widen(Sides& sides, double tangent) {
    sides.left -= tangent;
    sides.right += tangent;
    sides.bottom -= tangent;
    sides.top += tangent;
}
/// Boxes in lamp space. `margin`: added to the tangents.
Corners in_lamp_space(const LitLamp& lamp, const glm::dvec3& offset_from_lamp, const Corners& corners);
Caster caster_of(const Corners& box, double margin);
/// Whether the caster's shadow may fall on the box, or so far beside it. Errs towards yes.
bool shades(const Caster& caster, const Corners& box, double slack_m = shadow_slack_m);
/// Where what of these triangles, three places each in lamp space, lies in the window begins, along the lamp's axis; infinite where
/// nothing does.
double begins_in_window(const std::vector<glm::dvec3>& triangles, const ShadowWindow& window);
/// In texels of the map, for look-ups raised by 1.5: they take texels up to 1 away.
inline constexpr double caster_margin_texels = 2.6;

/// Whether all triangles of the ground face a lamp, which stands there relative to the car: it casts no shadow then.
bool faces_lamp(const SceneBuffers& scene, const Piece& piece, const glm::dvec3& lamp_m, const glm::dvec3& ego_m);

struct LampCasters {
    LitLamp lamp;
    glm::dvec3 lamp_m{0.0}; ///< relative to the car
    ShadowWindow window;
    glm::dmat4 clip{1.0};              ///< lamp_clip()
    std::vector<std::uint32_t> pieces; ///< ascending
    bool ground = false;               ///< is among them
    std::vector<Caster> bodies;
    double slack_m = shadow_slack_m; ///< by which a receiver may lie beside where it is
};

class ShadowCasters {
  public:
    /// Methods that draw no map have no window: whatever the beam reaches casts.
    ShadowCasters(const SceneBuffers& scene, const ShadowSettings& settings);

    void set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m);
    /// One lamp in place of all that shine: what any of them has of pieces, seen from there. `window`: of the map from there.
    void merge(const LitLamp& lamp, const ShadowWindow& window);
    /// Shadows of one lamp may reach so far beside where reach() would have them: as a tangent seen from the lamp.
    void widen(std::size_t lamp, double tangent);
    /// Every lamp is a disc of this radius, so that shadows have penumbrae.
    void soften(double radius_m);
    const std::vector<LampCasters>& lamps() const { return lamps_; }
    const glm::dvec3& ego_m() const { return ego_m_; }
    /// Whether anything casts a shadow.
    bool any() const;
    /// Whether a shadow of any lamp may fall on the piece, or on targets so high above it. Errs towards yes.
    bool reach(const Piece& piece, double raised_m) const;

  private:
    void add_bodies(LampCasters& found);
    double begins_in(const LampCasters& lamp, std::uint32_t piece, const ShadowWindow& window);

    const SceneBuffers& scene_;
    ShadowSettings settings_;
    bool windowed_;
    std::vector<LampCasters> lamps_;
    glm::dvec3 ego_m_{0.0};
    std::map<std::uint32_t, std::vector<glm::vec3>> corners_; ///< of pieces about the lamps
};

} // namespace fernlicht::gl
