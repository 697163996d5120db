#include "metrics/road/extent.h"

#include "metrics/road/lit_area.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <stdexcept>

namespace fernlicht {
namespace {

/// Whole steps in a length, one more where rounding took it away.
int steps_in(double length_m, double step_m) { return static_cast<int>(std::floor(length_m / step_m * (1.0 + 1e-12))); }

void check(const ExtentParameters& parameters) {
    constexpr double most_points = 4e7;
    const double rows = parameters.ahead_m / parameters.cell_m + 1.0;
    const double columns = 8.0 * parameters.beside_m / parameters.cell_m + 1.0;
    if (!(std::isfinite(parameters.cell_m) && parameters.cell_m > 0.0 && parameters.ahead_m > 0.0 && parameters.beside_m > 0.0 &&
          rows * columns <= most_points))
        throw std::invalid_argument(fmt::format("a grid of {} m cells over {} m ahead and {} m to each side cannot be made",
                                                parameters.cell_m, parameters.ahead_m, parameters.beside_m));
}

/// Every cell_m / 4 where lanes may be paved, and a cell beside them; every cell_m farther out, where only light on grass is looked at.
std::vector<double> columns_of(const ExtentGrid& grid, const ExtentParameters& parameters) {
    double left_m = 0.0, right_m = 0.0;
    for (const CrossSection& section : grid.sections) {
        left_m = std::max(left_m, section.paved_left_m + parameters.cell_m);
        right_m = std::min(right_m, section.paved_right_m - parameters.cell_m);
    }
    const double across_m = parameters.cell_m / 4.0;
    const int beside = steps_in(parameters.beside_m, across_m);
    std::vector<double> offsets_m;
    for (int i = -beside; i <= beside; ++i) {
        const double offset_m = i * across_m;
        const bool fine = offset_m >= right_m && offset_m <= left_m;
        if (fine || i % 4 == 0 || std::abs(i) == beside)
            offsets_m.push_back(offset_m);
    }
    return offsets_m;
}

} // namespace

ExtentGrid make_extent_grid(const Route& route, const Moment& moment, double bumper_m, const ExtentParameters& parameters) {
    check(parameters);
    ExtentGrid grid;
    grid.target_height_m = parameters.target_height_m;
    const double bumper_at_m = moment.distance_m + bumper_m;
    const double ahead_m = std::min(parameters.ahead_m, route.length_m() - bumper_at_m);
    for (int i = 0; ahead_m >= 0.0 && i <= steps_in(ahead_m, parameters.cell_m); ++i)
        grid.ahead_m.push_back(i * parameters.cell_m);
    for (const double row_m : grid.ahead_m)
        grid.sections.push_back(route.cross_section(bumper_at_m + row_m));
    grid.offset_m = columns_of(grid, parameters);
    const std::size_t columns = grid.offset_m.size();
    grid.surface.resize(grid.ahead_m.size() * columns);
    oneapi::tbb::parallel_for(std::size_t{0}, grid.ahead_m.size(), [&](std::size_t row) {
        route.poses(bumper_at_m + grid.ahead_m[row], grid.offset_m, {&grid.surface[row * columns], columns});
    });
    grid.cell_m2 = cell_areas_m2(grid);
    return grid;
}

} // namespace fernlicht
