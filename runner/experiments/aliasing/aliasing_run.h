// Aliasing on a real device: moments of a drive drawn in several ways, each held against a supersampled reference.
#pragma once

#include "runner/experiments/aliasing/aliasing_result.h"

namespace fernlicht {

struct AliasingRequest : ExperimentRequest<AliasingResult> {
    Drive drive;                                  ///< with one perspective view at least
    std::string lamp_set;                         ///< "": the drive's first
    std::optional<double> moment_s;               ///< nullopt: the middle of the drive
    std::optional<std::pair<int, int>> frames;    ///< first and last, both included; measured over time
    std::vector<std::string> techniques;          ///< empty: the drive's
    std::vector<std::optional<BeamTexels>> beams; ///< the first for all, the others beside it; at least one, as the next two
    std::vector<int> samples;
    std::vector<SurfaceFilter> filters;
    int supersample = 4;    ///< of the reference, each way; even, at least 4
    bool displayed = false; ///< measure the tone-mapped picture instead of the scene's luminance
    double level_lx = 1.0;
    bool flow = false; ///< hold optical flow against the motion that is known, on the first way's pictures; with `frames`
};

/// What is drawn: each technique with the first beams, samples and filter, then the others one at a time. Throws InputError for a technique
/// that is unknown or comes twice.
std::vector<AliasingConfiguration> aliasing_configurations(const AliasingRequest& request);

/// Ends after the step at hand when interrupted, and writes what there is. Throws InputError and DeviceError.
AliasingResult run_aliasing(const AliasingRequest& request);

struct SequenceRequest : ExperimentRequest<AliasingResult> {
    std::filesystem::path sequence;               ///< folder of frames
    std::optional<std::filesystem::path> against; ///< the same frames drawn 4, 6 ... 16 times as fine each way
    std::optional<std::pair<int, int>> frames;    ///< first and last number, both included
    double rate_hz = 0.0;
    std::optional<double> pixels_per_degree, view_fov_deg; ///< one of the two; the latter the view's vertical angle
};

/// With `against`, aliasing over space and time as for drives, but motion is estimated on what the display could show. Without, only how
/// points of the scene flicker; what of it is light that really changes within 1/4 s is not told apart. Ends after the step at hand when
/// interrupted, and writes what there is. Throws InputError and DeviceError.
AliasingResult run_sequence_aliasing(const SequenceRequest& request);

} // namespace fernlicht
