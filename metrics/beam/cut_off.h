// The upper edge of a low beam as UN R112, R123 and R149 (annexes on the instrumental check) and FMVSS 108 (S10.18.9) measure it:
// its place, sharpness, straightness and kink. Right-hand traffic: level on the left, rising to the right; mirror the table for the left.
#pragma once

#include "metrics/beam/received_beam.h"

#include <array>
#include <optional>
#include <string>

namespace fernlicht {

/// Which G stands for a scan; the texts do not say.
enum class SharpnessRule { maximum, at_inflection };

struct CutOffOptions {
    SharpnessRule sharpness = SharpnessRule::maximum;
    /// The photometer's detector, a disc: 30 mm at 25 m are 0.0688 degrees. 0: a point.
    double detector_deg = 0.068755;
};

/// A straight scan. G(b) = log10 E(b) - log10 E(b + 0.1 deg), b upwards in vertical scans; in horizontal ones b runs to the right and G is
/// the rise. Scanned in steps of 0.01 degrees (the texts ask for 0.05 or less).
struct CutOffScan {
    double at_deg = 0.0; ///< H of a vertical scan, V of a horizontal one
    std::optional<double> sharpness;
    /// Where d2(log E)/db2 = 0, taken over 0.1 degrees: the middle of where G is within 20 % of its maximum, and 0.05 degrees on.
    std::optional<double> inflection_deg;
    double table_step_deg = 0.0;       ///< the file's own coarsest step there
    std::string reason;                ///< why sharpness or inflection is missing
    double position_error_deg = 0.005; ///< half a step of the scan, or of a file coarser than 0.1 degrees
    double scatter_deg = 0.0;          ///< how far the middle moves with the share of the maximum, 90 to 60 %
    /// Within which the inflection lies, in 99 of 100 beams.
    double uncertainty_deg() const;
};

struct CutOffFigures {
    CutOffScan level;                    ///< vertical, 2.5 degrees left: place and sharpness of the level part
    CutOffScan level_inner, level_outer; ///< 1.5 and 3.5 degrees left
    std::optional<double> linearity_deg; ///< highest less lowest inflection of these three; at most 0.2
    std::array<CutOffScan, 3> rise;      ///< vertical, 1, 2 and 3 degrees right
    /// Where the straight line through the rise's inflections (least squares) meets the level part. Missing where the three leave a
    /// straight line by more than their uncertainty, where the rise begins right of the first, or where they place the kink to worse than
    /// 0.2 degrees.
    std::optional<double> kink_h_deg;
    double kink_uncertainty_deg = 0.0;
    std::optional<double> rise_angle_deg; ///< of that line against the horizon; 15 degrees is usual
    CutOffScan shoulder;                  ///< horizontal, 0.37 degrees above the level part: the line at 0.2 D of an aimed lamp
    std::string kink_reason;              ///< why there is no kink
};

/// The steepest fall of log E between two V. Sharpness is missing where the file's own steps across it exceed 0.1 degrees, over which G is
/// taken: between such samples a G would be made up. Where the greatest G is below 0.08, the least that any aim accepts, there is no edge
/// and no inflection; nor where the file is too coarse for G and its mean over the steepest step (at least half a degree) is below that.
CutOffScan vertical_scan(const AimedLamp& lamp, double h_deg, double v_from_deg, double v_to_deg, const CutOffOptions& options = {});

/// Looks for the edge from 3 D to 2 U. All that cannot be had is missing with its reason.
CutOffFigures measure_cut_off(const AimedLamp& lamp, const CutOffOptions& options = {});

/// The least G of an edge that one may aim by; of the level part the texts ask for 0.13 to 0.40.
inline constexpr double min_sharpness = 0.08;

} // namespace fernlicht
