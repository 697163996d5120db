// Measured illuminance on a grid, ready to be asked along, across and by lane.
// How much road is lit: the area inside the isolux line, not a count of cells.
#pragma once

#include "metrics/road/extent.h"
#include "metrics/road/lit_line.h"

#include <array>
#include <optional>
#include <string>
#include <utility>

namespace fernlicht {

/// Road surface in m2 of a cell's two triangles, cut from the near right to the far left corner, the right one first.
using CellArea = std::array<double, 2>;

/// Of the cells between every `step`th of the grid's first `rows` and `columns`, row-major.
std::vector<CellArea> cell_areas_m2(const ExtentGrid& grid, std::size_t step, std::size_t rows, std::size_t columns);
inline std::vector<CellArea> cell_areas_m2(const ExtentGrid& grid) {
    return cell_areas_m2(grid, 1, grid.ahead_m.size(), grid.offset_m.size());
}

/// Throws std::invalid_argument where measure_extent says so.
void check_measurable(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& thresholds_lx);

/// Lanes from left to right as the nearest row has them, then those that begin farther on. Where part of a lane lies beyond the
/// width that was looked at, the lane is taken as absent.
std::vector<LaneStrip> lane_strips(const ExtentGrid& grid, std::size_t step = 1); ///< of every `step`th row

/// The column to the left of an offset within the grid; its right neighbour lies at or to the right of the offset. At least two columns.
/// `guess`: where it may be, which is looked at first.
std::size_t column_left_of(const std::vector<double>& offsets_m, double offset_m, std::size_t guess = 0);

/// Illuminance between the grid's columns. `row` points to its first column's value; the offset lies within the grid. `guess`: the column
/// to the left of the offset may be; it is there afterwards.
double lx_across(const std::vector<double>& offsets_m, const double* row, double offset_m, std::size_t* guess = nullptr);

/// A grid of at least two rows and columns with its values; refers to both.
class LitRoad {
  public:
    LitRoad(const ExtentGrid& grid, const std::vector<double>& lx);
    LitRoad(const LitRoad&) = delete;
    LitRoad& operator=(const LitRoad&) = delete;

    const ExtentGrid& grid() const { return grid_; }

    /// Samples along the road, one per row, at these offsets; nullopt where there is nothing to follow.
    std::vector<LineSample> along(const std::vector<std::optional<double>>& offsets_m) const;
    /// The line that reaches farthest of all columns.
    LitLine farthest(double threshold_lx) const;
    LitLine column(std::size_t index, double threshold_lx) const;

    /// Row before a distance and the share of the way to the next.
    std::pair<std::size_t, double> place(double ahead_m) const;
    bool looked_at(double ahead_m) const { return ahead_m >= grid_.ahead_m.front() && ahead_m <= grid_.ahead_m.back(); }
    /// Values of all columns at a distance that was looked at.
    std::vector<double> across(double ahead_m) const;

  private:
    friend class LitArea;
    const double* row(std::size_t index) const { return &lx_[index * grid_.offset_m.size()]; }

    const ExtentGrid& grid_;
    const std::vector<double>& lx_;
    std::vector<CellArea> own_cell_m2_; ///< where the grid does not know them
    const std::vector<CellArea>& cell_m2_;
    std::vector<double> brightest_lx_; ///< of each row, so that dark rows cost nothing
};

/// Area of road surface with E >= limit. Each cell is cut into two triangles, the isolux line crosses their sides as in lit_line.h, and
/// what lies inside counts as the triangle does in the world: in a curve the inner side is shorter.
class LitArea {
  public:
    /// Refers to the road.
    LitArea(const LitRoad& road, double threshold_lx);

    /// Over the whole grid, m2.
    double all_m2() const;
    /// What the edges of one lane leave of cells that are lit all over, by row and by the cell's place from either end; NaN: not known yet.
    /// The same for all limits.
    using CutCells = std::vector<std::array<double, 8>>;
    static CutCells no_cut_cells(std::size_t rows);
    /// Between the edges of a lane, which run straight from row to row.
    double lane_m2(const LaneSpans& lane, CutCells& known) const;
    /// d lane_m2() / d lx, by point of the grid.
    std::vector<double> lane_shares(const LaneSpans& lane) const;

  private:
    std::size_t cells() const { return road_->grid_.offset_m.size() - 1; } ///< of a row
    bool strip_is_dark(std::size_t row) const {
        return road_->brightest_lx_[row] < threshold_lx_ && road_->brightest_lx_[row + 1] < threshold_lx_;
    }
    std::pair<std::size_t, std::size_t> columns_of(const LaneSpan& near, const LaneSpan& far) const; ///< first and last cell of a lane
    double in_cut_cell_m2(std::size_t row, std::size_t column, const LaneSpan& near, const LaneSpan& far, double* known_m2) const;
    double in_strip_m2(std::size_t row, const LaneSpan& near, const LaneSpan& far, std::array<double, 8>& known_m2) const;

    const LitRoad* road_;
    double threshold_lx_;
    std::vector<double> lit_m2_; ///< of each cell, row-major, as far as any is lit
};

} // namespace fernlicht
