#include "metrics/regulation/regulation_check.h"

#include "metrics/beam/cut_off_elbow.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr double settled_deg = 0.002; // well below the 0.01 degrees of a goniometer
constexpr int max_rounds = 20;

/// An edge known only to a file's coarse step would turn the beam by more than any re-aim allows (0.25 degrees in V).
constexpr double max_position_error_deg = 0.25;

std::string angle(double deg, const char* positive, const char* negative) {
    return fmt::format("{:.2f} {}", std::abs(deg), deg < 0.0 ? negative : positive);
}

bool usable(const CutOffScan& scan) { return scan.inflection_deg && scan.position_error_deg <= max_position_error_deg; }

std::string why_not(const CutOffScan& scan) {
    return scan.inflection_deg ? fmt::format("its place is known to {:.2g} degrees only: {}", scan.position_error_deg, scan.reason)
                               : scan.reason;
}

/// What a rule aims by sideways.
struct Sideways {
    std::optional<double> off_deg; ///< to the right of where it belongs
    double bound_deg = 0.0;
    std::string why_not;
};

double default_slope() { return std::tan(radians(15.0)); }

/// The shoulder on the line at 0.2 D, where the elbow's fit does not contradict it: that line may run above a short rise and find another
/// edge.
Sideways by_line(const CutOffFigures& c, const CutOffElbow& elbow, Direction turned) {
    if (!usable(c.shoulder))
        return {std::nullopt, 0.0, why_not(c.shoulder)};
    const double found = *c.shoulder.inflection_deg;
    const double slope = elbow.at ? std::tan(radians(elbow.rise_angle_deg)) : default_slope();
    const double bound = c.shoulder.uncertainty_deg() + 0.3 * c.shoulder.table_step_deg + c.level.uncertainty_deg() / slope;
    constexpr double above_level_deg = 0.37;
    if (elbow.at) {
        if (elbow.rise_to_h_deg && above_level_deg > 0.9 * slope * (*elbow.rise_to_h_deg - elbow.at->h_deg))
            return {std::nullopt, 0.0,
                    fmt::format("the rise ends {:.2f} degrees above the level part, and the line at 0.2 D lies 0.37 above it",
                                slope * (*elbow.rise_to_h_deg - elbow.at->h_deg))};
        const double expected = elbow.at->h_deg + turned.h_deg + above_level_deg / slope;
        if (std::abs(found - expected) > bound + elbow.uncertainty.h_deg)
            return {std::nullopt, 0.0,
                    fmt::format("on the line at 0.2 D the edge lies at {}, and the rise at {}", angle(found, "R", "L"),
                                angle(expected, "R", "L"))};
    }
    if (bound > std::max(0.17, c.shoulder.table_step_deg))
        return {std::nullopt, 0.0, fmt::format("on the line at 0.2 D the edge is placed to {:.2f} degrees only", bound)};
    return {found - line_a_deg, bound, {}};
}

Sideways sideways(const CutOffFigures& c, const CutOffElbow& elbow, Direction turned, AimRule rule) {
    if (rule == AimRule::cut_off_by_line)
        return by_line(c, elbow, turned);
    if (rule == AimRule::cut_off)
        return {c.kink_h_deg, c.kink_uncertainty_deg, c.kink_reason};
    if (!elbow.at)
        return {std::nullopt, 0.0, elbow.reason};
    return {elbow.at->h_deg + turned.h_deg, elbow.uncertainty.h_deg, {}};
}

/// `elbow` is that of the lamp as filed.
Aim by_cut_off(const CandelaTable& lamp, AimRule rule, const CutOffElbow& elbow) {
    Aim aim;
    aim.rule = rule;
    const CutOffFigures filed = measure_cut_off({&lamp, {}});
    const auto left_as_filed = [&](const std::string& what, const std::string& why) {
        aim.turned = aim.bound = {};
        aim.found = false;
        aim.cut_off = filed;
        aim.why_not = why;
        aim.how = what + ", left as filed: " + why;
        return aim;
    };
    if (elbow.at)
        aim.turned = {-elbow.at->h_deg, line_b_deg - elbow.at->v_deg};
    bool pre_turned = elbow.at.has_value();
    Sideways aside;
    for (double before = std::numeric_limits<double>::infinity();;) {
        const CutOffFigures c = aim.turned == Direction{} ? filed : measure_cut_off({&lamp, aim.turned});
        ++aim.rounds;
        aim.cut_off = c;
        if (!usable(c.level))
            return left_as_filed("no cut-off to aim by 2.5 degrees left", why_not(c.level));
        aside = sideways(c, elbow, aim.turned, rule);
        if (!aside.off_deg && pre_turned) { // without a rule that goes on from there the elbow turns nothing sideways
            aim.turned.h_deg = 0.0;
            pre_turned = false;
            continue;
        }
        aim.residual = {aside.off_deg.value_or(0.0), *c.level.inflection_deg - line_b_deg};
        aim.bound = {aside.off_deg ? aside.bound_deg : 0.0, c.level.uncertainty_deg() + 0.15 * c.level.table_step_deg + settled_deg};
        const double off = std::hypot(aim.residual.h_deg, aim.residual.v_deg);
        if (off < settled_deg)
            break;
        if (off >= before || aim.rounds == max_rounds) {
            if (std::abs(aim.residual.h_deg) > aim.bound.h_deg || std::abs(aim.residual.v_deg) > aim.bound.v_deg)
                return left_as_filed(fmt::format("not converged after {} rounds", aim.rounds),
                                     fmt::format("{:.2f} degrees off, and {:.2f} the round before", off, before));
            break;
        }
        before = off;
        aim.turned = {aim.turned.h_deg - aim.residual.h_deg, aim.turned.v_deg - aim.residual.v_deg};
    }
    aim.how = fmt::format("cut-off found at {}, 2.5 degrees left, set to 0.57 D", angle(line_b_deg - aim.turned.v_deg, "U", "D"));
    aim.found = aside.off_deg.has_value();
    static constexpr const char* set[]{"kink set on V-V", "shoulder at 0.2 D set on line A (0.5 R)", "elbow set on V-V"};
    if (aim.found)
        aim.how += fmt::format("; {} by {}",
                               set[rule == AimRule::cut_off           ? 0
                                   : rule == AimRule::cut_off_by_line ? 1
                                                                      : 2],
                               angle(aim.turned.h_deg, "R", "L"));
    else {
        aim.why_not = aside.why_not;
        aim.how += "; left as filed sideways: " + aside.why_not;
    }
    return aim;
}

/// The line at 0.2 D puts the shoulder of a rise of 37 degrees where its elbow meets V-V: a flatter one that was right it turns to the
/// left, a steeper one to the right. Within both bounds the two are one aim.
bool leaves_elbow(const Aim& by_line, const CutOffElbow& elbow) {
    return elbow.at && std::abs(by_line.turned.h_deg + elbow.at->h_deg) > std::min(by_line.bound.h_deg, elbow.uncertainty.h_deg);
}

/// The first rule that finds what it aims by and agrees with the elbow; without any, the text's own with its reason.
Aim automatic(const CandelaTable& lamp, const CutOffElbow& elbow) {
    Aim first = by_cut_off(lamp, AimRule::cut_off, elbow);
    if (first.found || !usable(first.cut_off->level))
        return first;
    std::string passed_over = "not by the kink: " + first.cut_off->kink_reason;
    for (const AimRule rule : {AimRule::cut_off_by_line, AimRule::elbow}) {
        Aim aim = by_cut_off(lamp, rule, elbow);
        if (!aim.found)
            continue;
        if (rule == AimRule::cut_off_by_line && leaves_elbow(aim, elbow)) {
            passed_over += fmt::format("; nor by the line at 0.2 D: it would leave the elbow at {}",
                                       angle(elbow.at->h_deg + aim.turned.h_deg, "R", "L"));
            continue;
        }
        aim.how += " (" + passed_over + ")";
        return aim;
    }
    return first;
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
        aim.how = fmt::format("no cut-off to aim by {}, left as filed: {}", side, why_not(scan));
        return aim;
    }
    aim.turned.v_deg = to - *scan.inflection_deg;
    aim.bound.v_deg = scan.uncertainty_deg();
    aim.rounds = 1;
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
        aim.how = "no light to aim by, left as filed";
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
    case AimRule::automatic:
        return automatic(lamp, fit_elbow({&lamp, {}}));
    case AimRule::cut_off:
    case AimRule::cut_off_by_line:
    case AimRule::elbow:
        return by_cut_off(lamp, rule, fit_elbow({&lamp, {}}));
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
