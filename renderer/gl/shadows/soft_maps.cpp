#include "renderer/gl/shadows/soft_maps.h"

#include <cmath>

namespace fernlicht::gl {

std::vector<glm::dvec2> places_on_disc(double radius_m, int count) {
    if (count == 1)
        return {{0.0, 0.0}}; // a point, looked up as a single map is
    const double golden_angle = pi * (3.0 - std::sqrt(5.0));
    std::vector<glm::dvec2> places;
    for (int k = 0; k < count; ++k) {
        const double r = radius_m * std::sqrt((k + 0.5) / count), angle = k * golden_angle;
        places.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    return places;
}

void SoftMaps::choose_casters(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    ProjectedMaps::choose_casters(lamps, beams, ego_m);
    casters_.soften(settings_.lamp_radius_m);
}

} // namespace fernlicht::gl
