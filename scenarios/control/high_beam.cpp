#include "scenarios/control/high_beam.h"

#include "scenarios/control/bend_light.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <limits>

namespace fernlicht {
namespace {

constexpr double rounding_s = 1.0e-9; ///< of ticks added up

} // namespace

bool HighBeam::wanted(const SignalTable& table) {
    const double v = table[signal::ego_speed], lx = table[signal::environment_illuminance];
    fast_ = v >= (fast_ ? parameters_.off_below_mps : parameters_.on_above_mps);
    dark_ = lx <= (dark_ ? parameters_.lit_above_lx : parameters_.dark_below_lx);
    const double oncoming_m = table[signal::others_nearest_oncoming], preceding_m = table[signal::others_nearest_preceding];
    const bool alone = oncoming_m > parameters_.oncoming_m && preceding_m > parameters_.preceding_m; // false where a signal is lost
    return fast_ && dark_ && (alone || !dips_);
}

double HighBeam::step(const SignalTable& table, double dt_s) {
    const bool want = wanted(table);
    other_s_ = want == on_ ? 0.0 : other_s_ + dt_s;
    if (!started_ || (want != on_ && other_s_ >= (want ? parameters_.on_delay_s : parameters_.dip_delay_s) - rounding_s)) {
        on_ = want;
        other_s_ = 0.0;
    }
    const double per_s = parameters_.fade_s > 0.0 && started_ ? 1.0 / parameters_.fade_s : std::numeric_limits<double>::infinity();
    level_ = moved_towards(level_, on_ ? 1.0 : 0.0, per_s, dt_s);
    started_ = true;
    return level_;
}

std::pair<double, double> seen_deg(const OtherUser& other, const glm::dvec3& position_m, double yaw_rad) {
    const double ahead_m = other.ahead_m - position_m.x, left_m = other.left_m - position_m.y;
    if (!(ahead_m > 0.0))
        return {1.0, -1.0};
    const auto right_deg = [&](double y_m) { return degrees(yaw_rad - std::atan2(y_m, ahead_m)); };
    return {right_deg(left_m + 0.5 * other.width_m), right_deg(left_m - 0.5 * other.width_m)};
}

const std::vector<double>& LampWindows::step(const std::vector<OtherUser>& others, const HighBeamParameters& reach,
                                             const glm::dvec3& position_m, double yaw_rad, double dt_s) {
    const double margin_deg = degrees(parameters_.margin_rad);
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        const auto [from_deg, to_deg] = lamp_.windows_deg[i];
        const bool met = std::ranges::any_of(others, [&](const OtherUser& other) {
            const auto [least, most] = seen_deg(other, position_m, yaw_rad);
            return other.lamps_on && std::hypot(other.ahead_m, other.left_m) <= (other.oncoming() ? reach.oncoming_m : reach.preceding_m) &&
                   least <= most && least - margin_deg < to_deg && most + margin_deg > from_deg;
        });
        const double wanted = met ? 0.0 : 1.0;
        since_s_[i] = wanted == levels_[i] ? 0.0 : since_s_[i] + dt_s;
        if (!started_ ||
            (wanted != levels_[i] && since_s_[i] >= (met ? parameters_.mask_delay_s : parameters_.relight_delay_s) - rounding_s)) {
            levels_[i] = wanted;
            since_s_[i] = 0.0;
        }
    }
    started_ = true;
    return levels_;
}

} // namespace fernlicht
