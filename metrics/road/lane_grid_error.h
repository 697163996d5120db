// How exact the extents of each lane are on a grid: what every second row and column would make of them.
#pragma once

#include "metrics/road/extent.h"

namespace fernlicht {

/// |difference| of one lane's extents between the grid and every second row and column of it, metres. Where the error goes as the square of
/// the cell, the grid's own is a third of this.
struct LaneGridError {
    double limit_lx = 0.0;
    ExtentPlane plane = ExtentPlane::road;
    std::string lane;                                                 ///< as LaneExtent::lane
    double reach_m = 0.0, edge_m = 0.0, unlit_m = 0.0, area_m2 = 0.0; ///< `edge_m` is the larger of both edges'
};

/// `measured` is what measure_extent finds in `lx` on `grid`. A lane that the coarser grid loses (its edge lies beyond the last column),
/// and a reach that is cut off on either, have no entry. Empty for a grid of less than three rows or columns.
std::vector<LaneGridError> lane_grid_errors(const ExtentGrid& grid, const std::vector<double>& lx, ExtentPlane plane,
                                            const std::vector<double>& limits_lx, const std::vector<LaneExtent>& measured);

} // namespace fernlicht
