// The last step of a picture: from coloured light, through a tone mapper, to what a display is told.
#pragma once

#include "scenarios/display/display_profile.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/values/image.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace fernlicht {

/// Shares of the display's red, green and blue, 0..1 each, whose light with black has this XYZ (cd/m2 on the display). What the display
/// cannot show: the luminance is cut to black..peak, then the colour follows the profile's gamut rule.
glm::dvec3 shares_for(const DisplayProfile& profile, const glm::dvec3& xyz_cdm2);

/// The light of the display for these codes, black included: XYZ in cd/m2.
glm::dvec3 shown_xyz(const DisplayProfile& profile, const glm::dvec3& code);

/// Codes, 0..1, for light of the scene: linear in sRGB's primaries, Y in cd/m2. Luminance goes through the tone mapper, to black + share *
/// (peak - black); chromaticity stays.
glm::dvec3 display_code(const DisplayProfile& profile, const ToneMapper& mapper, const glm::dvec3& light);

/// Three codes a pixel of profile.bits each; rounded to the nearest.
Image<glm::u16vec3> display_picture(const DisplayProfile& profile, const ToneMapper& mapper, const Image<glm::vec3>& light);

/// Mean luminance of the display over the pixels of such a picture, black included, cd/m2; not empty.
double mean_shown_cdm2(const DisplayProfile& profile, const Image<glm::u16vec3>& codes);

} // namespace fernlicht
