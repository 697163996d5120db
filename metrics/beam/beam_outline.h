// The shape of a beam wherever it points: where it ends upwards and downwards, how wide and how high it is.
#pragma once

#include "metrics/beam/received_beam.h"
#include "scenarios/lamps/lamp_file.h"

#include <optional>
#include <vector>

namespace fernlicht {

struct BeamOutline {
    Peak peak;
    double flux_lm = 0.0;
    double concentration = 0.0;                    ///< share of the flux within 15 degrees of the peak
    std::optional<double> height_to_width;         ///< r.m.s. V over r.m.s. H of what has 5 % of the peak or more, within 25 degrees of it
    std::vector<Direction> upper_edge, lower_edge; ///< by columns half a degree apart within 6 degrees of the middle; empty: no edge
    double middle_h_deg = 0.0;                     ///< 0, or the peak's H where that is farther than 10 degrees aside

    /// V of an edge's level part: the median of its lower side, of the lower edge of its higher one, between 1.5 and 6 degrees from the
    /// middle.
    std::optional<double> upper_level_deg() const;
    std::optional<double> lower_level_deg() const;
    /// By how much the upper edge lies higher on the right of the middle than on its left; nullopt where a side has fewer than 3 columns.
    std::optional<double> rise_deg() const;
    /// H where the upper edge leaves its level part, to about 0.3 degrees: by where it has risen by 0.15 and by 0.45 degrees; nullopt where
    /// it does not rise so far, or not steadily.
    std::optional<double> elbow_h_deg() const;
};

/// An edge is a fall from the light on its one side to that on the other, each the mean over half a degree and two tenths apart (over the
/// file's step where that is larger), by a factor of 5 at least and twice that on the column's other side; in 60 % of the columns that hold
/// 5 % of the peak, and at least eight.
BeamOutline outline_of(const LampFile& lamp);

/// How far the file's own samples lie apart in V round a direction, degrees; nullopt outside its samples.
std::optional<double> step_in_v(const LampFile& lamp, Direction at);

} // namespace fernlicht
