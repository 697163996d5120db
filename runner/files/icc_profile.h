// A display's profile as other programs read it.
#pragma once

#include "scenarios/display/display_profile.h"

#include <string>

namespace fernlicht {

/// An ICC profile, version 4, of matrix and curves: the display's primaries, white, transfer curve (of pq up to its own peak) and peak
/// luminance. Black is not part of such profiles. Same profile, same bytes. Throws std::runtime_error where Little CMS cannot make one.
std::string icc_profile(const DisplayProfile& display);

} // namespace fernlicht
