// What masks cost in light and spare in glare over a drive, by margin.
#pragma once

#include "runner/experiments/masks/masks_result.h"

namespace fernlicht {

struct MasksRequest : ExperimentRequest<MasksFound> {
    Drive drive;
    std::vector<double> margins_deg; ///< tried beside the lamp sets' own; 0 to 10
    std::string against = "high";    ///< lamp set whose light counts as full
    Rating limits;                   ///< photometers on road users, and limits over distance
    MaskPlaces places;               ///< the kerb's side is the drive's
};

/// By the twin: needs no device. Throws InputError for a drive of which no lamp set masks anybody, on a wet road, or without `against`.
MasksFound run_masks(const MasksRequest& request);

} // namespace fernlicht
