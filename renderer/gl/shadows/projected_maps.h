// Depth maps whose projections differ from frame to frame: each is looked up by a matrix of its own, so that it can be drawn from another
// place than the lamp's, warped, or kept from an earlier frame.
#pragma once

#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/shadows/map_plan.h"
#include "renderer/gl/shadows/shadows.h"

#include <glm/vec2.hpp>
#include <string>

namespace fernlicht::gl {

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
    };
    std::string name_of(std::size_t lamp) const;
    bool stands(const Kept& kept, const MapPlan& plan, const LampCasters& lamp) const;
    void draw_map(Kept& kept, const Shot& shot);
    Texture make_map() const;
    bool layered() const { return places_.size() > 1; }

    std::vector<glm::dvec2> places_;
    Program program_;
    GLint matrix_;
    DrawList list_;
    Framebuffer target_;
    std::map<std::string, Kept> kept_; ///< by the lamps' names
    std::vector<LitLamp> lamps_;
    std::vector<glm::mat4> from_lamps_;
};

} // namespace fernlicht::gl
