// What `fernlicht shadows` found: shadow methods by scenes, how wrong they are and what they cost. The writers only format it.
#pragma once

#include "metrics/shadows/shadow_errors.h"
#include "metrics/statistics/work_precision.h"
#include "runner/experiments/bench/bench_result.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "scenarios/drives/shadow_settings.h"

#include <array>

namespace fernlicht {

/// Metres ahead of the lamp at which edges are measured, and how finely.
inline constexpr std::array<double, 3> edge_distances_m{10.0, 30.0, 80.0};
inline constexpr double edge_pixel_m = 0.01, section_half_m = 20.0;
/// Crawl: where and over which steps.
inline constexpr double crawl_distance_m = 30.0, crawl_step_m = 0.1;
inline constexpr int crawl_steps = 9;
/// The ground that counts: from the lamp on, to each side, and its pixels.
inline constexpr double ground_ahead_m = 100.0, ground_beside_m = 12.0, ground_along_m = 0.2, ground_across_m = 0.1;
/// Spots in the view are beyond doubt so far from an edge, in pixels of a view tile_px wide.
inline constexpr int doubt_px = 3;

/// One method in one scene. Areas are summed over the moments.
struct ShadowRow {
    ShadowMethod method = ShadowMethod::none;
    std::string why_not;                                  ///< why nothing was measured; "" where it was
    ShadowArea ground_m2, view_px;                        ///< lamps as points
    std::optional<ShadowArea> discs_px;                   ///< lamps as discs
    std::vector<double> wrong_by_moment;                  ///< share of the ground
    ShadowSpots spots;                                    ///< in the view
    std::array<EdgeError, edge_distances_m.size()> edges; ///< in the light of one lamp
    std::optional<double> crawl_cm;
    std::string no_crawl; ///< why there is none
    TimingSamples samples;
    std::vector<std::pair<std::string, Interval>> pass_s; ///< by pass of a frame: each finished and timed by itself
    std::vector<Work> work;                               ///< by moment timed
    std::optional<std::uint64_t> texture_bytes;           ///< more than without shadows
    Image<float> luminance_cdm2, wrong;                   ///< of the moment shown, about its shadows; true minus drawn degree of shadow
};

struct ShadowSceneResult {
    std::string name, title;
    bool of_drive = false;
    std::vector<std::pair<int, double>> moments; ///< tick and time in seconds
    std::size_t shown = 0;                       ///< of `moments`
    int width_px = 0, height_px = 0;             ///< of the view timed
    double vertical_fov_rad = 0.0;               ///< of the view that maps are fitted to
    std::vector<ShadowRow> rows;
    bool whole_view = false;             ///< what is shown of it: all, or half of it each way, about its shadows
    Image<float> luminance_cdm2, degree; ///< of the moment shown: shaded_by_rays(); degree of shadow by rays, below 0 where none counts
    double white_cdm2 = 1.0;             ///< white_of_ground() without shadows
};

struct ShadowResult : Findings {
    std::size_t cores = 0, rounds = 0;
    int map_width = 0, map_height = 0; ///< texels of the methods that have maps
    double lamp_radius_m = 0.0, floor_lx = shadow_floor_lx;
    OtherLoad others;
    std::vector<ShadowSceneResult> scenes;
};

bool measured(const ShadowRow& row);
/// Time a frame: median with its interval; nullopt where none was taken.
std::optional<Interval> frame_time(const ShadowRow& row);
/// CPU time a frame, the median.
std::optional<double> cpu_time(const ShadowRow& row);

/// Wrong share of the ground over time a frame: of each scene, and first of all scenes together (the mean of shares, the sum of times),
/// where there are several.
std::vector<WorkPrecision> shadow_diagrams(const ShadowResult& result);
/// One moment in all methods beside the picture by rays, and where they are wrong.
TileSheet shadow_sheet(const ShadowSceneResult& scene);

/// docs/shadows.md tells how to read it.
Document document(const ShadowResult& result);
/// All scenes in one table, as `--markdown` prints it.
Document shadow_paper(const ShadowResult& result);
/// docs/shadows.md and shadows.schema.json describe it.
JsonMembers shadow_members(ShadowResult& result); ///< of its JSON; pictures do not come back
/// RFC 4180: a line for each scene and method.
std::string shadow_csv(const ShadowResult& result);

} // namespace fernlicht
