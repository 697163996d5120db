// From a picture's coloured light to the codes of a display, stage by stage: windscreen, eye, tone mapper, display. What is not asked for
// is not computed.
// What a display's profile makes of pictures that nobody would want, and is no mistake of the file.
#pragma once

#include "scenarios/display/display_profile.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/values/image.h"

#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

struct ShownPicture {
    Image<glm::u16vec3> codes; ///< of `bits` bits
    int bits = 8;
    std::vector<std::pair<std::string, double>> stage_s; ///< what each stage took, in order
};

/// `light`: perspective, square pixels, linear in sRGB's primaries, Y in cd/m2. The mapper is closed (ToneMapper::is_open). Without a
/// profile: sRGB.
ShownPicture show(const Image<glm::vec3>& light, double vertical_fov_rad, const DisplaySettings& display, const ToneMapper& mapper);

/// Whether pictures are made of coloured light by `show`, and not by the drawing itself, which clips each channel and has no curves.
bool is_shown_after_drawing(const DisplaySettings& display, const ToneMapper& mapper);

/// What pictures were shown by, in one line: "rational s=20 white=100 cd/m2; display srgb" as drawn, "...; display srgb, luminance kept"
/// where they are shown after drawing without a profile, whose own rule is part of its hash. Pictures with different lines have no common
/// scale.
std::string shown_by(const DisplaySettings& display, const ToneMapper& mapper);

/// One sentence each: a peak below 3 times the black, the least contrast that ISO 9241-3 and ANSI/HFES 100-1988 recommend for text; PQ in 8
/// bits, where ITU-R BT.2100 has 10 or 12.
std::vector<std::string> display_warnings(const DisplayProfile& profile);

} // namespace fernlicht
