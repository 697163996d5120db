// What the car feels of its lane: slope and curvature over the distance, smooth enough for an integrator.
#pragma once

#include "scenarios/roads/route.h"

namespace fernlicht {

/// Means over cells of `cell_m` about each knot, joined by a cubic B-spline: two continuous derivatives, and a bump is spread over about
/// 2 m. A car of the real world does so too (a tyre envelops, a driver looks at stretches); edges are RoadStep's.
struct RoadCourse {
    static constexpr double cell_m = 1.0;
    std::vector<double> slope;           ///< rise by distance at -1, 0, 1 .. cells
    std::vector<double> curvature_per_m; ///< of the lane's centre, left turns positive

    /// The spline and its derivative at a distance; constant beyond the ends. An empty table is 0.
    static double at(const std::vector<double>& table, double distance_m, double& derivative);
};

/// Up to `length_m` from the route's start; beyond its end the lane goes on straight with the last slope.
RoadCourse road_course(const Route& route, double length_m);

} // namespace fernlicht
