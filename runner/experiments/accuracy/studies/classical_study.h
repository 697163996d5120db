// The classical global methods, direct light and path tracing on one diagram: how far from the whole light each is, and what it costs.
#pragma once

#include "metrics/statistics/work_precision.h"
#include "renderer/reference/reference.h"

#include <functional>

namespace fernlicht {

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

} // namespace fernlicht
