// Lamps of a drive fitted to readings of a luxmeter.
#pragma once

#include "runner/experiments/fit/fit_result.h"
#include "scenarios/drives/drive.h"

namespace fernlicht {

struct FitRequest : ExperimentRequest<FitResult> {
    Drive drive;
    std::string lamp_set; ///< "": the drive's first
    std::filesystem::path points;
    /// Lamps by name ("" for all) and what of them keeps the drive's value; as typed, "height" or "left.yaw".
    std::vector<std::string> hold;
};

/// Needs no device. Throws InputError for points that cannot be read, lie outside the drive or name lamps that are not there or off.
FitResult run_fit(const FitRequest& request);

/// The drive whose lamp set has its lamps as fitted: aims (also those of changes), flux factors and places.
Drive as_fitted(Drive drive, const std::string& lamp_set, const Shifts& shifts);

} // namespace fernlicht
