// A dark polygon under each body that moves: the ground within its outline seen from above gets no lamp's light, whichever way that comes.
// No shadow is cast: the polygon says where a car stands, and nothing else.
#pragma once

#include "renderer/gl/shadows/shadow_mask.h"

#include <glm/vec2.hpp>

namespace fernlicht::gl {

/// Corners of the least convex polygon round the points, counter-clockwise; of less than three points or points in line those themselves.
/// A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions" (1979).
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points);

class UnderCarShadows : public ShadowMask {
  public:
    UnderCarShadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use);

    void set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) override;
    bool needed() const override { return !standing_.empty(); }
    bool reach(const Piece& piece, double raised_m) const override;
    const char* title() const override { return "dark polygons under cars"; }

  protected:
    bool only_on_ground() const override { return true; }
    bool one_for_all_lamps() const override { return true; }
    bool hides_any(std::size_t /*lamp*/) const override { return needed(); }
    const char* pass_title() const override { return "shadow polygons"; }
    void before_marking(const Shot& shot) override;
    void mark_hidden(const Shot& shot, std::size_t lamp, double raised_m) override;

  private:
    /// Of one body, in its frame.
    struct Outline {
        std::vector<glm::dvec2> corners_m;
        std::uint32_t piece = 0;   ///< one of the body's
        glm::dvec3 resting_m{0.0}; ///< that piece's origin in the body's frame
        double radius_m = 0.0;     ///< about the body's origin, of all that is dark
    };
    struct Standing {
        std::size_t outline = 0;
        glm::dvec3 place_m{0.0}; ///< of the body's origin, relative to the car
    };
    std::vector<Outline> outlines_;
    std::vector<Standing> standing_; ///< those that a lamp may light
    StencilVolumes volumes_;
};

} // namespace fernlicht::gl
