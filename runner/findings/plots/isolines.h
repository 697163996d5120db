// Lines of equal value through a grid of samples, by marching squares.
#pragma once

#include <utility>
#include <vector>

namespace fernlicht::plots {

struct Point {
    double x = 0.0, y = 0.0;
    bool operator==(const Point&) const = default;
};
using Polyline = std::vector<Point>;

/// Samples over two axes, each strictly monotone. values[iy * x.size() + ix]; NaN: no data, no line there.
struct Grid {
    std::vector<double> x, y;
    std::vector<double> values;
    double at(std::size_t ix, std::size_t iy) const { return values[iy * x.size() + ix]; }
};

/// The lines on which the grid, linear along each cell's edges, has the value `level`. Closed lines end where they begin. Saddles are
/// joined by the mean of their corners. Throws std::invalid_argument when the sizes do not fit.
std::vector<Polyline> isolines(const Grid& grid, double level);

} // namespace fernlicht::plots
