#include "scenarios/control/bend_light.h"

#include <limits>

namespace fernlicht {

BendLight::BendLight(const BendParameters& parameters, const ControlledCar& car)
    : parameters_(parameters), car_(car), filter_{parameters.filter_s} {}

double BendLight::wanted_rad(const SignalTable& table) const {
    const double v = table[signal::ego_speed], way_m = v * parameters_.preview_s;
    switch (parameters_.law) {
    case BendLaw::steering:
        return 0.5 * way_m * table[signal::ego_steering] / (car_.wheelbase_m + car_.self_steering_s2_per_m * v * v);
    case BendLaw::yaw_rate:
        return 0.5 * table[signal::ego_yaw_rate] * parameters_.preview_s;
    case BendLaw::route:
        return table[signal::road_bearing_ahead];
    }
    return 0.0;
}

double BendLight::step(const SignalTable& table, double dt_s) {
    const double v = table[signal::ego_speed];
    double angle_rad = parameters_.gain * wanted_rad(table);
    lost_ = !std::isfinite(angle_rad) || !std::isfinite(v);
    if (lost_)
        angle_rad = 0.0;
    else if (v < 2.0 * parameters_.from_speed_mps || v <= 0.0)
        angle_rad *= v > parameters_.from_speed_mps ? v / parameters_.from_speed_mps - 1.0 : 0.0;
    angle_rad = std::copysign(std::max(std::abs(angle_rad) - parameters_.dead_band_rad, 0.0), angle_rad);
    return filter_.step(std::clamp(angle_rad, parameters_.actuator.min_rad, parameters_.actuator.max_rad), dt_s);
}

double bend_of_lamp_rad(const BendParameters& parameters, double bend_rad, double left_m) {
    return bend_rad * left_m < 0.0 ? parameters.outer_share * bend_rad : bend_rad;
}

CorneringLight::Levels CorneringLight::step(const SignalTable& table, double dt_s) {
    const double v = table[signal::ego_speed], steering = table[signal::ego_steering], indicator = table[signal::ego_indicator];
    slow_ = v <= (slow_ ? parameters_.until_speed_mps : parameters_.again_below_mps); // false for NaN
    left_ = slow_ && (steering > (left_ ? parameters_.off_rad : parameters_.on_rad) || indicator > 0.5);
    right_ = slow_ && (-steering > (right_ ? parameters_.off_rad : parameters_.on_rad) || indicator < -0.5);
    const double per_s = parameters_.fade_s > 0.0 ? 1.0 / parameters_.fade_s : std::numeric_limits<double>::infinity();
    levels_.left = moved_towards(levels_.left, left_ ? 1.0 : 0.0, per_s, dt_s);
    levels_.right = moved_towards(levels_.right, right_ ? 1.0 : 0.0, per_s, dt_s);
    return levels_;
}

} // namespace fernlicht
