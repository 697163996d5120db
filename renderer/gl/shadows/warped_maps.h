// The methods `perspective-map` and `light-space-map`: a map for each lamp, warped towards what the view sees of its beam.
// Depth maps bent towards what a view sees: what view and beam have in common, and the homographies that spread a map's texels over it.
#pragma once

#include "renderer/gl/shadows/projected_maps.h"
#include "scenarios/drives/play/camera.h"

#include <optional>

namespace fernlicht::gl {

enum class Warp { perspective, light_space };

/// A map is not warped, but still fitted, where the warp turns what is seen inside out, or makes a texel wider than twice the widest of the
/// plain map; it is the plain one for maps, which have no eye, and for pictures of targets, which stand outside what is seen.
class WarpedMaps : public ProjectedMaps {
  public:
    /// `eye`: whose view they are fitted to; nullptr: the one drawn.
    WarpedMaps(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, Warp warp, std::shared_ptr<const View> eye)
        : ProjectedMaps(context, scene, settings), warp_(warp), eye_(std::move(eye)) {}

  protected:
    std::vector<MapPlan> plan(const Shot& shot) override;

  private:
    Warp warp_;
    std::shared_ptr<const View> eye_;
};

/// Corners of the convex body that is left of a box (SceneBuffers' order) inside all planes (xyz: unit normal towards the inside).
std::vector<glm::dvec3> clipped_box(const Corners& box, const std::vector<glm::dvec4>& planes);

/// What a camera sees of boxes inside a lamp's window, as points in lamp space. Boxes are relative to the car, as the camera is.
/// `lamp_m`: of the lamp. What lies nearer to the lamp's plane than map_begins_m, or farther outside the picture than slack_m, is not among
/// it.
std::vector<glm::dvec3> seen_in_beam(const std::vector<Corners>& boxes, const Camera& camera, const LitLamp& lamp, const glm::dvec3& lamp_m,
                                     const ShadowWindow& window, double slack_m);
inline constexpr double map_begins_m = 1.0;

/// Light-space perspective shadow maps (Wimmer, Scherzer, Purgathofer 2004), in the lamp's post-perspective space, where its light is
/// parallel: a perspective along the viewing direction as the map sees it, whose w at the two ends of what is seen has the ratio
/// sqrt(r_1 / r_0), r = distance from the eye over distance from the lamp: n = z_n + sqrt(z_n z_f) of the paper, for a lamp whose own
/// perspective spends texels too. nullopt where the viewing direction is a point in the map: light and view are parallel there.
std::optional<glm::dmat3> light_space_warp(const std::vector<glm::dvec3>& seen, const Camera& camera, const LitLamp& lamp,
                                           const glm::dvec3& lamp_m);

/// Perspective shadow maps (Stamminger, Drettakis 2002): a view from the lamp at the camera's post-perspective cube, fitted to the depths
/// that are seen. A lamp behind the camera, whose place there lies beyond infinity, needs no case of its own as a homography.
/// nullopt where the lamp stands in the cube, or so close to it that a part of the cube lies behind it.
std::optional<glm::dmat3> perspective_warp(const std::vector<glm::dvec3>& seen, const Camera& camera, const LitLamp& lamp,
                                           const glm::dvec3& lamp_m);

/// Puts what is seen into the whole map, and scales w so that it is at least z there. nullopt where the warp turns some of it inside out,
/// or w differs by more than a factor of 256 in it.
std::optional<glm::dmat3> fitted(const glm::dmat3& warp, const std::vector<glm::dvec3>& seen, int width, int height, double slack_m);

/// The most that a look-up is raised by, as a tangent seen from the lamp, over what is seen.
double max_raise_tangent(const glm::dmat3& texture_from_lamp, double spread, const std::vector<glm::dvec3>& seen);

} // namespace fernlicht::gl
