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

/// A map's lanes and the car as lines, in one colour.
void add_edges(plots::Figure& figure, const LuxMap& map, plots::Colour colour);

inline constexpr double isolux_lines_lx[] = {1.0, 3.0, 5.0, 10.0, 30.0, 50.0};

} // namespace fernlicht
