#include "metrics/regulation/aim.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double settled_deg = 0.002; // well below the 0.01 degrees of a goniometer
constexpr int most_rounds = 20;

/// An edge known only to a file's coarse step would turn the beam by more than any re-aim allows (0.25 degrees in V).
constexpr double most_position_error_deg = 0.25;

std::string angle(double deg, const char* positive, const char* negative) {
    return fmt::format("{:.2f} {}", std::abs(deg), deg < 0.0 ? negative : positive);
}

bool usable(const CutOffScan& scan) { return scan.inflection_deg && scan.position_error_deg <= most_position_error_deg; }

std::string why_not(const CutOffScan& scan) {
    return scan.inflection_deg ? fmt::format("its place is known to {:.2g} degrees only: {}", scan.position_error_deg, scan.reason)
                               : scan.reason;
}

/// How far the kink, or the shoulder at 0.2 D, lies to the right of where it belongs; nullopt: not found.
std::optional<double> sideways(const CutOffFigures& c, AimRule rule) {
    if (rule == AimRule::cut_off)
        return c.kink_h_deg;
    if (!usable(c.shoulder))
        return std::nullopt;
    return *c.shoulder.inflection_deg - line_a_deg;
}

Aim by_cut_off(const CandelaTable& lamp, AimRule rule) {
    Aim aim;
    aim.rule = rule;
    CutOffFigures first;
    for (int round = 0; round < most_rounds; ++round) {
        const CutOffFigures c = measure_cut_off({&lamp, aim.turned});
        aim.cut_off = c;
        if (round == 0)
            first = c;
        if (!usable(c.level))
            break;
        const double up = line_b_deg - *c.level.inflection_deg, right = -sideways(c, rule).value_or(0.0);
        if (std::abs(up) < settled_deg && std::abs(right) < settled_deg)
            break;
        aim.turned = {aim.turned.h_deg + right, aim.turned.v_deg + up};
    }
    const CutOffFigures& last = *aim.cut_off;
    aim.position_error_deg = last.level.position_error_deg;
    if (!usable(first.level) || !usable(last.level)) {
        aim.turned = {};
        aim.found = false;
        aim.cut_off = first;
        aim.how = "no cut-off to aim by 2.5 degrees left, left as it is: " + why_not(usable(first.level) ? last.level : first.level);
        return aim;
    }
    aim.how = fmt::format("cut-off found at {}, 2.5 degrees left, set to 0.57 D", angle(*first.level.inflection_deg, "U", "D"));
    const std::optional<double> there = sideways(last, rule);
    aim.found = there.has_value();
    if (!there)
        aim.how += "; left as it is sideways: " + (rule == AimRule::cut_off ? last.kink_reason : why_not(last.shoulder));
    else
        aim.how += fmt::format("; {} by {}", rule == AimRule::cut_off ? "kink set on V-V" : "shoulder at 0.2 D set on line A (0.5 R)",
                               angle(aim.turned.h_deg, "R", "L"));
    return aim;
}

/// One scan, one turn up or down.
Aim by_gradient(const CandelaTable& lamp, AimRule rule) {
    const bool left = rule == AimRule::vol;
    const double to = left ? vol_deg : vor_deg;
    Aim aim;
    aim.rule = rule;
    const CutOffScan scan = vertical_scan({&lamp, {}}, left ? vol_scan_h_deg : vor_scan_h_deg, -3.0, 2.0);
    const char* const side = left ? "2.5 degrees left" : "2.0 degrees right";
    if (!usable(scan)) {
        aim.found = false;
        aim.how = fmt::format("no cut-off to aim by {}, left as it is: {}", side, why_not(scan));
        return aim;
    }
    aim.turned.v_deg = to - *scan.inflection_deg;
    aim.position_error_deg = scan.position_error_deg;
    aim.how =
        fmt::format("greatest gradient found at {}, {}, set to {}", angle(*scan.inflection_deg, "U", "D"), side, left ? "0.4 D" : "H-H");
    aim.cut_off = measure_cut_off({&lamp, aim.turned});
    return aim;
}

/// Middle of the area within 80 % of the maximum, the isocandela that the texts name, in steps of 0.05 degrees.
Aim by_maximum(const CandelaTable& lamp) {
    Aim aim;
    aim.rule = AimRule::maximum;
    const Peak peak = peak_of(lamp);
    if (peak.cd <= 0.0) {
        aim.found = false;
        aim.how = "no light to aim by, left as it is";
        return aim;
    }
    double h = 0.0, v = 0.0;
    int inside = 0;
    for (int j = -200; j <= 200; ++j)
        for (int i = -200; i <= 200; ++i)
            if (intensity_cd(lamp, peak.h_deg + 0.05 * i, peak.v_deg + 0.05 * j) >= 0.8 * peak.cd) {
                h += 0.05 * i;
                v += 0.05 * j;
                ++inside;
            }
    aim.turned = {-(peak.h_deg + h / inside), -(peak.v_deg + v / inside)};
    aim.how = fmt::format("middle of the area of maximum intensity found at {}, {}, set on HV", angle(-aim.turned.h_deg, "R", "L"),
                          angle(-aim.turned.v_deg, "U", "D"));
    return aim;
}

} // namespace

Aim aim_of(const CandelaTable& lamp, AimRule rule) {
    switch (rule) {
    case AimRule::cut_off:
    case AimRule::cut_off_by_line:
        return by_cut_off(lamp, rule);
    case AimRule::vol:
    case AimRule::vor:
        return by_gradient(lamp, rule);
    case AimRule::maximum:
        return by_maximum(lamp);
    case AimRule::as_is:
        break;
    }
    Aim aim;
    aim.how = "as the file has it";
    return aim;
}

} // namespace fernlicht
