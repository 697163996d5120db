#include "scenarios/display/white_adaptation.h"

#include "scenarios/display/display_profile.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/matrix.hpp>

namespace fernlicht {
namespace {

constexpr double dark_surround = 0.8;

/// From XYZ to three kinds of receptors: M16 of Li et al. 2017, columns.
const glm::dmat3& receptors_of_xyz() {
    static const glm::dmat3 m =
        glm::transpose(glm::dmat3(0.401288, 0.650173, -0.051461, -0.250268, 1.204414, 0.045854, -0.002079, 0.048952, 0.953127));
    return m;
}

} // namespace

double adaptation_degree(double adapting_cdm2) { return dark_surround * (1.0 - std::exp(-(adapting_cdm2 + 42.0) / 92.0) / 3.6); }

glm::dvec3 xyz_of(const glm::dvec2& c) { return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y}; }

bool can_adapt_to(const glm::dvec2& c) {
    if (!(c.y > 0.0))
        return false;
    const glm::dvec3 receptors = receptors_of_xyz() * xyz_of(c);
    return receptors.x > 0.0 && receptors.y > 0.0 && receptors.z > 0.0;
}

glm::dvec2 chromaticity_of(const glm::dvec3& xyz) { return glm::dvec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z); }

glm::dmat3 cat16(const glm::dvec3& white, const glm::dvec3& reference, double degree) {
    const glm::dmat3& m = receptors_of_xyz();
    const glm::dvec3 scaled = degree * (white.y / reference.y) * (m * reference) / (m * white) + (1.0 - degree);
    glm::dmat3 diagonal(0.0);
    for (int i = 0; i < 3; ++i)
        diagonal[i][i] = scaled[i];
    return glm::inverse(m) * diagonal * m;
}

std::optional<glm::dmat3> light_adaptation(const WhiteAdaptation& white) {
    if (!white.adapts())
        return std::nullopt;
    const glm::dmat3 to_xyz = xyz_from_light();
    return glm::inverse(to_xyz) * cat16(xyz_of(*white.chromaticity), to_xyz * glm::dvec3(1.0), *white.degree) * to_xyz;
}

std::string adaptation_text(const WhiteAdaptation& white) {
    return white.adapts()
               ? fmt::format("white adapted {:.4g} to x={:.4f} y={:.4f}", *white.degree, white.chromaticity->x, white.chromaticity->y)
               : "";
}

} // namespace fernlicht
