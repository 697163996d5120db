// Techniques, resolutions and shadow maps of one drive held against the reference and timed in turns.
#pragma once

#include "renderer/device.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/accuracy/picture_errors.h"
#include "runner/play/stage.h"

#include <functional>

namespace fernlicht {

struct SweepRequest {
    std::string lamp_set;                         ///< "": the drive's first
    std::vector<std::string> techniques;          ///< empty: all
    std::vector<std::pair<int, int>> resolutions; ///< pixels, the first for all; empty: the drive's, and 1/2 and 1/4 of it
    std::vector<std::pair<int, int>> shadow_maps; ///< texels, the first for all; empty: 1024 x 512, twice, 1/2 and 1/4 of it
    std::vector<std::optional<BeamTexels>> beams; ///< the first for all; empty: the drive's, and some finer and coarser ones
    bool shadow_methods = false;                  ///< photometric by each shadow method, too; the reference then has shadows in any case
    bool full = false;                            ///< every technique with every resolution, shadow map and beam; else one varied at a time
    int moments = 3, rounds = 7;
    double target_error = 0.005; ///< wanted standard error of the reference, in shares
    int max_samples = 256;       ///< of the reference, a pixel
    std::uint64_t seed = 1;
};

/// What is drawn, in order: each technique the drive's own way, then, one at a time, the other resolutions and
/// beams (of `photometric` and `full`) and shadow maps and methods (of `photometric`), as far as these take part. Throws InputError for a
/// technique that is unknown or comes twice.
std::vector<Configuration> configurations_of(const SweepRequest& request, const Drive& drive);

/// Throws InputError for what sweep_techniques would.
void check_sweep(const SweepRequest& request, const Stage& stage);

/// Called with the number of steps done of how many; false ends the sweep.
using StepsDone = std::function<bool(std::size_t done, std::size_t all, const std::string& at)>;

/// Errors first, moment by moment, then times in seeded random order. Ends early when `go_on` says so, or when `stop` is true in the
/// middle of a picture of the reference, with all that was done and a word on what is missing; a configuration that was compared in no
/// moment is not in the result. Throws InputError and DeviceError.
DriveAccuracy sweep_techniques(const Stage& stage, Device& device, const SweepRequest& request, const StepsDone& go_on,
                               const StopAsked& stop = {});

/// How a drive is drawn in a configuration.
RendererSettings settings_of(const Drive& drive, const Configuration& configuration);

/// What each simplification of the published techniques costs by itself, from the formulas in double precision: the right equation with one
/// thing changed. In the table's order: no cosine; 1 + d^2 for d^2; 1 + d for d^2; one lamp's distance for all; distance from the
/// triangle's vertices; beam textures of the founding thesis's size in float and in its 8 bits; and what as-published `full` has of these
/// together. The distance from the vertices depends on how the road is cut into triangles. Errors of illuminance by lamps without shadows
/// on the carriageway up to 120 m around the car, at points spread evenly over its area (pictures: indices of the moments; pixels: no
/// places).
std::vector<Simplification> price_simplifications(const Stage& stage, const std::vector<Moment>& moments);

} // namespace fernlicht
