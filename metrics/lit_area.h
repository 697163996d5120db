// How much road is lit: the area inside the isolux line, not a count of cells.
#pragma once

#include "metrics/extent.h"

#include <optional>

namespace fernlicht {

/// Edges of a lane in one row of a grid, offsets left positive; nullopt where the lane is not.
struct LaneSpan {
    double left_m = 0.0, right_m = 0.0;
};
using LaneSpans = std::vector<std::optional<LaneSpan>>;

/// Area of road surface with E >= limit over the whole grid, m2. Each cell is cut into two triangles, the isolux line crosses their sides
/// as in crossing.h, and what lies inside counts as the triangle does in the world: in a curve the inner side is shorter.
/// `brightest_lx`: the largest value of each row, so that dark rows cost nothing.
double lit_area_m2(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& brightest_lx, double limit_lx);

/// The same between the edges of a lane, which run straight from row to row.
double lit_area_m2(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& brightest_lx, double limit_lx,
                   const LaneSpans& lane);

} // namespace fernlicht
