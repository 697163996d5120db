#include "metrics/road/lit_road.h"

#include <cmath>

namespace fernlicht {
namespace {

struct PickedGrid {
    ExtentGrid grid;
    std::vector<double> lx;
};

/// Every `step`th of the first `rows` and `columns`: all that reach_and_area asks for.
PickedGrid picked(const ExtentGrid& grid, const std::vector<double>& lx, std::size_t step, std::size_t rows, std::size_t columns) {
    PickedGrid result;
    for (std::size_t column = 0; column < columns; column += step)
        result.grid.offset_m.push_back(grid.offset_m[column]);
    for (std::size_t row = 0; row < rows; row += step) {
        result.grid.ahead_m.push_back(grid.ahead_m[row]);
        for (std::size_t column = 0; column < columns; column += step)
            result.lx.push_back(lx[row * grid.offset_m.size() + column]);
    }
    result.grid.cell_m2 = cell_areas_m2(grid, step, rows, columns);
    return result;
}

struct ReachAndArea {
    std::optional<double> reach_m; ///< nullopt: lit where the grid, road or lane ends
    double area_m2 = 0.0;
};

std::vector<ReachAndArea> reach_and_area(const ExtentGrid& grid, const std::vector<double>& lx, const std::vector<double>& limits_lx) {
    const LitRoad road(grid, lx);
    const bool has_centre = grid.offset_m.front() <= 0.0 && grid.offset_m.back() >= 0.0;
    const std::optional<double> centre_m = has_centre ? std::optional(0.0) : std::nullopt;
    const std::vector<LineSample> centre = road.along(std::vector(grid.ahead_m.size(), centre_m));
    std::vector<ReachAndArea> results;
    for (const double limit : limits_lx) {
        const LitLine reach = lit_line(centre, limit);
        results.push_back({reach.lit_at_end ? std::nullopt : std::optional(reach.last_m), road.lit_area(limit).all_m2()});
    }
    return results;
}

} // namespace

std::vector<GridError> grid_error(const ExtentGrid& grid, const std::vector<double>& lx, ExtentPlane plane,
                                  const std::vector<double>& limits_lx) {
    check_measurable(grid, lx, limits_lx);
    std::vector<GridError> errors;
    if (grid.ahead_m.size() < 3 || grid.offset_m.size() < 3)
        return errors;
    // An odd number of both, so that the coarse grid covers what the fine one covers and only the cell differs.
    const std::size_t rows = grid.ahead_m.size() - (grid.ahead_m.size() % 2 == 0 ? 1 : 0);
    const std::size_t columns = grid.offset_m.size() - (grid.offset_m.size() % 2 == 0 ? 1 : 0);
    const bool odd = rows == grid.ahead_m.size() && columns == grid.offset_m.size();
    const PickedGrid trimmed = odd ? PickedGrid{} : picked(grid, lx, 1, rows, columns);
    const PickedGrid coarse = picked(grid, lx, 2, rows, columns);
    const std::vector<ReachAndArea> by_fine = reach_and_area(odd ? grid : trimmed.grid, odd ? lx : trimmed.lx, limits_lx);
    const std::vector<ReachAndArea> by_coarse = reach_and_area(coarse.grid, coarse.lx, limits_lx);
    for (std::size_t i = 0; i < limits_lx.size(); ++i) {
        const std::optional<double>&fine_m = by_fine[i].reach_m, &coarse_m = by_coarse[i].reach_m;
        errors.push_back({limits_lx[i], plane, fine_m && coarse_m ? std::optional(std::abs(*fine_m - *coarse_m)) : std::nullopt,
                          std::abs(by_fine[i].area_m2 - by_coarse[i].area_m2)});
    }
    return errors;
}

} // namespace fernlicht
