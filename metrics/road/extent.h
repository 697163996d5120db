// Illuminated road extent: how far and how wide the lamps light each lane. The first of all readings.
// How exact the extents of each lane are on a grid: what every second row and column would make of them.
#pragma once

#include "metrics/readings/readings.h"
#include "scenarios/drives/play/nudge.h"
#include "scenarios/light/light_bounds.h"

#include <array>
#include <optional>

namespace fernlicht {

/// Edges of a lane in one row of a grid, offsets left positive; nullopt where the lane is not.
struct LaneSpan {
    double left_m = 0.0, right_m = 0.0;
};
using LaneSpans = std::vector<std::optional<LaneSpan>>;

/// A lane with its edges in every row.
struct LaneStrip {
    std::string name;
    bool same_direction = true;
    LaneSpans spans;
};

/// Sample points on the road ahead in route coordinates, with their places in the world.
struct ExtentGrid {
    std::vector<double> ahead_m;        ///< distance from the bumper along the route, ascending, starts at 0
    std::vector<double> offset_m;       ///< from the own lane's centre, left positive, ascending
    std::vector<Pose> surface;          ///< row-major [ahead][offset]: point on the road and its normal (z axis)
    std::vector<CrossSection> sections; ///< one per `ahead_m`
    double target_height_m = 0.0;
    /// Road surface of each cell's two triangles (lit_road.h), row-major; empty: not known yet, taken from `surface` by each measurement.
    std::vector<std::array<double, 2>> cell_m2;
    std::vector<std::array<double, 2>> coarse_cell_m2; ///< the same of every second row and column
    SurfacePlaces places;                              ///< of `surface`; empty: not known yet
    /// Of the sections, and of every second one (lit_road.h, lane_strips); empty: not known yet.
    std::vector<LaneStrip> strips, coarse_strips;
};

/// Which illuminance: on the road's surface, or on a target facing the lamps at target height.
enum class Surface { road, target };

struct LaneExtent {
    double threshold_lx = 0.0;
    Surface surface = Surface::road;
    std::string lane; ///< RouteLane::name, or "all" for the whole width that was looked at
    bool same_direction = true;
    /// Farthest place on the lane's centre line with E >= limit; 0: nowhere. For "all": on whichever line reaches farthest.
    double reach_centre_m = 0.0;
    double reach_left_edge_m = 0.0, reach_right_edge_m = 0.0; ///< for "all": on the outermost lines that were looked at
    double unlit_before_reach_m = 0.0;                        ///< on the centre line: length below the limit before the reach (dark gaps)
    /// Lit where the grid or the lane ends: the reach is at least this. Of the centre line, and of each edge.
    bool reach_is_cut_off = false, left_edge_is_cut_off = false, right_edge_is_cut_off = false;
    /// Outermost left and right edge of the lit part across, offsets left positive; width_m counts what is lit between them, gaps not.
    struct Width {
        double at_m, left_m, right_m, width_m;
        bool cut_off = false; ///< of "all": lit out to where was looked at, at least this wide
        bool operator==(const Width&) const = default;
    };
    std::vector<Width> widths; ///< all 0 where unlit; no entry where the lane is not or the grid does not reach
    double area_m2 = 0.0;      ///< of road surface inside the isolux line
    /// Whether the isolux line leaves what was looked at: the area is at least this.
    bool area_is_cut_off() const {
        return reach_is_cut_off || left_edge_is_cut_off || right_edge_is_cut_off ||
               (lane == "all" && (reach_left_edge_m > 0.0 || reach_right_edge_m > 0.0));
    }
    bool operator==(const LaneExtent&) const = default;
};

/// Rows every cell_m from the bumper to ahead_m or the route's end. Columns out to beside_m, one of them on the own lane's centre: every
/// cell_m / 4 where the road is paved in any row, every cell_m farther out. No rows when the bumper stands beyond the route's end.
ExtentGrid make_extent_grid(const Route& route, const Moment& moment, double bumper_m, const ExtentParameters& parameters);

/// Illuminance at every grid point from the candela tables in double (scenarios/light/light.h); row-major like `surface`. No shadows.
/// The same bytes for any number of threads.
std::vector<double> twin_illuminance_lx(const ExtentGrid& grid, const Moment& moment, Surface surface);

/// The same for measure_extent and grid_errors, which find the same in it as long as they are asked for these limits or some of them: exact
/// where they decide (lux_near_thresholds.h), elsewhere a value that reaches the same limits. In a quarter of the time.
std::vector<double> twin_lux_near_thresholds(const ExtentGrid& grid, const Moment& moment, Surface surface,
                                             const std::vector<double>& thresholds_lx);

/// Extents at every limit of every lane that lies wholly within the width that was looked at, then of "all". `lx` row-major like
/// `grid.surface`, from any source. Between samples illuminance runs as in lit_line.h. Empty for a grid of less than two rows or
/// columns. Throws std::invalid_argument for a wrong number of values, NaN or infinity among them, or a limit not above 0.
std::vector<LaneExtent> measure_extent(const ExtentGrid& grid, const std::vector<double>& lx, Surface surface,
                                       const std::vector<double>& thresholds_lx, const std::vector<double>& width_at_m);

inline constexpr const char* reach_beyond = "the reach lies beyond the end of grid, road or lane";

/// Extents by the twin as the moment's lamps are, and nudged, in the order of NudgeKind; none where a nudge is nullopt.
struct NudgedExtents {
    std::vector<LaneExtent> as_is;
    std::array<std::vector<LaneExtent>, nudge_kinds> nudged;
};
/// Less and more flux are the same light against other limits.
NudgedExtents nudged_extents(const ExtentGrid& grid, const Moment& moment, const std::vector<double>& thresholds_lx,
                             const std::vector<double>& width_at_m, const Nudges& nudges);

/// |difference| of one lane's extents between the grid and every second row and column of it, metres and m2. Where the error goes as the
/// square of the cell, the grid's own is a third of this.
struct GridError {
    double threshold_lx = 0.0;
    Surface surface = Surface::road;
    std::string lane = {}; ///< as LaneExtent::lane
    /// `edge` is the larger of both edges'. Not measured: `reach_beyond`, or, without a reason, where nothing tells.
    Value reach = {}, edge = {}, unlit = {}, area = {};
    bool operator==(const GridError&) const = default;
};

/// `measured` is what measure_extent finds in `lx` on `grid`. Nothing tells of a grid of less than three rows or columns, and of a lane
/// that the coarser grid loses (its edge lies beyond the last column) or cuts off. The own lane's reach, on the line at offset 0, and the
/// area of "all" are those of the same ground on both grids, wherever the lanes' edges run: by limit these two come first.
std::vector<GridError> grid_errors(const ExtentGrid& grid, const std::vector<double>& lx, Surface surface,
                                   const std::vector<double>& thresholds_lx, const std::vector<LaneExtent>& measured);

} // namespace fernlicht
