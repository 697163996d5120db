// The isocandela diagram of a lamp: its intensity as lux on a target 25 m ahead that faces it, over H and V.
#pragma once

#include "runner/plots/svg.h"
#include "scenarios/lamps/candela_table.h"

#include <optional>

namespace fernlicht::plots {

inline constexpr double cd_per_lx_at_25_m = 625.0;

/// Directions to be shown.
struct AngleWindow {
    double left_deg = 0.0, right_deg = 0.0, bottom_deg = 0.0, top_deg = 0.0;
};

/// Log scale over three decades below the peak, lines at 1, 2, 5 ... lx, H-H and V-V, the peak. Without a window it shows the
/// directions with at least 5 % of the peak. Directions outside the table and gaps in it are grey. A table without light gives an empty
/// diagram that says so.
Figure isocandela_diagram(const CandelaTable& table, const std::string& title, const std::optional<AngleWindow>& window = std::nullopt);

} // namespace fernlicht::plots
