// Draws one moment of a drive by the reference, can be interrupted, and writes the result.
#pragma once

#include "runner/experiments/reference/reference_result.h"

#include <functional>

namespace fernlicht {

struct ReferenceRequest {
    Drive drive;
    std::string lamp_set, view; ///< "": the drive's first, the driver's
    double moment_s = 0.0;
    ReferenceSettings settings;
    std::filesystem::path folder;
    bool resolution_asked = false; ///< for the view, which a map has none of
    bool resume = false, quiet = false;
    std::vector<std::string> command;
    std::function<void(const ReferenceResult&)> write; ///< its plots into the folder, before that is marked as complete
};

/// Throws InputError (no such view or lamp set, a moment outside the drive, a resolution for a map, a folder that is not empty, a
/// checkpoint of other inputs),
/// DeviceError. A picture that was interrupted comes back incomplete, its checkpoint in the folder.
ReferenceResult run_reference(const ReferenceRequest& request);

} // namespace fernlicht
