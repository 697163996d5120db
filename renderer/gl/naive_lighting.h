// The technique `photometric-naive`: one shader that loops over the lamps with every look-up by hand, shadow maps of everything, nothing
// left out but what is out of view. What `photometric` is measured against, in speed and in light.
#pragma once

#include "renderer/gl/device/program.h"
#include "renderer/gl/scene/beams.h"
#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/scene/lighting.h"

namespace fernlicht::gl {

class NaiveLighting : public Lighting {
  public:
    NaiveLighting(Context& context, const Scene& scene, const RendererSettings& settings);

    void draw(const Shot& shot) override;
    void prepare(const Shot& shot) override;
    std::optional<double> beam_error(const LampFile& lamp) const override { return beams_.error_of_peak(lamp); }
    std::vector<PrunedFeature> pruned() const override { return {}; }

  private:
    struct Packed { // std140, as in naive_lamps.glsl
        glm::vec4 position_m, right, up, forward, grid, count, colour, shadow;
    };
    const Program& variant(std::size_t lamps, const Shot& shot);
    void set_lamps(const Moment& moment);
    void draw_shadow_maps(const Shot& shot);
    void draw_pieces(const glm::dmat4& clip, const glm::dvec3& ego_m, bool in_map, double farthest_m, Work& work);

    Context& context_;
    RendererSettings settings_;
    SceneBuffers scene_;
    Beams beams_;
    DrawList list_;
    Program depth_;
    std::map<std::pair<std::size_t, int>, Program> variants_; ///< by lamps and output_bits()
    std::vector<LitLamp> lamps_;
    std::vector<Packed> packed_;
    Buffer block_;
    std::vector<Texture> shadow_maps_;
    Framebuffer shadow_target_;
};

} // namespace fernlicht::gl
