// Trajectories as paths: arc length, or time, to a place. Polylines, clothoids and NURBS, all sampled finely enough that a chord strays
// less than a millimetre from a bend of 5 m radius.
#pragma once

#include "scenarios/openscenario/osc_world.h"

namespace fernlicht::osc {

struct PathPoint {
    double s_m = 0.0, x_m = 0.0, y_m = 0.0, z_m = 0.0, heading_rad = 0.0;
    std::optional<double> time_s;
    bool corner = false; ///< a polyline's own vertex: the heading jumps there
};

struct Path {
    std::vector<PathPoint> points; ///< at least 2; s rising
    bool has_z = false;
    bool timed = false; ///< every point has a time, never falling
    bool closed = false;
    bool own_headings = false; ///< the file gives them

    double length_m() const { return points.back().s_m; }
    double start_s() const { return points.front().time_s.value_or(0.0); }
    double end_s() const { return points.back().time_s.value_or(0.0); }
    PathPoint at(double s_m) const;         ///< clamped; of a closed path taken round
    PathPoint at_time(double time_s) const; ///< clamped
};

/// `here`: where the entity is, for shapes without a start of their own. Throws InputError for positions that cannot be placed.
Path build_path(const Trajectory& trajectory, const World& world, const std::optional<Spot>& here);

} // namespace fernlicht::osc
