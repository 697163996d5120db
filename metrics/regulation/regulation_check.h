// A lamp's whole examination: aimed as the regulation says, held against its rows, and turned once more within the allowance if it fails.
#pragma once

#include "metrics/regulation/aim.h"
#include "metrics/regulation/row_check.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

struct CheckOptions {
    std::optional<AimRule> aim; ///< nullopt: the regulation's own
    const CandelaTable* aim_by =
        nullptr; ///< a passing beam whose aim this beam keeps; by `aim`, or automatically where that is as_is or maximum
    bool left_hand_traffic = false;
    bool re_aim = true; ///< makes use of the allowance
};

struct RegulationCheck {
    bool left_hand_traffic = false;
    std::vector<Aim> aims; ///< of each lamp
    Direction re_aimed;    ///< all lamps, on top of their aims
    bool was_re_aimed = false;
    std::vector<RowResult> rows; ///< as in the regulation; about the cut-off first, where the lamp was aimed by it
    RowVerdict verdict = RowVerdict::not_measured;
    std::vector<RowResult> as_filed;                        ///< rows whose verdict the aim changed, as they are without it
    RowVerdict verdict_as_filed = RowVerdict::not_measured; ///< of all rows without the aim; `verdict` where nothing was turned
};

/// One lamp, or the left and the right one where the regulation pairs. Under left-hand traffic the lamps are mirrored, and names and places
/// in the result mirrored back. Re-aiming tries the allowance in steps of 0.125 degrees, then finer round the best: the aim with the
/// fewest rows failed, then with the largest smallest margin; a lamp that no aim helps stays as first aimed. Throws InputError for
/// left-hand traffic of a regulation that has none.
RegulationCheck check_regulation(const Regulation& regulation, const std::vector<CandelaTable>& lamps, const CheckOptions& options = {});

/// "75R" of right-hand traffic is "75L" of left-hand traffic: capital L and R, left and right exchanged.
std::string mirrored_name(std::string name);

} // namespace fernlicht
