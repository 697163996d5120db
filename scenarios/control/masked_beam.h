// A beam with some of its windows dark: what a glare-free high beam sends out.
#pragma once

#include "scenarios/lamps/candela_table.h"

namespace fernlicht {

/// Between a dark window and its lit neighbour the light rises over this angle, inside the neighbour.
inline constexpr double window_edge_deg = 0.1;

/// The table with the intensity of each window of H times its level; where windows meet, the darker one holds. Outside the windows nothing
/// changes. `windows_deg`: from, to, ascending; `levels`: one each, 0 to 1. Throws std::invalid_argument for a wrong number of levels.
CandelaTable masked(const CandelaTable& table, const std::vector<std::pair<double, double>>& windows_deg,
                    const std::vector<double>& levels);

} // namespace fernlicht
