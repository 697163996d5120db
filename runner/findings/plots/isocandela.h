// The isocandela diagram of a lamp: its intensity as lux on a target 25 m ahead that faces it, over H and V.
#pragma once

#include "runner/findings/plots/figure.h"
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
/// `scale_peak_cd` in place of the table's own peak for colours and lines, so that two diagrams compare; 0: its own.
Figure isocandela_diagram(const CandelaTable& table, const std::string& title, const std::optional<AngleWindow>& window = std::nullopt,
                          double scale_peak_cd = 0.0);

/// The window that a diagram without one shows. The table must have light.
AngleWindow beam_window(const CandelaTable& table);

/// The levels of a diagram's lines in lux at 25 m: 1, 2, 5, 10 ... from a 300th of the peak on.
std::vector<double> isocandela_levels_lx(double peak_cd);

/// Lux at 25 m over the window; NaN where the table says nothing. Rows from the top.
Grid lux_over(const CandelaTable& table, const AngleWindow& window);

/// Degrees of H and V equally long, unless the figure would become a ribbon or a tower.
void fit_height(Figure& figure, const AngleWindow& window);

} // namespace fernlicht::plots
