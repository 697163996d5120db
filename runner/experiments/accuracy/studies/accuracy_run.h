// Accuracy on a real device: drives held against the reference, and the result written.
#pragma once

#include "runner/experiments/accuracy/technique_sweep.h"

namespace fernlicht {

struct AccuracyRequest {
    std::vector<Drive> drives;
    SweepRequest sweep;
    std::vector<std::string> diagrams{"techniques"}; ///< of diagram_names()
    std::string backend = "auto";
    std::filesystem::path folder; ///< for the files; made when all input is read and the device is found sane
    std::vector<std::string> command;
    bool quiet = false;
    std::function<void(const AccuracyResult&)> write; ///< takes what was found, also when it was interrupted; the folder is there
};

/// "techniques", "reference", "classical", "solvers", "control", "extent", "beam", "metrics", "step", "shadows" ...
std::vector<std::string> diagram_names();

/// Ends after the step at hand when interrupted, and writes what there is. Throws InputError and DeviceError.
AccuracyResult run_accuracy(const AccuracyRequest& request);

} // namespace fernlicht
