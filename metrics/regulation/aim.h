// Aiming before the photometry, as each regulation's procedure says.
#pragma once

#include "metrics/cut_off.h"
#include "metrics/regulation/regulation.h"

#include <optional>
#include <string>

namespace fernlicht {

struct Aim {
    AimRule rule = AimRule::as_is;
    Direction turned;                     ///< how far the beam was turned to the right and up
    std::string how;                      ///< what was found and what was done, one sentence without a full stop
    bool found = true;                    ///< false: the procedure found nothing to aim by in one direction or both; `how` says why
    std::optional<CutOffFigures> cut_off; ///< of the aimed lamp, where it was aimed by it
    double position_error_deg = 0.0;
};

/// Where the procedure finds nothing to aim by, the beam stays as it is in that direction. The UN's rules are repeated until the scans
/// themselves lie where they belong on the aimed lamp (to 0.002 degrees, at most 20 rounds).
Aim aim_of(const CandelaTable& lamp, AimRule rule);

/// Where the UN's procedures put the level part (1 %), line A, and where FMVSS 108 puts the greatest gradient.
inline constexpr double line_b_deg = -0.57, line_a_deg = 0.5, vol_deg = -0.4, vor_deg = 0.0;
inline constexpr double vol_scan_h_deg = -2.5, vor_scan_h_deg = 2.0;

} // namespace fernlicht
