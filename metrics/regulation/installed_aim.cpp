#include "metrics/regulation/installed_aim.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr double level_scan_h_deg = 2.5; // to the side that does not rise
constexpr double regulation_aim_percent = -1.0;

/// x forward, y left, z up.
glm::dvec3 direction_of(Direction d) {
    const double h = radians(d.h_deg), v = radians(d.v_deg);
    return {std::cos(v) * std::cos(h), -std::cos(v) * std::sin(h), std::sin(v)};
}

/// A procedure that leaves the beam as filed bounds nothing.
bool has_level_part(const Aim& aim) { return aim.bound.v_deg > 0.0; }

double bend_of_level_part(const Aim& aim) {
    return has_level_part(aim) ? aim.cut_off->linearity_deg.value_or(10.0) : std::numeric_limits<double>::infinity();
}

AimMark mark_of(const Aim& aim, bool left_hand) {
    AimMark mark;
    mark.left_hand = left_hand;
    mark.bound = aim.bound;
    if (has_level_part(aim))
        mark.v_deg = line_b_deg + aim.residual.v_deg - aim.turned.v_deg;
    mark.by = "level part";
    if (aim.found) {
        const double h_deg = aim.residual.h_deg - aim.turned.h_deg;
        mark.h_deg = left_hand ? 0.0 - h_deg : h_deg;
        mark.by = aim.rule == AimRule::cut_off_by_line ? "shoulder" : aim.rule == AimRule::elbow ? "elbow" : "kink";
        return mark;
    }
    mark.why_not = left_hand ? mirrored_name(aim.why_not) : aim.why_not;
    return mark;
}

AimMark low_beam_mark(const CandelaTable& lamp) {
    const Aim right_hand = aim_of(lamp, AimRule::automatic);
    if (right_hand.found)
        return mark_of(right_hand, false);
    const Aim left_hand = aim_of(mirrored(lamp), AimRule::automatic);
    if (left_hand.found)
        return mark_of(left_hand, true);
    const bool left_is_straighter = bend_of_level_part(left_hand) < bend_of_level_part(right_hand);
    return mark_of(left_is_straighter ? left_hand : right_hand, left_is_straighter);
}

AimMark high_beam_mark(const CandelaTable& lamp) {
    const Aim aim = aim_of(lamp, AimRule::maximum);
    AimMark mark;
    mark.high_beam = true;
    mark.by = "middle of the maximum";
    if (!aim.found) {
        mark.why_not = "no light";
        return mark;
    }
    mark.v_deg = 0.0 - aim.turned.v_deg;
    mark.h_deg = 0.0 - aim.turned.h_deg;
    return mark;
}

} // namespace

Direction AimMark::place() const { return {h_deg.value_or(left_hand ? level_scan_h_deg : -level_scan_h_deg), v_deg.value()}; }

AimMark aim_mark(const CandelaTable& lamp, bool high_beam) { return high_beam ? high_beam_mark(lamp) : low_beam_mark(lamp); }

Turn turn_to(const AimMark& mark, double cut_off_percent) {
    const double up = std::atan(cut_off_percent / 100.0) - (mark.high_beam ? std::atan(regulation_aim_percent / 100.0) : 0.0);
    const glm::dvec3 at = direction_of(mark.place());
    // Pitch p takes (x, z) to (x cos p - z sin p, x sin p + z cos p), the latter r sin(p + atan2(z, x)).
    const double r = std::hypot(at.x, at.z);
    const double pitch = std::asin(std::clamp(std::sin(up) / r, -1.0, 1.0)) - std::atan2(at.z, at.x);
    const double ahead = at.x * std::cos(pitch) - at.z * std::sin(pitch);
    return {mark.h_deg ? 0.0 - std::atan2(at.y, ahead) : 0.0, pitch, 0.0};
}

Turn turn_within(const Turn& mount, const Turn& turn) {
    if (mount.pitch_rad == 0.0 && mount.roll_rad == 0.0)
        return turn;
    return turn_of(glm::transpose(mount.axes()) * axes_from_angles(mount.yaw_rad + turn.yaw_rad, turn.pitch_rad, turn.roll_rad));
}

MarkOnCar mark_on_car(const MountedLamp& lamp, Direction of_table, double body_pitch_rad) {
    const glm::dvec3 d = axes_from_angles(0.0, body_pitch_rad, 0.0) * (lamp.pose().axes * direction_of(of_table));
    const double right_deg = 0.0 - degrees(std::atan2(d.y, d.x));
    return {100.0 * d.z / std::hypot(d.x, d.y), std::abs(right_deg) < 1e-9 ? 0.0 : right_deg};
}

bool InclinationBand::holds(double percent) const { return percent > lowest_percent - 5e-4 && percent < highest_percent + 5e-4; }

std::optional<InclinationBand> r48_band(double height_m) {
    if (height_m < 0.5 || height_m > 1.2)
        return std::nullopt;
    if (height_m > 0.9)
        return InclinationBand{-(2.17 * height_m + 0.15), -(2.17 * height_m - 1.45)};
    return InclinationBand{-(height_m + 1.2), -0.5};
}

} // namespace fernlicht
