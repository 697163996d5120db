// A flat straight road as a grid, without a network: what closed forms can be held against.
#pragma once

#include "metrics/road/extent.h"

#include <cmath>

namespace fernlicht::tests {

struct StraightGrid {
    double ahead_m = 100.0, beside_m = 20.0, along_m = 0.5, across_m = 0.125, target_height_m = 0.0;
};

/// Own lane 3.5 m wide about offset 0, an oncoming one to its left, a shoulder of 1.5 m to its right.
inline CrossSection two_lanes() {
    return {{{"left 1", "driving", 1, false, 5.25, 1.75},
             {"own", "driving", -1, true, 1.75, -1.75},
             {"right 1", "shoulder", -2, true, -1.75, -3.25}},
            5.25,
            -3.25};
}

inline ExtentGrid straight_grid(const StraightGrid& size) {
    ExtentGrid grid;
    grid.target_height_m = size.target_height_m;
    const int rows = static_cast<int>(std::lround(size.ahead_m / size.along_m)),
              half = static_cast<int>(std::lround(size.beside_m / size.across_m));
    for (int column = -half; column <= half; ++column)
        grid.offset_m.push_back(column * size.across_m);
    for (int row = 0; row <= rows; ++row) {
        grid.ahead_m.push_back(row * size.along_m);
        grid.sections.push_back(two_lanes());
        for (const double offset_m : grid.offset_m)
            grid.surface.push_back({{row * size.along_m, offset_m, 0.0}, glm::dmat3(1.0)});
    }
    return grid;
}

/// Values of `lx(ahead, offset)` at every point.
template <class Lux> std::vector<double> lit_by(const ExtentGrid& grid, Lux lx) {
    std::vector<double> values;
    for (const double ahead_m : grid.ahead_m)
        for (const double offset_m : grid.offset_m)
            values.push_back(lx(ahead_m, offset_m));
    return values;
}

/// The extent of one lane at one limit.
inline LaneExtent extent_of(const std::vector<LaneExtent>& extents, const std::string& lane, double threshold_lx) {
    for (const LaneExtent& extent : extents)
        if (extent.lane == lane && extent.threshold_lx == threshold_lx)
            return extent;
    throw std::out_of_range("no extent of lane " + lane);
}

} // namespace fernlicht::tests
