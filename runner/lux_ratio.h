// Light on the road from above, one lamp set over another.
#pragma once

#include "runner/report/report.h"

namespace fernlicht {

/// New over old, ahead to the right; grey where both are below 0.1 lx. "" where the maps are not of one size.
std::string lux_ratio_svg(const LuxMap& now, const LuxMap& before, const std::string& title);

} // namespace fernlicht
