// Lux on the road from above.
#pragma once

#include "runner/findings/plots/figure.h"
#include "runner/findings/report.h"

namespace fernlicht {

/// A map's axes in metres from the car's origin, ahead to the right; nothing in it.
plots::Figure figure_over(const LuxMap& map, const std::string& title);

/// The map's samples over these axes; row 0 of a map lies farthest ahead.
plots::Grid grid_of(const LuxMap& map);

/// False colours on one fixed logarithmic scale (0.1 to 100 lx, so that any two maps compare), isolux lines at 1, 3, 5, 10, 30 and 50 lx,
/// lane and road edges. nullopt for an empty map.
std::optional<plots::Figure> lux_map_figure(const LuxMap& map, const std::string& lamp);

/// Rows of a map as columns, the farthest to the right.
Image<float> ahead_to_the_right(const Image<float>& lx);

/// Lux codes in the same colours, 0.1 to 100 lx.
Image<plots::Colour> lux_picture(const Image<std::uint8_t>& codes);

/// Several lamps' maps of one moment and extent: lines at 1, 5 and 20 lx in the lamps' colours and dashes; of one alone its colours. Small.
/// nullopt where the first map is empty.
std::optional<plots::Figure> isolux_figure(const std::vector<const LuxMap*>& maps, const std::vector<std::string>& lamps);

/// A map's lanes and the car as lines, in one colour.
void add_edges(plots::Figure& figure, const LuxMap& map, plots::Colour colour);

inline constexpr double isolux_lines_lx[] = {1.0, 3.0, 5.0, 10.0, 30.0, 50.0};

} // namespace fernlicht
