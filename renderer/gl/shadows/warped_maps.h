// The methods `perspective-map` and `light-space-map`: a map for each lamp, warped towards what the view sees of its beam.
#pragma once

#include "renderer/gl/shadows/projected_maps.h"

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

} // namespace fernlicht::gl
