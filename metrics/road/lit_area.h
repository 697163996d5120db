// How much road is lit: the area inside the isolux line, not a count of cells.
#pragma once

#include "metrics/road/extent.h"

#include <optional>

namespace fernlicht {

/// Edges of a lane in one row of a grid, offsets left positive; nullopt where the lane is not.
struct LaneSpan {
    double left_m = 0.0, right_m = 0.0;
};
using LaneSpans = std::vector<std::optional<LaneSpan>>;

/// Road surface in m2 of a cell's two triangles, cut from the near right to the far left corner, the right one first.
using CellArea = std::array<double, 2>;

/// Of the cells between every `step`th of the grid's first `rows` and `columns`, row-major.
std::vector<CellArea> cell_areas_m2(const ExtentGrid& grid, std::size_t step, std::size_t rows, std::size_t columns);
inline std::vector<CellArea> cell_areas_m2(const ExtentGrid& grid) {
    return cell_areas_m2(grid, 1, grid.ahead_m.size(), grid.offset_m.size());
}

/// Area of road surface with E >= limit. Each cell is cut into two triangles, the isolux line crosses their sides as in crossing.h, and
/// what lies inside counts as the triangle does in the world: in a curve the inner side is shorter.
class LitArea {
  public:
    /// `cell_m2` of the grid; `brightest_lx`: the largest value of each row, so that dark rows cost nothing. Refers to all of them.
    LitArea(const ExtentGrid& grid, const std::vector<CellArea>& cell_m2, const std::vector<double>& lx,
            const std::vector<double>& brightest_lx, double limit_lx);

    /// Over the whole grid, m2.
    double all_m2() const;
    /// Between the edges of a lane, which run straight from row to row.
    double lane_m2(const LaneSpans& lane) const;

  private:
    std::size_t columns() const { return grid_->offset_m.size(); }
    bool strip_is_dark(std::size_t row) const { return (*brightest_lx_)[row] < limit_lx_ && (*brightest_lx_)[row + 1] < limit_lx_; }
    double in_cut_cell_m2(std::size_t row, std::size_t column, const LaneSpan& near, const LaneSpan& far) const;
    double in_strip_m2(std::size_t row, const LaneSpan& near, const LaneSpan& far) const;

    const ExtentGrid* grid_;
    const std::vector<CellArea>* cell_m2_;
    const std::vector<double>* lx_;
    const std::vector<double>* brightest_lx_;
    double limit_lx_;
    std::vector<double> lit_m2_; ///< of each cell, row-major
};

} // namespace fernlicht
