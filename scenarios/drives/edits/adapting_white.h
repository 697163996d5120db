// Which light the eye of a drive's pictures is adapted to: decided by the drive's lamps and sky, not by any picture, so that all its
// pictures share one white.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// What a drive's lamps give of white: unit luminance, linear in sRGB's primaries. Of each lamp set its low beams (any lamps where there
/// are none), weighted by their light; of several sets their mean, as who compares them is adapted to none. nullopt: no lamp shines.
std::optional<glm::dvec3> white_of_lamps(const Drive& drive);

/// Planck's law at 4000 K, between halogen and LED: the lamps' white of cells of a study, which share it whatever lamps the study has, so
/// that a further lamp leaves the others' pictures as they are.
glm::dvec3 white_of_studies();

/// Fills in what the drive's WhiteAdaptation leaves open. White: the road's lamplight, taken as 1 cd/m2 of `lamps`, and what the sky of the
/// drive's beginning makes of asphalt (0.08 E / pi) in its own white, D65. Degree: CIECAM16's at their sum. D65 where nothing shines.
void close_white(Drive& drive, const std::optional<glm::dvec3>& lamps);

} // namespace fernlicht
