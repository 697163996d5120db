// Shadows flattened onto the plane of the road by a projection from each lamp (J. Blinn, "Me and my (fake) shadow", 1988), with a stencil
// so that casters that overlap count once and the ground alone is darkened.
//
// Right only where the ground is one plane: where the ground that the lamps reach is not, within ShadowSettings::tolerance_m, the moment is
// refused.
// A dark polygon under each body that moves: the ground within its outline seen from above gets no lamp's light, whichever way that comes.
// No shadow is cast: the polygon says where a car stands, and nothing else.
#pragma once

#include "renderer/gl/scene/draw_list.h"
#include "renderer/gl/shadows/shadow_mask.h"

#include <glm/vec2.hpp>
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
