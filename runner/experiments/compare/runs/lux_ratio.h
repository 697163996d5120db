// Light on the road from above, one lamp set against another.
#pragma once

#include "runner/findings/report.h"

namespace fernlicht {

/// Of a stored frame of a map view. nullopt where the file has no illuminance; throws InputError where it cannot be read.
std::optional<LuxMap> stored_lux_map(const std::filesystem::path& exr, const StoredFrame& frame, const View& view);

/// New over old, ahead to the right; grey where both are below 0.1 lx. "" where the maps are not of one size.
std::string lux_ratio_svg(const LuxMap& now, const LuxMap& before, const std::string& title);

/// Isolux lines of both at 1, 3, 5, 10, 30 and 50 lx, old solid, new dashed. "" where the maps are not of one size.
std::string lux_lines_svg(const LuxMap& now, const LuxMap& before, const std::string& title, const std::string& now_name,
                          const std::string& before_name);

} // namespace fernlicht
