#include "scenarios/openscenario/osc_transition.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>

namespace fernlicht::osc {
namespace {

double steepest(Shape shape) { return shape == Shape::sinusoidal ? 0.5 * pi : shape == Shape::cubic ? 1.5 : 1.0; }

} // namespace

Transition::Transition(const Dynamics& dynamics, double start, double target)
    : shape_(dynamics.shape), start_(start), target_(target), length_(dynamics.value) {
    if (dynamics.dimension == Dimension::rate)
        length_ = dynamics.value > 0.0 ? steepest(shape_) * std::abs(target - start) / dynamics.value : 0.0;
    if (shape_ == Shape::step)
        length_ = 0.0;
}

void Transition::limit_rate(double rate) {
    if (at_once() || !(rate > 0.0))
        return;
    stretch_ = std::max(1.0, steepest(shape_) * std::abs(target_ - start_) / length_ / rate);
}

void Transition::advance(double step) { at_ = std::clamp(at_ + step / stretch_, 0.0, length_); }

double Transition::value() const {
    if (at_once())
        return target_;
    const double x = at_ / length_, b = target_ - start_;
    if (shape_ == Shape::sinusoidal)
        return start_ + 0.5 * b * (1.0 - std::cos(pi * x));
    return shape_ == Shape::cubic ? start_ + b * x * x * (3.0 - 2.0 * x) : start_ + b * x;
}

double Transition::linear_value() const { return at_once() ? target_ : start_ + (target_ - start_) * at_ / length_; }

double Transition::slope() const {
    if (at_once())
        return 0.0;
    const double x = at_ / length_, b = (target_ - start_) / (length_ * stretch_);
    if (shape_ == Shape::sinusoidal)
        return 0.5 * pi * b * std::sin(pi * x);
    return shape_ == Shape::cubic ? 6.0 * b * x * (1.0 - x) : b;
}

bool Transition::over() const { return at_once() || at_ > length_ - 1e-6; }

} // namespace fernlicht::osc
