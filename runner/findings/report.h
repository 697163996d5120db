// What a run found, ready to be written: context, rows, pictures, verdicts. Filled by the play loop, formatted by the writers.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/images/pixel_errors.h"
#include "metrics/readings/value.h"
#include "metrics/road/extent.h"
#include "metrics/statistics/statistics.h"
#include "renderer/renderer.h"
#include "runner/findings/findings.h"
#include "runner/findings/lamp_aim.h"
#include "runner/findings/lamp_checks.h"
#include "runner/findings/pixel_levels.h"
#include "runner/findings/reach_error.h"
#include "scenarios/drives/play/bus_report.h"
#include "scenarios/drives/play/frame.h"

#include <compare>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

/// A picture stored at a captured moment; paths are relative to the report's folder.
struct StoredFrame {
    int tick = 0;
    double time_s = 0.0;
    std::string view;
    std::string png, exr;      ///< "" when not stored
    std::string shown_by = {}; ///< as the PNG has it; only where a page lays pictures over each other. Not part of the report
};

/// Lux on the road seen from above at one moment, for the bird's-eye picture. Row 0 is the farthest ahead; columns from left to right.
struct LuxMap {
    Image<float> lx;
    double ahead_m = 0.0, behind_m = 0.0, left_m = 0.0, right_m = 0.0; ///< extent from the car's origin
    struct Polyline {
        std::string kind;
        std::vector<std::pair<double, double>> ahead_left_m;
    }; ///< kind: "lane edge", "road edge", "car"; straight map coordinates
    std::vector<Polyline> edges;
    int tick = 0;
    double time_s = 0.0;
};

/// Illuminance where a view looks at one moment, small and rounded (lux_codes.h).
struct LuxView {
    Image<std::uint8_t> codes;
    std::string view;
    int tick = 0;
};

/// Which of a moment's extents.
struct ExtentKey {
    Surface surface = Surface::road;
    std::string lane;
    double threshold_lx = 0.0;
    auto operator<=>(const ExtentKey&) const = default;
};

/// What the moments' extents of one key add up to.
struct ExtentSummary {
    ExtentKey key;
    bool same_direction = true;                         ///< as LaneExtent has it
    std::map<ReadingKey, CensoredSamples> moments = {}; ///< of extent_figures(), without a statistic; widths by distance ahead
    /// Of the figures themselves by the twin: as the lamps are, then nudged in the order of NudgeKind.
    std::map<ReadingKey, std::array<CensoredSamples, 1 + nudge_kinds>> nudged = {};
    std::size_t cut_off = 0; ///< moments whose reach is a lower bound, by road's end or grid's
};

/// Extents of one moment.
struct ExtentRow {
    int tick = 0;
    double time_s = 0.0, distance_m = 0.0;
    std::vector<LaneExtent> rendered, twin;
    std::vector<GridError> grid_errors;
    NudgedExtents nudged;
};

struct PassTime {
    std::string name;
    std::vector<double> seconds;
};

/// How fast a drive was played, beside what its drawing alone takes. Without the warm-up.
struct Throughput {
    int moments = 0;
    double wall_s = 0.0;             ///< until the last of them was measured and its last file written
    std::optional<double> view_s;    ///< mean, the driver's view drawn and read back with nothing beside it
    std::optional<double> drawing_s; ///< mean a moment, all that is drawn and read back, likewise: with extent map, probes, stored views
    double peak_memory_mib = 0.0;    ///< resident, of the whole process until the drive's end

    std::optional<double> moments_per_s() const { return wall_s > 0.0 ? std::optional(moments / wall_s) : std::nullopt; }
    /// Of the rate that would be reached if a moment took only `alone_s`.
    std::optional<double> share_of(const std::optional<double>& alone_s) const {
        return alone_s && wall_s > 0.0 ? std::optional(*alone_s * moments / wall_s) : std::nullopt;
    }
};

/// What leaving out saves: frames of the driver's view drawn in turns, as the run draws them and with nothing left out.
struct PruningSavings {
    std::vector<int> ticks;                   ///< the moments drawn
    std::vector<double> pruned_s, unpruned_s; ///< by round: a frame, back to back
    Work pruned, unpruned;                    ///< of each count the median over the moments
    std::string not_measured;                 ///< why there are no times; "" where there are

    /// pruned against unpruned; below 1: faster. nullopt without times.
    std::optional<PairedRatio> ratio() const { return paired_ratio(pruned_s, unpruned_s); }
};

/// How far the lux images of what was played lie from the reference: the drive's own point of error against run time.
struct DriveError {
    std::vector<int> ticks; ///< the moments compared
    int width_px = 0, height_px = 0;
    int tiles = 0, tiles_of = 0;                  ///< compared, at random; in all moments' pictures
    double lamp_radius_m = 0.0;                   ///< of lamps in the reference: discs, but for reach; 0: points
    std::optional<PixelErrors> road, whole;       ///< of illuminance, in the driver's view; road: by area
    std::optional<PixelErrors> target, luminance; ///< of targets above the road; of the whole view
    std::string no_target, no_luminance;          ///< why the technique has none; "" where it has
    std::vector<double> road_p95;                 ///< of each moment with lit road
    std::vector<ReachError> reach;                ///< at the drive's limits; empty where it measures no extent
    std::uint64_t rays = 0;                       ///< of the reference
    double seconds = 0.0;                         ///< what comparing took
    std::string not_measured;                     ///< why there are none; "" where there are, and where the run was told to leave it out

    bool measured() const { return !ticks.empty(); }
};

/// What the car and its lamp actuators do at one moment of a drive with a vehicle.
struct CarRow {
    double time_s = 0.0;
    double pitch_deg = 0.0;                          ///< of the body against the road under its axles, nose up positive
    double rear_lift_mm = 0.0;                       ///< of the body over the rear axle, from the rest on a level road
    std::optional<double> levelling_deg, swivel_deg; ///< of the lamps, up and left positive; where the lamp set has them
    std::optional<double> roll_deg = {};             ///< of the body against the road, left side up positive; where the car has it

    bool operator==(const CarRow&) const = default;
};

/// A reading over the repeats of a run.
struct ReadingSpread {
    ReadingKey key;
    int tick = -1;                     ///< -1: of the whole drive
    int count = 0;                     ///< repeats in which it was measured
    double mean = 0.0, variance = 0.0; ///< the sample's (n - 1)
};

/// The same lamp set played several times.
struct Repeats {
    int count = 1;                     ///< plays, the first among them
    std::vector<std::string> differ;   ///< what differs from the first play, the first difference of each kind first; empty: nothing
    std::vector<ReadingSpread> spread; ///< of readings that differ
};

/// One drive played with one lamp set.
struct RenderingSettings;
struct ShadowChoice;
struct SeenDisplay;
struct SeriesFindings;

/// One moment side by side in several ways.
struct StoredSheet {
    std::string what; ///< what differs, as a heading ends: "by every tone mapper and eye"
    StoredFrame picture;
};

struct PlayedCell {
    std::string drive, lamp_set, technique;
    std::vector<std::pair<std::string, std::string>>
        input_hashes;                                       ///< what decides the results: "drive", "road", "lamp file 1" ... -> XXH3-128
    std::string title;                                      ///< of the drive, for people
    std::vector<std::pair<std::string, std::string>> lamps; ///< lamp name -> file name
    std::vector<LampAim> aims;                              ///< of each of them
    int first_tick = 0, ticks_planned = 0, ticks_done = 0;
    std::uint64_t moments_told = 0; ///< of a report that was read: how many its CSV of moments has
    std::vector<StoredFrame> frames;
    StoredFrame contact_sheet;                        ///< one moment drawn in every technique; without a PNG where none was asked for
    std::vector<StoredSheet> more_sheets;             ///< the same moment otherwise; only where contact_sheet is
    std::vector<LuxMap> maps;                         ///< at captured moments, at most as many as the page shows
    std::vector<LuxView> lux_views = {};              ///< of the first view, likewise
    std::vector<ExtentRow> extents;                   ///< every moment
    std::vector<ExtentSummary> extent_summaries;      ///< of those, in the order of extent_keys()
    std::vector<std::pair<double, double>> speed_mps; ///< time, speed
    std::vector<SeeingSeries> seeing;                 ///< glare and light at fixed places, every moment; empty where not asked for
    std::vector<CarRow> car;                          ///< every moment of a drive with a vehicle, else empty
    std::vector<PixelLevels> pixel_levels;            ///< of lamps whose pixels dim, every moment
    BusReport bus;                                    ///< signals from and to a bus; empty without
    std::string no_road_lx, no_target_lx;             ///< why there are no rendered extents of that plane; "" where there are
    std::vector<PassTime> passes;                     ///< raw samples of frames drawn alone, warm-up dropped: "frame", "shadow", ...
    std::string no_times;                             ///< why there are no times; "" where there are
    Throughput throughput;
    int warm_up_dropped = 0;
    PruningSavings savings;
    DriveError error;
    std::shared_ptr<const RenderingSettings> rendering_settings =
        nullptr;                                            ///< shadow method, tone mapper and display; nullptr: nothing was drawn
    std::shared_ptr<const ShadowChoice> shadows = nullptr;  ///< how `shadows: auto` was decided; nullptr: the drive names its method
    std::shared_ptr<const SeriesFindings> series = nullptr; ///< of cars within tolerances; nullptr: none asked for, or interrupted
    std::shared_ptr<const SeenDisplay> display = nullptr;   ///< how pictures are seen; nullptr: the display says not where it is seen from
    Readings readings;                                      ///< summary of the drive and probes
    Repeats repeats;
    std::vector<Verdict> verdicts;
    std::vector<std::string> left_out; ///< what the scene did not need, one sentence each
    std::vector<std::string> notes;    ///< near-field, warnings of readers ...
};

struct LiveFigures;
struct Report {
    RunContext context;
    std::vector<PlayedCell> played;
    bool complete = true;
    std::string interrupted;                           ///< why not complete
    std::vector<Verdict> listed;                       ///< on the list of known failures itself: entries that are of no use any more
    std::vector<std::string> warnings;                 ///< one sentence each
    std::vector<CheckedLampFile> lamp_files;           ///< as their check found them before the first frame
    std::shared_ptr<const LiveFigures> live = nullptr; ///< how punctual a live run was and what it lost (live_figures.h); nullptr: none
};

/// The page shows this many moments of a drive: of all that are pictured, evenly spread, first and last among them.
inline constexpr std::size_t max_pictured_moments = 12;
/// At most `most` of `count` indices, evenly spread, first and last among them.
std::vector<std::size_t> spread_over(std::size_t count, std::size_t most);

/// The report's verdict over what is red: fail if anything failed or passed unexpectedly, else flaky if a repeat differed, else
/// not_measured if anything asked for was not measured, else pass.
VerdictKind overall(const Report& report);

struct VerdictCounts {
    std::size_t pass = 0, fail = 0, not_measured = 0, flaky = 0; ///< by kind, without those that are known or pass unexpectedly
    std::size_t known = 0, unexpected_pass = 0;

    std::size_t all() const { return pass + fail + not_measured + flaky + known + unexpected_pass; }
};
VerdictCounts count_verdicts(const Report& report);

} // namespace fernlicht
