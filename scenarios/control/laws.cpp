#include "scenarios/control/laws.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

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

namespace {

constexpr double rounding_s = 1.0e-9; ///< of ticks added up

constexpr double same_deg = 1.0e-6; ///< samples nearer than this are one

double level_at(double h_deg, const std::vector<std::pair<double, double>>& windows_deg, const std::vector<double>& levels) {
    double level = 1.0;
    for (std::size_t i = 0; i < windows_deg.size(); ++i)
        if (h_deg >= windows_deg[i].first - same_deg && h_deg <= windows_deg[i].second + same_deg)
            level = std::min(level, levels[i]);
    return level;
}

/// The table's samples, and those where windows begin and end.
std::vector<double> axis_of(const CandelaTable& table, const std::vector<std::pair<double, double>>& windows_deg) {
    std::vector<double> wanted;
    for (const auto& [from, to] : windows_deg)
        for (const double edge : {from - window_edge_deg, from, to, to + window_edge_deg})
            if (edge > table.h_deg.front() && edge < table.h_deg.back())
                wanted.push_back(edge);
    std::vector<double> axis = table.h_deg;
    for (const double edge : wanted)
        if (std::ranges::none_of(axis, [&](double h) { return std::abs(h - edge) < same_deg; }))
            axis.push_back(edge);
    std::ranges::sort(axis);
    return axis;
}

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

std::optional<AngleBox> seen_box(const OtherUser& other, const LampPlace& lamp) {
    if (!(other.ahead_m > lamp.position_m.x))
        return std::nullopt;
    const glm::dmat3 axes = axes_from_angles(lamp.yaw_rad, lamp.pitch_rad, lamp.roll_rad);
    AngleBox box{180.0, -180.0, 90.0, -90.0};
    for (const double left_m : {other.left_m + 0.5 * other.width_m, other.left_m - 0.5 * other.width_m})
        for (const double up_m : {other.up_m, other.up_m + other.height_m}) {
            const glm::dvec3 seen = (glm::dvec3(other.ahead_m, left_m, up_m) - lamp.position_m) * axes; // forward, left, up
            const double h_deg = degrees(std::atan2(-seen.y, seen.x)), v_deg = degrees(std::atan2(seen.z, std::hypot(seen.x, seen.y)));
            box = {std::min(box.left_deg, h_deg), std::max(box.right_deg, h_deg), std::min(box.bottom_deg, v_deg),
                   std::max(box.top_deg, v_deg)};
        }
    return box;
}

std::optional<SeenBox> box_from_camera(const OtherUser& other) {
    const double x = other.ahead_m - camera_x_m;
    if (!(x > 0.0))
        return std::nullopt;
    const double left_m = other.left_m + 0.5 * other.width_m, right_m = other.left_m - 0.5 * other.width_m;
    const double along_m = std::hypot(x, std::min(std::abs(left_m), std::abs(right_m))); // to the nearer corner, whose angles are largest
    const double bottom_m = other.up_m - camera_z_m;
    return SeenBox{std::atan2(left_m, x), std::atan2(right_m, x), std::atan2(bottom_m, along_m),
                   std::atan2(bottom_m + other.height_m, along_m), x};
}

OtherUser user_in_box(const SeenBox& box) {
    static constexpr double far_m = 1.0e6, widest_rad = 1.569;
    const double x = std::clamp(box.distance_m, 1.0e-3, far_m);
    const auto up = [](double rad) { return std::tan(std::clamp(rad, -widest_rad, widest_rad)); };
    const double left_m = x * up(std::max(box.left_rad, box.right_rad)), right_m = x * up(std::min(box.left_rad, box.right_rad));
    const double along_m = std::hypot(x, std::min(std::abs(left_m), std::abs(right_m)));
    OtherUser user;
    user.ahead_m = camera_x_m + x;
    user.left_m = 0.5 * (left_m + right_m);
    user.width_m = left_m - right_m;
    user.up_m = camera_z_m + along_m * std::min(up(box.bottom_rad), up(box.top_rad));
    user.height_m = along_m * std::abs(up(box.top_rad) - up(box.bottom_rad));
    user.told = true;
    return user;
}

OtherUser seen_later(OtherUser other, const OwnMotion& own, double after_s) {
    const double turned = own.yaw_rate_rad_s * after_s, half = 0.5 * turned, way_m = own.speed_mps * after_s;
    // The chord of the car's arc, half the turn to the side.
    const double chord_m = std::abs(half) > 1e-9 ? way_m * std::sin(half) / half : way_m;
    const double x = other.ahead_m + other.speed_mps * std::cos(other.heading_rad) * after_s - chord_m * std::cos(half);
    const double y = other.left_m + other.speed_mps * std::sin(other.heading_rad) * after_s - chord_m * std::sin(half);
    other.ahead_m = x * std::cos(turned) + y * std::sin(turned);
    other.left_m = y * std::cos(turned) - x * std::sin(turned);
    other.heading_rad -= turned;
    return other;
}

const std::vector<double>& LampWindows::step(const std::vector<OtherUser>& others, const HighBeamParameters& reach, const LampPlace& lamp,
                                             const OwnMotion& own, double dt_s) {
    const double margin_deg = degrees(parameters_.margin_rad);
    std::vector<AngleBox> spared;
    for (const OtherUser& other : others)
        if (other.told ||
            (other.lamps_on && std::hypot(other.ahead_m, other.left_m) <= (other.oncoming() ? reach.oncoming_m : reach.preceding_m)))
            if (const auto box = seen_box(other, lamp)) {
                AngleBox later = *box;
                if (parameters_.foresee_s > 0.0 && !other.told) {
                    if (const auto then = seen_box(seen_later(other, own, parameters_.foresee_s), lamp))
                        later = *then;
                    else // beside the lamp by then: all of its side
                        (box->left_deg + box->right_deg < 0.0 ? later.left_deg = -90.0 : later.right_deg = 90.0);
                }
                spared.push_back(
                    {std::min(box->left_deg, later.left_deg) - margin_deg, std::max(box->right_deg, later.right_deg) + margin_deg,
                     std::min(box->bottom_deg, later.bottom_deg) - margin_deg, std::max(box->top_deg, later.top_deg) + margin_deg});
            }
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        const AngleBox& window = windows_[i];
        const bool met = std::ranges::any_of(spared, [&](const AngleBox& box) {
            return box.left_deg < window.right_deg && box.right_deg > window.left_deg && box.bottom_deg < window.top_deg &&
                   box.top_deg > window.bottom_deg;
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

CandelaTable masked(const CandelaTable& table, const std::vector<std::pair<double, double>>& windows_deg,
                    const std::vector<double>& levels) {
    if (levels.size() != windows_deg.size())
        throw std::invalid_argument("masked: as many levels as windows");
    CandelaTable out;
    out.h_deg = axis_of(table, windows_deg);
    out.v_deg = table.v_deg;
    out.rule = table.rule;
    for (const double v : out.v_deg)
        for (const double h : out.h_deg)
            out.cd.push_back(intensity_cd(table, h, v) * level_at(h, windows_deg, levels));
    if (table.gaps.empty())
        return out;
    const std::size_t cells = table.h_deg.size() - 1;
    for (std::size_t v = 0; v + 1 < out.v_deg.size(); ++v)
        for (std::size_t h = 0; h + 1 < out.h_deg.size(); ++h) {
            const double middle = 0.5 * (out.h_deg[h] + out.h_deg[h + 1]);
            const auto next = std::ranges::upper_bound(table.h_deg, middle);
            out.gaps.push_back(table.gaps[v * cells + static_cast<std::size_t>(next - table.h_deg.begin()) - 1]);
        }
    return out;
}

} // namespace fernlicht
