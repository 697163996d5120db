// The elbow of a low beam's cut-off, by a fit of our own over all columns of the file: for beams whose rise the texts' three verticals
// miss.
#pragma once

#include "metrics/beam/received_beam.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// Where one column of the file ends upwards.
struct EdgePoint {
    double h_deg = 0.0, v_deg = 0.0;
    double error_deg = 0.0; ///< what the file's steps leave open
    bool used = true;       ///< false: too far from the fit to count
};

/// Level part up to the elbow, a straight rise of free length, then level again where the rise ends within the columns looked at.
struct CutOffElbow {
    std::optional<Direction> at;         ///< the elbow
    Direction uncertainty;               ///< holds in 99 of 100 beams
    double rise_angle_deg = 0.0;         ///< against the horizon
    std::optional<double> rise_to_h_deg; ///< where the shoulder begins
    std::vector<EdgePoint> points;       ///< by H
    std::string reason;                  ///< why there is no elbow
    double edge_deg(double h_deg) const; ///< V of the fit; needs `at`
};

/// Looks from 5 degrees left to 6 right and 3.5 D to 5 U, on the file's own samples: in each column for the middle of the steepest fall of
/// log I, taken over 0.3 degrees or two steps. The fit leaves the smallest squares, less columns that lie off by more than four times the
/// median. No elbow where the rise is below 3 degrees, spans fewer than two columns, or H would be known worse than to 0.1 degrees and to
/// one step of the file. Right-hand traffic: mirror the table for the left.
CutOffElbow fit_elbow(const AimedLamp& lamp);

} // namespace fernlicht
