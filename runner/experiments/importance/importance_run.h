// Where in the beam one reading of a drive is decided.
#pragma once

#include "runner/experiments/importance/importance_result.h"
#include "runner/play/play.h"

namespace fernlicht {

struct ImportanceRequest : ExperimentRequest<ImportanceResult> {
    Drive drive;
    std::string lamp_set; ///< "": the drive's first
    std::string reading;  ///< as typed
    TickRange ticks;
    int check = 20; ///< random changes that are tried; 0: none
    std::uint64_t seed = 1;
};

/// Needs no device. Throws InputError for a reading that it cannot tell of, or that the drive does not measure.
ImportanceResult run_importance(const ImportanceRequest& request);

} // namespace fernlicht
