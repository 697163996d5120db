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

/// Road surface in m2 of each grid cell's two triangles, from their corners in the world: in a curve the inner side is shorter.
/// Index: 2 * (row * (columns - 1) + column), then + 1 for the second triangle.
std::vector<double> triangle_areas_m2(const ExtentGrid& grid);

/// Area with E >= limit over the whole grid: each cell is cut into two triangles, the isolux line crosses their sides as in crossing.h.
double lit_area_m2(const ExtentGrid& grid, const std::vector<double>& areas_m2, const std::vector<double>& lx, double limit_lx);

/// The same between the edges of a lane, which run straight from row to row.
double lit_area_m2(const ExtentGrid& grid, const std::vector<double>& areas_m2, const std::vector<double>& lx, double limit_lx,
                   const LaneSpans& lane);

} // namespace fernlicht
