// Measured illuminance on a grid, ready to be asked along, across and by lane.
#pragma once

#include "metrics/road/lit_area.h"
#include "metrics/road/lit_line.h"

#include <string>
#include <utility>

namespace fernlicht {

/// Throws std::invalid_argument where measure_extent says so.
void check_measurable(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& limits_lx);

/// A lane with its edges in every row.
struct LaneStrip {
    std::string name;
    bool same_direction = true;
    LaneSpans spans;
};

/// Lanes from left to right as the nearest row has them, then those that begin farther on. Where part of a lane lies beyond the
/// width that was looked at, the lane is taken as absent.
std::vector<LaneStrip> lane_strips(const ExtentGrid& grid);

/// The column to the left of an offset within the grid; its right neighbour lies at or to the right of the offset. At least two columns.
std::size_t column_left_of(const std::vector<double>& offsets_m, double offset_m);

/// Illuminance between the grid's columns. `row` points to its first column's value; the offset lies within the grid.
double lx_across(const std::vector<double>& offsets_m, const double* row, double offset_m);

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
    LitLine farthest(double limit_lx) const;
    LitLine column(std::size_t index, double limit_lx) const;

    /// Row before a distance and the share of the way to the next.
    std::pair<std::size_t, double> place(double ahead_m) const;
    bool looked_at(double ahead_m) const { return ahead_m >= grid_.ahead_m.front() && ahead_m <= grid_.ahead_m.back(); }
    /// Values of all columns at a distance that was looked at.
    std::vector<double> across(double ahead_m) const;

    LitArea lit_area(double limit_lx) const { return {grid_, cell_m2_, lx_, brightest_lx_, limit_lx}; }

  private:
    const double* row(std::size_t index) const { return &lx_[index * grid_.offset_m.size()]; }

    const ExtentGrid& grid_;
    const std::vector<double>& lx_;
    std::vector<CellArea> own_cell_m2_; ///< where the grid does not know them
    const std::vector<CellArea>& cell_m2_;
    std::vector<double> brightest_lx_; ///< of each row
};

} // namespace fernlicht
