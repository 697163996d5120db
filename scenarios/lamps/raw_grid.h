// A text grid as its file has it: own signs, units and origin.
#pragma once

#include "scenarios/lamps/grid_lines.h"
#include "scenarios/lamps/measured_grid.h"

#include <cmath>
#include <cstdint>

namespace fernlicht {

struct RawGrid {
    MeasuredGrid grid;
    std::vector<std::uint32_t> lines; ///< of each value
};

/// By the recipe's layout: `matrix` or `transposed`, and `list`. Throw InputError.
RawGrid read_matrix_grid(const std::filesystem::path& file, const GridRecipe& recipe, GridLines& in);
RawGrid read_list_grid(const GridRecipe& recipe, GridLines& in, Notes& notes);

/// Throws InputError at the line read last.
void refuse_too_many(std::size_t values, const GridLines& in);

/// Steps of 0.1 stay short in print.
inline double rounded_angle(double angle) { return std::round(angle * 1e9) / 1e9 + 0.0; }

} // namespace fernlicht
