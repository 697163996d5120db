// Aiming before the photometry, as each regulation's procedure says.
#pragma once

#include "metrics/beam/cut_off.h"
#include "metrics/regulation/regulation.h"

#include <optional>
#include <string>

namespace fernlicht {

struct Aim {
    AimRule rule = AimRule::as_is;        ///< the one that aimed; of AimRule::automatic the last one tried
    Direction turned;                     ///< how far the beam was turned to the right and up
    Direction bound;                      ///< of `turned`, in 99 of 100 beams; 0 in a direction that was not aimed
    Direction residual;                   ///< what the last round still found off
    int rounds = 0;                       ///< measurements of the turned beam
    std::string how;                      ///< what was found and what was done, one sentence without a full stop
    bool found = true;                    ///< false: the procedure found nothing to aim by in one direction or both; `how` says why
    std::optional<CutOffFigures> cut_off; ///< of the aimed lamp, where it was aimed by it
};

/// Where the procedure finds nothing to aim by, the beam stays as filed in that direction. The UN's rules first turn the elbow, where one
/// is found, to where it belongs, by any angle, and then correct until the scans themselves lie where they belong (to 0.002 degrees). Each
/// correction must be smaller than the one before, else the beam has not converged and stays as filed; what is within the scans' own
/// uncertainty need not shrink.
Aim aim_of(const CandelaTable& lamp, AimRule rule);

/// Where the UN's procedures put the level part (1 %), line A, and where FMVSS 108 puts the greatest gradient.
inline constexpr double line_b_deg = -0.57, line_a_deg = 0.5, vol_deg = -0.4, vor_deg = 0.0;
inline constexpr double vol_scan_h_deg = -2.5, vor_scan_h_deg = 2.0;

} // namespace fernlicht
