// One depth map for all lamps, from midway between those that shine.
#pragma once

#include "renderer/gl/shadows/projected_maps.h"

namespace fernlicht::gl {

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

} // namespace fernlicht::gl
