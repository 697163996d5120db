// The method `soft-map`: penumbrae of lamps that are discs facing along their axes, as the mean over maps from places on the disc.
#pragma once

#include "renderer/gl/shadows/projected_maps.h"

namespace fernlicht::gl {

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
