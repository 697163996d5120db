// Trajectories as paths, sampled finely enough that a chord strays less than a millimetre from a bend of 5 m radius; and how a value goes
// from its start to its target: the shapes of OpenSCENARIO's TransitionDynamics over time or distance.
#pragma once

#include "scenarios/openscenario/osc_world.h"
#include "scenarios/openscenario/storyboard.h"

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
    double end_s() const { return points.back().time_s.value_or(0.0); }
    PathPoint at(double s_m) const;         ///< clamped; of a closed path taken round
    PathPoint at_time(double time_s) const; ///< clamped
};

/// `here`: where the entity is, for shapes without a start of their own. Throws InputError for positions that cannot be placed.
Path build_path(const Trajectory& trajectory, const World& world, const std::optional<Spot>& here);

/// With x from 0 to 1 and the change b: linear b x; sinusoidal b (1 - cos pi x) / 2; cubic b x^2 (3 - 2 x); step b at once. The largest
/// slope is b, pi/2 b, 1.5 b by the length of the transition, so that a transition given by its largest rate lasts b, pi/2 b, 1.5 b by that
/// rate.
class Transition {
  public:
    Transition() = default;
    Transition(const Dynamics& dynamics, double start, double target);

    /// Stretches the transition so that its largest rate is at most this.
    void limit_rate(double rate);
    void advance(double step); ///< s or m, as the dynamics has it; never beyond the end
    double value() const;
    double linear_value() const; ///< as if the shape were linear
    double slope() const;        ///< by s or m, stretching included
    bool over() const;
    bool at_once() const { return shape_ == Shape::step || length_ <= 0.0; }
    double start() const { return start_; }
    double target() const { return target_; }
    double length() const { return length_ * stretch_; }
    void retarget(double target) { target_ = target; } ///< a target that moves

  private:
    Shape shape_ = Shape::step;
    double start_ = 0.0, target_ = 0.0, length_ = 0.0, at_ = 0.0, stretch_ = 1.0;
};

} // namespace fernlicht::osc
