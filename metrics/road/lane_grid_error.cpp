#include "metrics/road/lane_grid_error.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

std::vector<LaneGridError> lane_grid_errors(const ExtentGrid& grid, const std::vector<double>& lx, ExtentPlane plane,
                                            const std::vector<double>& limits_lx, const std::vector<LaneExtent>& measured) {
    std::vector<LaneGridError> errors;
    const std::size_t columns = grid.offset_m.size();
    if (grid.ahead_m.size() < 3 || columns < 3)
        return errors;
    ExtentGrid coarse;
    coarse.target_height_m = grid.target_height_m;
    std::vector<double> coarse_lx;
    for (std::size_t column = 0; column < columns; column += 2)
        coarse.offset_m.push_back(grid.offset_m[column]);
    for (std::size_t row = 0; row < grid.ahead_m.size(); row += 2) {
        coarse.ahead_m.push_back(grid.ahead_m[row]);
        coarse.sections.push_back(grid.sections[row]);
        for (std::size_t column = 0; column < columns; column += 2) {
            coarse.surface.push_back(grid.surface[row * columns + column]);
            coarse_lx.push_back(lx[row * columns + column]);
        }
    }
    const std::vector<LaneExtent> other = measure_extent(coarse, coarse_lx, plane, limits_lx, {});
    for (const LaneExtent& fine : measured) {
        const auto found = std::ranges::find_if(
            other, [&](const LaneExtent& extent) { return extent.lane == fine.lane && extent.limit_lx == fine.limit_lx; });
        if (found == other.end() || fine.reach_is_cut_off || found->reach_is_cut_off)
            continue;
        errors.push_back({fine.limit_lx, plane, fine.lane, std::abs(fine.reach_centre_m - found->reach_centre_m),
                          std::max(std::abs(fine.reach_left_edge_m - found->reach_left_edge_m),
                                   std::abs(fine.reach_right_edge_m - found->reach_right_edge_m)),
                          std::abs(fine.unlit_before_reach_m - found->unlit_before_reach_m), std::abs(fine.area_m2 - found->area_m2)});
    }
    return errors;
}

} // namespace fernlicht
