#include "metrics/beam/cut_off.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double scan_step_deg = 0.01;
constexpr std::size_t over_steps = 10; // 0.1 degrees, over which G is taken
constexpr double search_from_deg = -3.0, search_to_deg = 2.0;
constexpr double max_kink_uncertainty_deg = 0.15;

/// Coarsest step of the axis between two angles.
double coarsest_step(const std::vector<double>& axis, double from, double to) {
    double coarsest = 0.0;
    for (std::size_t i = 1; i < axis.size(); ++i)
        if (axis[i] > from + 1e-9 && axis[i - 1] < to - 1e-9)
            coarsest = std::max(coarsest, axis[i] - axis[i - 1]);
    return coarsest;
}

/// E along a scan in cd; negative: no data.
using Profile = std::vector<double>;

std::vector<double> falls(const Profile& e, double sign, bool& ends_in_dark) {
    const double most = *std::max_element(e.begin(), e.end());
    std::vector<double> g(e.size() > over_steps ? e.size() - over_steps : 0, -1.0);
    for (std::size_t i = 0; i < g.size(); ++i) {
        const double here = e[i], next = e[i + over_steps];
        if (here > 0.0 && next > 0.0)
            g[i] = sign * (std::log10(here) - std::log10(next));
        // One part in a hundred of the scan's maximum falling to nothing is an edge without a logarithm, less is a tail.
        else if ((sign > 0.0 ? here : next) > 0.01 * most && (sign > 0.0 ? next : here) == 0.0)
            ends_in_dark = true;
    }
    return g;
}

/// Place, in steps, of `level` between two neighbours.
double crossing(const std::vector<double>& g, std::size_t inside, std::size_t outside, double level) {
    const double share = (g[inside] - level) / (g[inside] - g[outside]);
    return static_cast<double>(inside) + share * (static_cast<double>(outside) - static_cast<double>(inside));
}

/// Middle, in steps, of the run round the maximum where G is at least `share` of it.
double middle_of_run(const std::vector<double>& g, std::size_t top, double share) {
    const double level = share * g[top];
    std::size_t first = top, last = top;
    while (first > 0 && g[first - 1] >= level)
        --first;
    while (last + 1 < g.size() && g[last + 1] >= level)
        ++last;
    const double begin = first > 0 ? crossing(g, first, first - 1, level) : static_cast<double>(first);
    const double end = last + 1 < g.size() ? crossing(g, last, last + 1, level) : static_cast<double>(last);
    return (begin + end) / 2.0;
}

struct ScanLine {
    bool vertical;
    double at_deg, from_deg, to_deg;
    Direction at(double b) const { return vertical ? Direction{at_deg, b} : Direction{b, at_deg}; }
};

/// How far log10 E falls, in horizontal scans rises, from one place to another; nullopt without light at both.
std::optional<double> fall_between(const ReceivedBeam& beam, const ScanLine& line, double from, double to) {
    const auto low = beam.at(line.at(from)), high = beam.at(line.at(to));
    if (!low || !high || *low <= 0.0 || *high <= 0.0)
        return std::nullopt;
    return (line.vertical ? 1.0 : -1.0) * (std::log10(*low) - std::log10(*high));
}

/// A file coarser than what G needs tells its edge's place to half a step: the middle of its steepest step. Somewhere within a stretch G is
/// at least its mean there, so a mean that aiming accepts proves an edge. Over less than half a degree noise would have such a mean, and so
/// would the dark end of a step that was divided along a straight line of cd; over the whole of a smooth beam's step there is none.
void place_coarsely(CutOffScan& scan, const AimedLamp& lamp, const ScanLine& line) {
    constexpr double shortest_stretch_deg = 0.5, per_deg = 0.1;
    const std::vector<double>& axis = line.vertical ? lamp.table->v_deg : lamp.table->h_deg;
    const double turned = line.vertical ? lamp.turned.v_deg : lamp.turned.h_deg;
    const ReceivedBeam beam({lamp}, {});
    double steepest = 0.0, middle = 0.0, width = 0.0;
    for (std::size_t i = 1; i < axis.size(); ++i) {
        const double a = axis[i - 1] + turned, b = axis[i] + turned;
        if (a < line.from_deg || b > line.to_deg)
            continue;
        const auto fall = fall_between(beam, line, a, b);
        if (fall && *fall / (b - a) > steepest) {
            steepest = *fall / (b - a);
            middle = (a + b) / 2.0;
            width = b - a;
        }
    }
    const std::string coarse = "is coarser than the 0.1 degrees over which G is taken";
    if (width == 0.0) {
        scan.reason =
            fmt::format("the file's step of {:.3g} degrees {}, and none that lies within the scan falls", scan.table_step_deg, coarse);
        return;
    }
    const double stretch = std::max(width, shortest_stretch_deg);
    const double mean = per_deg * fall_between(beam, line, middle - stretch / 2.0, middle + stretch / 2.0).value_or(0.0) / stretch;
    if (mean < min_sharpness) {
        scan.reason =
            fmt::format("no edge: in steps of {:.3g} degrees the greatest mean G over {:.3g} degrees is {:.3f}, and aiming needs {:.2f}",
                        scan.table_step_deg, stretch, mean, min_sharpness);
        return;
    }
    scan.reason = fmt::format("the file's step of {:.3g} degrees at the edge {}", scan.table_step_deg, coarse);
    scan.inflection_deg = middle;
    scan.position_error_deg = width / 2.0;
}

CutOffScan scan_along(const AimedLamp& lamp, const ScanLine& line, const CutOffOptions& options) {
    CutOffScan scan;
    scan.at_deg = line.at_deg;
    const ReceivedBeam beam({lamp}, {Receiver::Shape::disc, options.detector_deg});
    Profile e;
    const auto n = static_cast<std::size_t>(std::lround((line.to_deg - line.from_deg) / scan_step_deg));
    for (std::size_t i = 0; i <= n; ++i)
        e.push_back(beam.at(line.at(line.from_deg + scan_step_deg * static_cast<double>(i))).value_or(-1.0));
    bool ends_in_dark = false;
    const std::vector<double> g = falls(e, line.vertical ? 1.0 : -1.0, ends_in_dark);
    const auto top = std::max_element(g.begin(), g.end());
    if (ends_in_dark) {
        scan.reason = "the light ends in 0 cd within 0.1 degrees: its logarithm has no end";
        return scan;
    }
    if (top == g.end() || *top <= 0.0) {
        scan.reason = *std::max_element(e.begin(), e.end()) < 0.0 ? "outside the file's angles" : "the light falls nowhere along the scan";
        return scan;
    }
    const auto at = static_cast<std::size_t>(top - g.begin());
    const double b = line.from_deg + scan_step_deg * static_cast<double>(at);
    const double turned = line.vertical ? lamp.turned.v_deg : lamp.turned.h_deg;
    scan.table_step_deg = coarsest_step(line.vertical ? lamp.table->v_deg : lamp.table->h_deg, b - turned, b + 0.1 - turned);
    if (scan.table_step_deg > 0.1 + 1e-6) {
        place_coarsely(scan, lamp, line);
        return scan;
    }
    scan.sharpness = *top;
    if (*top < min_sharpness) {
        scan.reason = fmt::format("no edge: the greatest G is {:.3f}, and aiming needs {:.2f}", *top, min_sharpness);
        return scan;
    }
    // Between the samples of a table that runs linearly, G has ripples of a few per cent: the middle of the run at 80 % does not follow
    // them. An even edge has the same middle at every share; noise and uneven edges move it.
    double lowest = 1e9, highest = 0.0;
    for (const double share : {0.9, 0.8, 0.7, 0.6}) {
        const double middle = middle_of_run(g, at, share);
        lowest = std::min(lowest, middle);
        highest = std::max(highest, middle);
    }
    scan.scatter_deg = scan_step_deg * (highest - lowest);
    scan.inflection_deg = line.from_deg + scan_step_deg * (middle_of_run(g, at, 0.8) + static_cast<double>(over_steps) / 2.0);
    if (options.sharpness == SharpnessRule::at_inflection) {
        scan.sharpness = fall_between(beam, line, *scan.inflection_deg, *scan.inflection_deg + 0.1);
        if (!scan.sharpness)
            scan.reason = "no light 0.1 degrees beyond the inflection";
    }
    return scan;
}

void find_kink(CutOffFigures& c) {
    if (!c.level.inflection_deg) {
        c.kink_reason = "no level part to meet";
        return;
    }
    double h_mean = 0.0, v_mean = 0.0;
    for (const CutOffScan& scan : c.rise) {
        if (!scan.inflection_deg) {
            c.kink_reason = fmt::format("at {:g} degrees right: {}", scan.at_deg, scan.reason);
            return;
        }
        h_mean += scan.at_deg / 3.0;
        v_mean += *scan.inflection_deg / 3.0;
    }
    double hh = 0.0, hv = 0.0;
    for (const CutOffScan& scan : c.rise) {
        hh += (scan.at_deg - h_mean) * (scan.at_deg - h_mean);
        hv += (scan.at_deg - h_mean) * (*scan.inflection_deg - v_mean);
    }
    const double slope = hv / hh;
    c.rise_angle_deg = degrees(std::atan(slope));
    // 3 degrees: an error of 0.01 degrees in V would move the kink by 0.2 in H, a quarter of what a lamp may be re-aimed.
    if (*c.rise_angle_deg < 3.0) {
        c.kink_reason =
            fmt::format("from 1 to 3 degrees right the edge rises by {:.1f} degrees, too little to meet the level part", *c.rise_angle_deg);
        return;
    }
    const auto& [first, second, third] = c.rise;
    const double bend = std::abs(*first.inflection_deg - 2.0 * *second.inflection_deg + *third.inflection_deg) / 2.0;
    const double rise_uncertainty = std::max({first.uncertainty_deg(), second.uncertainty_deg(), third.uncertainty_deg()});
    if (bend > 2.0 * rise_uncertainty) {
        c.kink_reason =
            fmt::format("the edge at 1, 2 and 3 degrees right leaves a straight line by {:.2f} degrees, and {:.2f} are uncertain", bend,
                        2.0 * rise_uncertainty);
        return;
    }
    const double kink = h_mean + (*c.level.inflection_deg - v_mean) / slope, lever = h_mean - kink;
    c.kink_uncertainty_deg = std::hypot(c.level.uncertainty_deg(), rise_uncertainty * std::sqrt(1.0 / 3.0 + lever * lever / hh)) / slope;
    if (c.kink_uncertainty_deg > max_kink_uncertainty_deg)
        c.kink_reason = fmt::format("the edge at 1, 2 and 3 degrees right places the kink to {:.2f} degrees only", c.kink_uncertainty_deg);
    else if (kink > first.at_deg + c.kink_uncertainty_deg)
        c.kink_reason =
            fmt::format("the line through 1, 2 and 3 degrees right meets the level part at {:.2f} degrees right, beyond the first", kink);
    else
        c.kink_h_deg = kink;
}

} // namespace

// tests/calibration/aim.cpp holds both factors.
double CutOffScan::uncertainty_deg() const { return std::max(position_error_deg, 1.5 * scatter_deg) + 0.05 * table_step_deg; }

CutOffScan vertical_scan(const AimedLamp& lamp, double h_deg, double v_from_deg, double v_to_deg, const CutOffOptions& options) {
    return scan_along(lamp, {true, h_deg, v_from_deg, v_to_deg}, options);
}

CutOffFigures measure_cut_off(const AimedLamp& lamp, const CutOffOptions& options) {
    const auto upwards = [&](double h) { return vertical_scan(lamp, h, search_from_deg, search_to_deg, options); };
    CutOffFigures c;
    c.level = upwards(-2.5);
    c.level_inner = upwards(-1.5);
    c.level_outer = upwards(-3.5);
    if (c.level.inflection_deg && c.level_inner.inflection_deg && c.level_outer.inflection_deg) {
        const auto [low, high] = std::minmax({*c.level.inflection_deg, *c.level_inner.inflection_deg, *c.level_outer.inflection_deg});
        c.linearity_deg = high - low;
    }
    c.rise = {upwards(1.0), upwards(2.0), upwards(3.0)};
    find_kink(c);
    if (c.level.inflection_deg)
        c.shoulder = scan_along(lamp, {false, *c.level.inflection_deg + 0.37, -5.0, 5.0}, options); // the steepest rise between two H
    else
        c.shoulder.reason = "no level part to measure from";
    return c;
}

} // namespace fernlicht
