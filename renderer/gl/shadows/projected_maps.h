// Depth maps whose projections differ from frame to frame: each has a matrix of its own for look-ups, so that it can be drawn from another
// place than the lamp's, warped, or kept from an earlier frame.
// One depth map for all lamps, from midway between those that shine.
// The method `soft-map`: penumbrae of lamps that are discs facing along their axes, as the mean over maps from places on the disc.
#pragma once

#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/shadows/map_on_cpu.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <string>

namespace fernlicht::gl {

/// Every depth map from one place is a homography of the directions from there: x and y in the texture over w, depth = near / w, which
/// falls along every ray. A plain map has w = z along the lamp's axis; a warped one has a w that leans.
struct MapPlan {
    Pose from;                          ///< in the world
    glm::dmat3 texture_from_lamp{1.0};  ///< lamp space (x right, y up, z forward) to x, y, w; w >= z on what the lamp lights
    double spread = 0.0;                ///< what a look-up's point is raised by, per unit of w
    std::vector<std::uint32_t> pieces;  ///< drawn; ascending
    std::vector<Caster> bodies;         ///< of these pieces, in their order
    std::vector<glm::dvec3> to_cover{}; ///< in lamp space; empty: what texture_from_lamp was made for follows from the lamp's axes alone
    double max_raise = 0.0;             ///< over to_cover, as a tangent seen from the lamp
};

/// A map that is kept may raise what is looked up in it by so much more than the one that would be drawn.
inline constexpr double shadow_kept_slack = 1.25;

/// Over a window of tangents; the outermost texels lie outside it. w = z.
glm::dmat3 window_homography(const ShadowWindow& window, int width, int height);

/// What a point that faces anywhere is to be raised by, per unit of w, so that the surface behind it lies farther away in all texels that a
/// look-up weighs: three halves of the most that a texel spans on the plane of its depth (docs/decisions/0005).
double spread_of(const glm::dmat3& texture_from_lamp, int width, int height);

/// (x, y, w, raise) in the map of positions relative to `ego_m`; column vectors.
glm::dmat4 texture_from_ego(const MapPlan& plan, const glm::dvec3& ego_m);

/// Most by which a shadow's edge can have moved, as a tangent seen from the lamp, since it was drawn as `then`, with casters at rest;
/// infinite where that is not known.
double edge_shift(const MapPlan& then, const MapPlan& now);

/// As the base it is the method `map` with maps that are kept within a bound (ShadowSettings::redraw_texels).
class ProjectedMaps : public Shadows {
  public:
    /// `places`: on a lamp's face, metres right and up, one map from each; where there are several, they are averaged.
    ProjectedMaps(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, std::vector<glm::dvec2> places = {{}});

    void set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) final;
    void draw(const Shot& shot) override;
    void compile(const Shot& shot) override;
    std::vector<Program::Define> defines(const std::vector<const Beam*>& beams) const override;
    void set_uniforms(const Program& program) const override;
    std::span<const ShadowLookUp> look_ups() override;
    bool has_look_ups() const override { return true; }
    std::size_t texture_bytes() const override;
    const char* title() const override { return "shadow maps"; }

  protected:
    /// Fills casters_.
    virtual void choose_casters(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m);
    /// One for each of casters_.lamps().
    virtual std::vector<MapPlan> plan(const Shot& shot);
    /// A plain map over the lamp's window, as wide as it must be to be kept.
    MapPlan plain(const LampCasters& lamp) const;
    /// In texels of a plain map as wide as the lamp's window: what an edge may move by while a map is kept.
    double kept_tangent(const LampCasters& lamp) const;

  private:
    struct Kept {
        Texture texture;
        MapPlan plan;
        bool drawn = false;
        std::vector<std::pair<glm::dvec3, glm::vec4>> placed; ///< origin and turn of each piece
        std::uint64_t scene_placed = 0;
        glm::dvec3 ego_m{0.0};
        Texture target_texture; ///< with ground where it is, for targets; only where it is asked for and ground casts
        bool target_drawn = false, target_apart = false;
        MapOnCpu on_cpu, target_on_cpu;
        bool on_cpu_stands = false, target_on_cpu_stands = false; ///< what is drawn is read back
    };
    std::string name_of(std::size_t lamp) const;
    bool stands(const Kept& kept, const MapPlan& plan, const LampCasters& lamp) const;
    void draw_map(const Kept& kept, GLuint texture, double ground_lowered, const Shot& shot);
    Texture make_map() const;
    bool layered() const { return places_.size() > 1; }

    std::vector<glm::dvec2> places_;
    DepthPass pass_;
    std::map<std::string, Kept> kept_; ///< by the lamps' names
    std::vector<LitLamp> lamps_;
    std::vector<glm::dmat4> textures_from_ego_; ///< one a map
    std::vector<glm::mat4> from_lamps_;
    std::vector<ShadowLookUp> look_ups_;
};

/// Every lamp's shadows fall as from midway, which is a parallax: behind a caster at z_c, at z, an edge lies (z / z_c - 1) times the lamp's
/// distance from midway beside where it belongs.
class OneMap : public ProjectedMaps {
  public:
    using ProjectedMaps::ProjectedMaps;

    std::vector<Program::Define> defines(const std::vector<const Beam*>& beams) const override;

  protected:
    void choose_casters(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) override;
};

/// Midway between the lamps that shine, along the mean of their axes; the first lamp where none does.
LitLamp midway(const std::vector<LitLamp>& lamps);

/// Tangents seen from `from` that hold all that the lamps' windows hold from so far on.
ShadowWindow window_over(const LitLamp& from, const std::vector<LitLamp>& lamps, const std::vector<ShadowWindow>& windows, double from_m);

/// `count` places on a disc, each standing for the same area: a sunflower's seeds (Vogel 1979), r = radius sqrt((k + 1/2) / count) at k
/// times the golden angle. The same for every lamp and frame.
std::vector<glm::dvec2> places_on_disc(double radius_m, int count);

/// The share of `lamp_places` places that a surface sees, which converges to the share of the disc; the light itself keeps coming from the
/// disc's centre.
class SoftMaps : public ProjectedMaps {
  public:
    SoftMaps(Context& context, const SceneBuffers& scene, const ShadowSettings& settings)
        : ProjectedMaps(context, scene, settings, places_on_disc(settings.lamp_radius_m, settings.lamp_places)) {}

  protected:
    void choose_casters(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) override;
};

} // namespace fernlicht::gl
