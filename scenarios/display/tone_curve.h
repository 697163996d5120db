// Tone mappers as functions of one luminance, their inverses and the contrast they keep. Equations of the pointwise ones:
// scenarios/photometry.glsl.
#pragma once

#include "scenarios/display/tone_mapper.h"

#include <optional>
#include <string_view>

namespace fernlicht {

/// "rational", as drives name it.
std::string_view name(ToneMapperKind kind);

/// Share of what the display can show, 0..1: 0 for 0 and below, 1 from l_max on; rises with the luminance. A luminance that is not a number
/// is shown as 0.
///
/// A histogram curve that is not found yet (ToneMapper::is_open) is linear.
/// Below a histogram curve's first knot the share falls in proportion to the luminance, so that 0 stays 0.
double toned(const ToneMapper& mapper, double luminance_cdm2);

/// The luminance that is shown with this share: toned(untoned(d)) = d. nullopt outside 0..1. 1 gives l_max, the least that is shown so.
std::optional<double> untoned(const ToneMapper& mapper, double share);

/// d ln(share) / d ln(luminance): 1 keeps a small contrast as it was, 0 loses it; above 1 raises it. From l_max on 0. luminance > 0.
double contrast_kept(const ToneMapper& mapper, double luminance_cdm2);

/// The same on a display whose black is not dark: what of the contrast is left when `black_share` = black / white is added to all.
double contrast_kept(const ToneMapper& mapper, double luminance_cdm2, double black_share);

} // namespace fernlicht
