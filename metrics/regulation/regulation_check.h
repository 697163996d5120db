// A lamp's whole examination: aimed as the regulation says, judged by its rows, and turned once more within the allowance if it fails.
// Aiming before the photometry, as each regulation's procedure says.
#pragma once

#include "metrics/beam/cut_off.h"
#include "metrics/regulation/regulation.h"
#include "metrics/regulation/row_check.h"

#include <optional>
#include <string>
#include <vector>

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
    std::string why_not;                  ///< the reason within `how`; "" where all was found
};

/// Where the procedure finds nothing to aim by, the beam stays as filed in that direction. The UN's rules first turn the elbow, where one
/// is found, to where it belongs, by any angle, and then correct until the scans themselves lie where they belong (to 0.002 degrees). Each
/// correction must be smaller than the one before, else the beam has not converged and stays as filed; what is within the scans' own
/// uncertainty need not shrink.
Aim aim_of(const CandelaTable& lamp, AimRule rule);

/// By which rule a passing beam is aimed whose aim another beam keeps: `asked`, or automatic where that is as_is or maximum.
AimRule rule_of_aim_by(AimRule asked);

/// Where the UN's procedures put the level part (1 %), line A, and where FMVSS 108 puts the greatest gradient.
inline constexpr double line_b_deg = -0.57, line_a_deg = 0.5, vol_deg = -0.4, vor_deg = 0.0;
inline constexpr double vol_scan_h_deg = -2.5, vor_scan_h_deg = 2.0;

struct CheckOptions {
    std::optional<AimRule> aim;           ///< nullopt: the regulation's own
    const CandelaTable* aim_by = nullptr; ///< a passing beam whose aim this beam keeps, by rule_of_aim_by(aim)
    bool left_hand_traffic = false;
    bool re_aim = true;   ///< makes use of the allowance
    bool as_filed = true; ///< holds the lamp against the rows without its aim, too; false where the rows themselves follow from the aim
};

struct RegulationCheck {
    bool left_hand_traffic = false;
    std::vector<Aim> aims; ///< of each lamp
    Direction re_aimed;    ///< all lamps, on top of their aims
    bool was_re_aimed = false;
    std::vector<RowResult> rows; ///< as in the regulation; about the cut-off first, where the lamp was aimed by it
    RowVerdict verdict = RowVerdict::not_measured;
    std::vector<RowResult> as_filed;            ///< rows whose verdict the aim changed, as they are without it
    std::optional<RowVerdict> verdict_as_filed; ///< of all rows without the aim; `verdict` where nothing was turned; nullopt: not asked
};

/// One lamp, or the left and the right one where the regulation pairs. Under left-hand traffic the lamps are mirrored, and names and places
/// in the result mirrored back. Re-aiming tries the allowance in steps of 0.125 degrees, then finer round the best: the aim with the
/// fewest rows failed, then with the largest smallest margin; a lamp that no aim helps stays as first aimed. Throws InputError for
/// left-hand traffic of a regulation that has none.
RegulationCheck check_regulation(const Regulation& regulation, const std::vector<CandelaTable>& lamps, const CheckOptions& options = {});

/// "75R" of right-hand traffic is "75L" of left-hand traffic: capital L and R, left and right exchanged.
std::string mirrored_name(std::string name);

} // namespace fernlicht
