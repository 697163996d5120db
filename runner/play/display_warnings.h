// What a display's profile makes of pictures that nobody would want, and is no mistake of the file.
#pragma once

#include "scenarios/display/display_profile.h"

#include <string>
#include <vector>

namespace fernlicht {

/// One sentence each: a peak below 3 times the black, the least contrast that ISO 9241-3 and ANSI/HFES 100-1988 recommend for text; PQ in 8
/// bits, where ITU-R BT.2100 has 10 or 12.
std::vector<std::string> display_warnings(const DisplayProfile& profile);

} // namespace fernlicht
