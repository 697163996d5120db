// One aliasing of many moments.
#pragma once

#include "metrics/aliasing/spatial_aliasing.h"

#include <cstddef>
#include <vector>

namespace fernlicht {

/// Numbers: r.m.s. over the moments, at least one. Pictures and the worst place: of the one shown, which is used up.
SpatialAliasing over_moments(std::vector<SpatialAliasing>& found, std::size_t shown);

} // namespace fernlicht
