// What an eye that is adapted to a lamp's light sees its colours as: CAT16, the chromatic adaptation of CIECAM16 (Li et al. 2017,
// doi:10.1002/col.22131), which scales three kinds of receptors after von Kries.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace fernlicht {

/// To which light the eye of a drive's pictures is adapted, and how far. Pictures with different ones cannot be compared.
struct WhiteAdaptation {
    std::optional<double> degree;           ///< 0 not at all .. 1 wholly; nullopt: CIECAM16's, not found yet
    std::optional<glm::dvec2> chromaticity; ///< x, y of that light (CIE 1931), y > 0; nullopt: of the drive's lamps and sky, not found yet

    bool is_open() const { return !degree || !chromaticity; }
    /// Whether pictures differ from what a camera balanced to daylight shows. Not while it is open.
    bool adapts() const { return !is_open() && *degree > 0.0; }
    bool operator==(const WhiteAdaptation&) const = default;
};

/// How far an eye adapts that looks into a dark surround, as a driver at night does: D = F (1 - exp(-(L_A + 42) / 92) / 3.6), F = 0.8
/// (CIECAM16, as CIECAM02). L_A in cd/m2, >= 0: 0.659 at 0, 0.661 at 1, 0.8 by day.
double adaptation_degree(double adapting_cdm2);

/// XYZ with Y = 1 of a chromaticity, y > 0.
glm::dvec3 xyz_of(const glm::dvec2& chromaticity);
/// Whether light of a chromaticity reaches each of CAT16's three kinds of receptors: cat16 divides by what they get of white.
bool can_adapt_to(const glm::dvec2& chromaticity);
/// x, y of XYZ.
glm::dvec2 chromaticity_of(const glm::dvec3& xyz);

/// XYZ to XYZ: colours under `white` as they look under `reference`, both with Y > 0. Each kind of receptor is scaled by D Yw R'w / (Y'w
/// Rw) + 1 - D (CIE 159, Li et al. 2017). D = 1 maps white to reference; D = 0 changes nothing.
glm::dmat3 cat16(const glm::dvec3& white, const glm::dvec3& reference, double degree);

/// Of light in sRGB's primaries: to its white, D65. nullopt where nothing adapts. The luminance of white stays; that of others shifts by
/// some per cent, and whoever shows it puts it right.
std::optional<glm::dmat3> light_adaptation(const WhiteAdaptation& white);

/// "white adapted 0.66 to x=0.4234 y=0.3990"; "" where nothing adapts.
std::string adaptation_text(const WhiteAdaptation& white);

} // namespace fernlicht
