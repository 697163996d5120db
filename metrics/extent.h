// Illuminated road extent: how far and how wide the lamps light each lane. The product's first number.
#pragma once

#include "metrics/readings.h"
#include "scenarios/drives/moment.h"

namespace fernlicht {

/// Sample points on the road ahead in route coordinates, with their places in the world.
struct ExtentGrid {
    std::vector<double> ahead_m;  ///< distance from the bumper along the route, ascending, starts at 0
    std::vector<double> offset_m; ///< from the own lane's centre, left positive, ascending
    std::vector<Pose> surface;    ///< row-major [ahead][offset]: point on the road and its normal (z axis)
    std::vector<CrossSection> sections; ///< one per `ahead_m`
    double target_height_m = 0.0;
};

/// Which illuminance: on the road's surface, or on a target facing the lamps at target height.
enum class ExtentPlane { road, target };

struct LaneExtent {
    double limit_lx = 0.0;
    ExtentPlane plane = ExtentPlane::road;
    std::string lane;                   ///< RouteLane::name, or "all" for the whole width that was looked at
    bool same_direction = true;
    double reach_centre_m = 0.0;        ///< farthest place on the lane's centre line with E >= limit; 0: nowhere
    double reach_left_edge_m = 0.0, reach_right_edge_m = 0.0;
    double unlit_before_reach_m = 0.0;  ///< on the centre line: length below the limit before the reach (dark gaps)
    bool reach_is_cut_off = false;      ///< lit at the grid's far end: the reach is at least this
    struct Width { double at_m, left_m, right_m, width_m; }; ///< left and right edge of the lit part across, offsets left positive
    std::vector<Width> widths;          ///< width_m = 0 where unlit
    double area_m2 = 0.0;
};

ExtentGrid make_extent_grid(const Route& route, const Moment& moment, double bumper_m, const ExtentParameters& parameters);

/// Illuminance at every grid point from the candela tables in double (scenarios/light.h); row-major like `surface`. No shadows.
std::vector<double> twin_illuminance_lx(const ExtentGrid& grid, const Moment& moment, ExtentPlane plane);

/// Extents of every lane (and "all") at every limit. `lx` row-major like `grid.surface`, from any source.
std::vector<LaneExtent> measure_extent(const ExtentGrid& grid, const std::vector<double>& lx, ExtentPlane plane, const std::vector<double>& limits_lx,
                                       const std::vector<double>& width_at_m);

/// Reach on the own lane's centre for each limit and how it answers to what is never known exactly. From the twin.
struct ReachSensitivity {
    double limit_lx = 0.0;
    ExtentPlane plane = ExtentPlane::road;
    double metres_per_tenth_degree = 0.0; ///< central difference of +-0.1 degrees of pitch of all lamps
    double metres_per_tenth_flux = 0.0;   ///< central difference of +-10 % of flux
};
std::vector<ReachSensitivity> reach_sensitivity(const ExtentGrid& grid, const Moment& moment, const std::vector<double>& limits_lx);

/// The grid's own error: the same extents from every second row and column, as |difference| by limit: {limit, plane, metres of reach, m2 of area}.
struct GridError { double limit_lx; ExtentPlane plane; double reach_m, area_m2; };
std::vector<GridError> grid_error(const ExtentGrid& grid, const std::vector<double>& lx, ExtentPlane plane, const std::vector<double>& limits_lx);

} // namespace fernlicht
