// Error against run time of all but techniques: each study varies one thing and compares it with a much finer one. Whoever
// runs it adds drive and lamp set to names and titles.
#pragma once

#include "metrics/statistics/work_precision.h"
#include "renderer/device.h"
#include "renderer/reference/reference.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/accuracy/technique_sweep.h"
#include "runner/play/stage.h"
#include "scenarios/vehicle/solver_study.h"

#include <functional>

namespace fernlicht {

/// Asked before each row; false: no more rows.
using StudyGoesOn = std::function<bool()>;

/// Size and depth of a texture of the lamp set's first lamp: error of the intensity against the candela table, over the time to make it.
WorkPrecision beam_study(const LampSet& lamp_set, const StudyGoesOn& go_on);

/// Cell of the extent grid: error of reach on the own lane's centre against cells of 1/16 m, over the time a moment, by the twin.
WorkPrecision extent_study(const Stage& stage, const LampSet& lamp_set, const StudyGoesOn& go_on);

/// Time step of the drive: error of the median, 5 % and 95 % of reach over the drive against 256 moments, over the time for the drive.
WorkPrecision step_study(const Stage& stage, const LampSet& lamp_set, const StudyGoesOn& go_on);

/// Samples of the reference, direct and path traced: error of a pixel's mean against many more samples of another seed, over the time of a
/// picture of 64 x 48 pixels, a diagram each. The slope over the samples stands in the notes.
std::vector<WorkPrecision> reference_study(const Stage& stage, const LampSet& lamp_set, std::uint64_t seed, const StudyGoesOn& go_on);

/// Comparing pictures on every n-th pixel: error of root mean square and of the share of pixels beyond 1 %, over the time.
WorkPrecision metrics_study(const Stage& stage, const LampSet& lamp_set, Device& device, const StudyGoesOn& go_on);

/// Period of lamp control: error of the swivel against a period of 0.25 ms, over the time of the run. Of no drive.
WorkPrecision control_study(const StudyGoesOn& go_on);

/// Times `work` so often that it takes a tenth of a second, at least three and at most 25 times.
Interval timed(const std::function<void()>& work);

/// Least lux of others' light: worst and 95 % error of illuminance in the driver's view against every lamp with its own beam and nothing
/// left out, over the time of a frame in colour; and every lamp with its own beam at the drive's least lux. The drive's middle moment. No
/// rows without lamps of others.
WorkPrecision traffic_study(const Stage& stage, const LampSet& lamp_set, Device& device, const StudyGoesOn& go_on);

/// One diagram for each of fog, wet road, sun or moon and lamps beside the road that the middle moment has; none where it has none. Error
/// of luminance, 95 % of the pixels with at least 0.001 cd/m2, against the reference's direct light by the ray through each pixel's centre,
/// surfaces without their textures and other road users' lamps switched off, so that nothing but this light is compared; over the
/// time of a frame. Throws DeviceError.
std::vector<WorkPrecision> weather_study(const Stage& stage, const LampSet& lamp_set, Device& device, const StudyGoesOn& go_on);

/// The classical global methods, direct light and path tracing: how far from the whole light each is, and what it costs.
struct ClassicalStudy {
    int truth_samples = 4096;                                     ///< a pixel, of the paths that all is held against
    std::vector<int> samples{128, 512, 2048};                     ///< of direct light, Whitted's and paths, which take no fewer than 128
    std::vector<double> patches_m{4.0, 2.0, 1.0};                 ///< of radiosity
    std::vector<std::int64_t> photons{1 << 16, 1 << 18, 1 << 20}; ///< the disc is solver.radius_m at the most, wider as photons^(-1/6)
    int gather_samples = 128;                                     ///< a pixel, of radiosity and photon map
    SolverSettings solver;                                        ///< what is not varied
    std::uint64_t seed = 1;                                       ///< the truth has another
};

/// Illuminance in one view of one moment. Error: what 95 % of the pixels with at least 0.05 lx do not exceed, in per cent of path tracing;
/// the medians, the signed mean and the rays stand in the parameters. Floor: the same of two standard errors of the truth. Time: of the
/// picture, solving included, one run. `go_on` is asked before each picture; false: no more rows.
WorkPrecision classical_study(const Scene& scene, const Moment& moment, const View& view, const ClassicalStudy& study,
                              const std::function<bool()>& go_on);

/// Rows of a study in the form of the other diagrams; their order stays. Bars of the times: least and most of the repetitions.
std::vector<WorkPrecision> solver_diagrams(const std::vector<SolverRow>& rows);

/// Without them, and with maps of some sizes: the share of the driver's view, lit by others, that is wrongly lit or dark against a ray from
/// each pixel to each lamp, over the time of a frame in colour with all lamps. Error: of five moments evenly spread over the drive
/// together; time: of the middle one and the one before it, in turn. No rows without lamps of others, and for drives without shadows.
WorkPrecision traffic_shadow_study(const Stage& stage, const LampSet& lamp_set, Device& device, const StudyGoesOn& go_on);

struct AccuracyRequest : ExperimentRequest<AccuracyResult> {
    std::vector<Drive> drives;
    SweepRequest sweep;
    std::vector<std::string> diagrams{"techniques"}; ///< of diagram_names()
};

/// "techniques", "reference", "classical", "solvers", "control", "extent", "beam", "metrics", "step", "shadows" ...
std::vector<std::string> diagram_names();

/// Ends after the step at hand when interrupted, and writes what there is. Throws InputError and DeviceError.
AccuracyResult run_accuracy(const AccuracyRequest& request);

} // namespace fernlicht
