// Shadows flattened onto the plane of the road by a projection from each lamp (J. Blinn, "Me and my (fake) shadow", 1988), with a stencil
// so that casters that overlap count once and the ground alone is darkened.
//
// Right only where the ground is one plane: where the ground that the lamps reach is not, within ShadowSettings::tolerance_m, the moment is
// refused.
#pragma once

#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/shadows/shadow_mask.h"

#include <optional>

namespace fernlicht::gl {

/// Sums for the plane z = a x + b y + c of least squares through places, each with the same weight. Places within some kilometres of 0.
class PlaneFit {
  public:
    void add(const glm::dvec3& place_m);
    /// (unit normal upwards, -normal . place); a level plane through the places' mean where they lie in one line; nullopt without places.
    std::optional<glm::dvec4> plane() const;

  private:
    double count_ = 0.0;
    glm::dvec3 sum_{0.0};
    double xx_ = 0.0, xy_ = 0.0, yy_ = 0.0, xz_ = 0.0, yz_ = 0.0;
};

class PlanarShadows : public ShadowMask {
  public:
    PlanarShadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use);

    /// Throws InputError where the ground in the lamps' light is not one plane: by how much, and where.
    void set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) override;
    bool needed() const override;
    /// Pixels of ground are looked up wherever they lie: ground within the tolerance is seen where the plane would be, not where its box
    /// is.
    bool reach(const Piece& piece, double /*raised_m*/) const override { return piece.ground && needed(); }
    const char* title() const override { return "planar shadows"; }

  protected:
    bool only_on_ground() const override { return true; }
    bool hides_any(std::size_t lamp) const override;
    const char* pass_title() const override { return "shadow planes"; }
    void before_marking(const Shot& shot) override;
    void mark_hidden(const Shot& shot, std::size_t lamp, double raised_m) override;

  private:
    void find_plane(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams);

    Program program_;
    DrawList list_;
    std::vector<std::uint32_t> ground_; ///< pieces that the plane was laid through
    glm::dvec3 origin_m_{0.0};          ///< what world_plane_ is relative to
    glm::dvec4 world_plane_{0.0, 0.0, 1.0, 0.0};
    glm::dvec4 ego_plane_{0.0, 0.0, 1.0, 0.0}; ///< relative to the car
};

} // namespace fernlicht::gl
