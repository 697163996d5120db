// What `fernlicht accuracy` found: errors against the reference beside times, ready to be written. The writers only format it.
#pragma once

#include "metrics/images/pixel_errors.h"
#include "metrics/statistics/work_precision.h"
#include "runner/experiments/accuracy/edge_errors.h"
#include "runner/experiments/bench/bench_result.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/reach_error.h"

namespace fernlicht {

/// One way to draw a drive's moments.
struct Configuration {
    std::string technique;
    int width_px = 0, height_px = 0;
    ShadowSettings shadows;
    std::optional<BeamTexels> beams; ///< nullopt: as fine as the technique takes them, in float
    std::string varied; ///< what differs from the drive's own way beside the technique: "resolution", "shadow maps", "shadow method"; ""
                        ///< for nothing
};
std::string beams_text(const std::optional<BeamTexels>& beams); ///< "512x128x8"; "float" for nullopt
std::string name_of(const Configuration& configuration);        ///< "photometric", "photometric, 512x384"

/// At which `accuracy` compares reach.
inline const std::vector<double> measured_thresholds_lx{1.0, 5.0};

struct ConfigurationResult {
    Configuration configuration;
    std::size_t moments = 0;                             ///< compared
    std::string no_illuminance, no_target, no_luminance; ///< why there are no errors; "" where there are
    std::optional<PixelErrors> road, whole, target, luminance;
    std::vector<double> road_p95; ///< of each moment with lit road
    std::vector<ReachError> reach;
    TimingSamples samples;
    std::vector<Work> work; ///< by moment
};

/// What one simplification costs by itself, on the road; nothing where no lamp shines.
struct Simplification {
    std::string name;
    std::optional<PixelErrors> errors;
};

/// Drawn by photometric against the double twin, pixels with at least 0.05 lx.
struct TwinAgreement {
    std::optional<PixelErrors> flat;           ///< where |d ln E / d angle| < 50 per radian
    std::optional<PixelErrors> steep_of_bound; ///< elsewhere: the error in shares of gradient times angle error (6e-6 rad) plus rounding
    std::size_t steep_within = 0;              ///< pixels of these with no more than that
    std::size_t several_surfaces = 0, shadow_edges = 0; ///< pixels left out
};

/// What the references of a drive's moments took.
struct ReferenceCost {
    double seconds = 0.0;
    std::uint64_t rays = 0;
    double median_samples = 0.0, max_samples = 0.0; ///< a pixel, over all pictures
};

struct DriveAccuracy {
    std::string drive, title, lamp_set;
    std::vector<std::pair<int, double>> moments; ///< tick and time in seconds
    ReferenceCost reference;
    std::vector<ConfigurationResult> configurations;
    std::vector<Simplification> simplifications;
    std::optional<TwinAgreement> twin;                               ///< where photometric took part
    std::vector<std::string> missing;                                ///< what was not measured because the sweep was ended, one clause each
    std::vector<std::pair<Configuration, std::string>> refused = {}; ///< ways that cannot draw the scene, and why
    std::vector<EdgeRow> edges = {}; ///< where photometric took part: the one exact ray, then each of its ways at that size
    bool others_shine = false;       ///< lamps of other vehicles or of streets, which the reference has and few techniques
    std::string shadow_choice = {};  ///< where the drive says `shadows: auto`: what was chosen and why, a clause
};

struct AccuracyResult : Findings {
    std::size_t cores = 0, rounds = 0;
    double target_error = 0.0;
    int max_samples = 0;
    OtherLoad others; ///< while times were taken
    std::vector<DriveAccuracy> drives;
    std::vector<WorkPrecision> diagrams;
};

/// Median of samples with its 95 % interval; of fewer than six samples from the least to the most, and the interval says so. nullopt for
/// none.
std::optional<Interval> time_of(const std::vector<double>& seconds);

/// Where soft-map is among what was drawn: that its lamps are discs and those of the one reference points. A clause.
std::optional<std::string> point_lamps_note(const DriveAccuracy& drive);

/// All techniques at the drive's own resolution and each other at which more than two ways were measured, then what resolutions, shadow
/// maps and shadow methods cost, where there is more than one of them.
std::vector<WorkPrecision> sweep_diagrams(const DriveAccuracy& drive);

/// docs/accuracy.md tells how to read it.
Document document(const AccuracyResult& result);
/// docs/accuracy.md and accuracy.schema.json describe it.
JsonMembers accuracy_members(AccuracyResult& result); ///< of its JSON; pictures do not come back
/// RFC 4180: a line for each row of each diagram.
std::string accuracy_csv(const AccuracyResult& result);

} // namespace fernlicht
