// Light on the road from above, one lamp set against another.
#pragma once

#include "runner/findings/lux_figure.h"

namespace fernlicht {

/// Of a stored frame of a map view. nullopt where the file has no illuminance; throws InputError where it cannot be read.
std::optional<LuxMap> stored_lux_map(const std::filesystem::path& exr, const StoredFrame& frame, const View& view);

/// New over old, ahead to the right; grey where both are below 0.1 lx. nullopt where the maps are not of one size.
std::optional<plots::Figure> lux_ratio_figure(const LuxMap& now, const LuxMap& before, const std::string& title);

/// Isolux lines of both at 1, 3, 5, 10, 30 and 50 lx, old solid, new dashed. nullopt where the maps are not of one size.
std::optional<plots::Figure> lux_lines_figure(const LuxMap& now, const LuxMap& before, const std::string& title,
                                              const std::string& now_name, const std::string& before_name);

} // namespace fernlicht
