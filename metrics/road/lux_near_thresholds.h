// Illuminance on a grid that is exact only where it decides. Of most points an extent needs no more than on which side of each limit they
// lie; how much light there is matters where the isolux lines run.
#pragma once

#include "metrics/road/extent.h"
#include "scenarios/light/light_bounds.h"

#include <cmath>
#include <oneapi/tbb/parallel_for.h>
#include <span>
#include <vector>

namespace fernlicht {

/// Number of limits that an illuminance reaches; `undecided_side` where its bounds do not tell.
using LimitSide = std::uint8_t;
inline constexpr LimitSide undecided_side = 255;
/// Of each of the bounds; their low_lx into `lx`.
void limit_sides(std::span<const LuxBounds> bounds, const std::vector<double>& thresholds_lx, LimitSide* sides, double* lx);

/// Row-major, like `sides`: 1 where a point or one of its eight neighbours is undecided or lies on another side of a limit, and where a
/// lane's line crosses one. The same in every second row and column, which grid_errors measures.
std::vector<unsigned char> deciding_points(const ExtentGrid& grid, const std::vector<LimitSide>& sides);

/// Row-major values on the grid: exact_lx(i) at the points that decide, elsewhere a value that reaches the same limits. bounds_lx(first,
/// bounds) fills in those of a row, which begins at that point: they hold exact_lx. measure_extent and grid_errors find the same in them as
/// in exact values everywhere.
template <class Bounds, class Exact> std::vector<double>
lux_near_thresholds(const ExtentGrid& grid, const std::vector<double>& thresholds_lx, Bounds bounds_lx, Exact exact_lx) {
    const std::size_t columns = grid.offset_m.size();
    std::vector<double> lx(grid.surface.size());
    std::vector<LimitSide> sides(lx.size());
    const auto in_each_row = [&](auto from) {
        oneapi::tbb::parallel_for(std::size_t{0}, grid.ahead_m.size(), [&](std::size_t row) { from(row * columns); });
    };
    in_each_row([&](std::size_t first) {
        std::vector<LuxBounds> bounds(columns);
        bounds_lx(first, std::span(bounds));
        limit_sides(bounds, thresholds_lx, &sides[first], &lx[first]);
    });
    const std::vector<unsigned char> decides = deciding_points(grid, sides);
    in_each_row([&](std::size_t first) {
        for (std::size_t i = first; i < first + columns; ++i)
            if (decides[i] != 0)
                lx[i] = exact_lx(i);
    });
    return lx;
}

} // namespace fernlicht
