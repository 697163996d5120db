// Lux on the road from above.
#pragma once

#include "runner/findings/report.h"
#include "runner/write/plots/svg.h"

namespace fernlicht::plots {

/// Ahead to the right: false colours on one fixed logarithmic scale (0.1 to 100 lx, so that any two maps compare), isolux lines at 1, 3, 5,
/// 10, 30 and 50 lx, lane and road edges, metres from the car's origin. "" for an empty map.
std::string lux_map_svg(const LuxMap& map, const std::string& lamp);

/// A map's lanes and the car as lines, in one colour.
void add_edges(Figure& figure, const LuxMap& map, Colour colour);

} // namespace fernlicht::plots
