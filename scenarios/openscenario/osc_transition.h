// How a value goes from its start to its target: the shapes of OpenSCENARIO's TransitionDynamics over time or distance.
#pragma once

#include "scenarios/openscenario/storyboard.h"

namespace fernlicht::osc {

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
