// Aliasing of frames that others drew: their motion by optical flow, since nothing is known of how they were drawn.
#pragma once

#include "runner/experiments/aliasing/aliasing_result.h"

namespace fernlicht {

struct SequenceRequest {
    std::filesystem::path sequence;               ///< folder of frames
    std::optional<std::filesystem::path> against; ///< the same frames drawn 4, 6 ... 16 times as fine each way
    std::optional<std::pair<int, int>> frames;    ///< first and last number, both included
    double rate_hz = 0.0;
    std::optional<double> pixels_per_degree, view_fov_deg; ///< one of the two; the latter the view's vertical angle
    std::filesystem::path folder;
    std::vector<std::string> command;
    bool quiet = false;
    std::function<void(const AliasingResult&)> write; ///< takes what was found; the folder is there
};

/// With `against`, aliasing over space and time as for drives, but motion is estimated on what the display could show. Without, only how
/// points of the scene flicker; what of it is light that really changes within 1/4 s is not told apart. Ends after the step at hand when
/// interrupted, and writes what there is. Throws InputError and DeviceError.
AliasingResult run_sequence_aliasing(const SequenceRequest& request);

} // namespace fernlicht
