// What readings cannot tell: unknowns to be held, and why.
#pragma once

#include "metrics/fit/descent.h"

#include <string>

namespace fernlicht {

/// Of what cannot be told, that of the highest rank is held: height, which a tape measures, before yaw, pitch and flux; without a cut-off
/// in sight aim stands behind flux.
int held_rank(Unknown unknown);

struct Undetermined {
    std::vector<std::size_t> groups; ///< into the free groups: one to be held, or several that are to change alike
    bool alike = false;
    std::string why; ///< "no point's light changes with it"
};

/// The one that is known worst, by a weighted Jacobian by groups; nullopt where all are known. `name` of an unknown: "pitch of left".
std::optional<Undetermined> worst_known(const Matrix& jacobian, const FreeGroups& free, const std::vector<std::string>& names);

} // namespace fernlicht
