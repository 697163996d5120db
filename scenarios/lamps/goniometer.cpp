#include "scenarios/lamps/goniometer.h"

#include "scenarios/lamps/lamp_text.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

// Per axis and at the middle of an interval. Both axes add, and a kink beside the middle shows at least half its error there.
constexpr double split_above = 4e-4;
constexpr double finest_deg = 1e-3;
constexpr double finest_border_deg = 0.1;

TwoAngles un_angles(const glm::dvec3& d) { return {degrees(std::atan2(d.x, d.z)), degrees(std::atan2(d.y, std::hypot(d.x, d.z)))}; }

/// The native table as a function of H and V; rounding at its edges does not throw a direction out.
struct Native {
    const CandelaTable& table;
    const AngleSystem& system;

    struct Sample {
        double cd = 0.0;
        bool known = false;
    };
    Sample at(double h_deg, double v_deg) const {
        constexpr double rounding_deg = 1e-9;
        const auto snapped = [](double angle, const std::vector<double>& axis) {
            if (angle < axis.front() && angle > axis.front() - rounding_deg)
                return axis.front();
            return angle > axis.back() && angle < axis.back() + rounding_deg ? axis.back() : angle;
        };
        const TwoAngles d = system.to_native(h_deg, v_deg);
        const double h = snapped(d.h_deg, table.h_deg), v = snapped(d.v_deg, table.v_deg);
        const double cd = intensity_cd(table, h, v);
        return {cd, cd > 0.0 || has_data(table, h, v)};
    }
};

double middle_by_rule(double a, double b, BetweenSamples rule) {
    return rule == BetweenSamples::log_cd && a > 0.0 && b > 0.0 ? std::sqrt(a) * std::sqrt(b) : (a + b) / 2.0;
}

/// What an interval loses at its middle; where data end inside it, all the light there, until it is narrow.
double interval_error(const Native::Sample& a, const Native::Sample& middle, const Native::Sample& b, double width, BetweenSamples rule) {
    if (a.known && middle.known && b.known)
        return width > 2.0 * finest_deg ? std::abs(middle.cd - middle_by_rule(a.cd, b.cd, rule)) : 0.0;
    return width > finest_border_deg ? std::max({a.cd, middle.cd, b.cd}) : 0.0;
}

struct Axes {
    std::vector<double> h, v;
};

std::vector<double> with_middles(const std::vector<double>& axis) {
    std::vector<double> out;
    for (std::size_t i = 0; i + 1 < axis.size(); ++i) {
        out.push_back(axis[i]);
        out.push_back((axis[i] + axis[i + 1]) / 2.0);
    }
    out.push_back(axis.back());
    return out;
}

/// In cd, one per interval.
Axes interval_errors(const Native& native, const Axes& axes) {
    const std::vector<double> h = with_middles(axes.h), v = with_middles(axes.v);
    Axes errors{std::vector<double>(axes.h.size() - 1), std::vector<double>(axes.v.size() - 1)};
    std::vector<Native::Sample> rows[3];
    for (auto& row : rows)
        row.resize(h.size());
    for (std::size_t y = 0; y < v.size(); ++y) {
        auto& row = rows[y % 3];
        for (std::size_t x = 0; x < h.size(); ++x)
            row[x] = native.at(h[x], v[y]);
        for (std::size_t x = 0; x + 2 < h.size(); x += 2)
            errors.h[x / 2] = std::max(errors.h[x / 2], interval_error(row[x], row[x + 1], row[x + 2], h[x + 2] - h[x], native.table.rule));
        if (y < 2 || y % 2 == 1)
            continue;
        double& worst = errors.v[y / 2 - 1];
        for (std::size_t x = 0; x < h.size(); ++x)
            worst = std::max(worst, interval_error(rows[(y - 2) % 3][x], rows[(y - 1) % 3][x], row[x], v[y] - v[y - 2], native.table.rule));
    }
    return errors;
}

/// Splits the worst intervals first, as far as the budget goes. False when none needed it or none could be.
bool split_worst(Axes& axes, const Axes& errors, double tolerance_cd) {
    struct Interval {
        double error;
        bool along_h;
        double middle;
    };
    std::vector<Interval> wanting;
    const auto collect = [&](const std::vector<double>& axis, const std::vector<double>& error, bool along_h) {
        for (std::size_t i = 0; i < error.size(); ++i)
            if (error[i] > tolerance_cd)
                wanting.push_back({error[i], along_h, (axis[i] + axis[i + 1]) / 2.0});
    };
    collect(axes.h, errors.h, true);
    collect(axes.v, errors.v, false);
    std::stable_sort(wanting.begin(), wanting.end(), [](const Interval& a, const Interval& b) { return a.error > b.error; });
    std::size_t columns = axes.h.size(), rows = axes.v.size();
    bool split = false;
    for (const Interval& interval : wanting) {
        if ((columns + interval.along_h) * (rows + !interval.along_h) > most_resampled)
            break;
        (interval.along_h ? axes.h : axes.v).push_back(interval.middle);
        (interval.along_h ? columns : rows) += 1;
        split = true;
    }
    std::sort(axes.h.begin(), axes.h.end());
    std::sort(axes.v.begin(), axes.v.end());
    return split;
}

void tidy(std::vector<double>& axis, double limit) {
    for (double& angle : axis)
        angle = std::abs(angle) < 1e-12 ? 0.0 : std::clamp(angle, -limit, limit);
    std::sort(axis.begin(), axis.end());
    // Nearer than this, two angles are one that was computed twice; the first stays.
    axis.erase(std::unique(axis.begin(), axis.end(), [](double a, double b) { return b - a < 1e-7; }), axis.end());
}

void place(std::vector<double>& axis, double angle) {
    std::erase_if(axis, [&](double other) { return std::abs(other - angle) < 1e-7; });
    axis.insert(std::upper_bound(axis.begin(), axis.end(), angle), angle);
}

/// A thousand of the angles, the outermost two among them.
std::vector<double> thinned(const std::vector<double>& axis) {
    constexpr std::size_t kept = 1000;
    std::vector<double> out;
    for (std::size_t i = 0; i < kept; ++i)
        out.push_back(axis[i * (axis.size() - 1) / (kept - 1)]);
    return out;
}

/// The images of the native samples on the system's central lines, of its border's extremes, and of its peak.
Axes first_axes(const Native& native) {
    const CandelaTable& t = native.table;
    Axes axes, border;
    const auto add = [&](Axes& to, double h, double v) {
        const TwoAngles d = native.system.to_un(h, v);
        to.h.push_back(d.h_deg);
        to.v.push_back(d.v_deg);
    };
    const auto on = [](const std::vector<double>& axis, double angle) { return angle >= axis.front() && angle <= axis.back(); };
    for (const double h : {-90.0, 0.0, 90.0, 180.0}) {
        if (!on(t.h_deg, h))
            continue;
        for (const double v : t.v_deg)
            add(axes, h, v);
        if (on(t.v_deg, 0.0)) // where lines cross: the samples may be poles alone
            add(axes, h, 0.0);
    }
    for (const double h : t.h_deg) {
        if (on(t.v_deg, 0.0))
            add(axes, h, 0.0);
        add(border, h, t.v_deg.front());
        add(border, h, t.v_deg.back());
    }
    for (const double v : t.v_deg) {
        add(border, t.h_deg.front(), v);
        add(border, t.h_deg.back(), v);
    }
    const auto widen = [](std::vector<double>& axis, const std::vector<double>& by, double limit) {
        const auto [low, high] = std::minmax_element(by.begin(), by.end());
        axis.insert(axis.end(), {*low, *high});
        tidy(axis, limit);
    };
    widen(axes.h, border.h, 180.0);
    widen(axes.v, border.v, 90.0);
    if (axes.h.size() * axes.v.size() > max_made_samples)
        axes = {thinned(axes.h), thinned(axes.v)};
    // The peak keeps its place to the last digit: a neighbour that is all but the same angle gives way.
    const Peak peak = peak_of(t);
    const TwoAngles at_peak = native.system.to_un(peak.h_deg, peak.v_deg);
    place(axes.h, std::abs(at_peak.h_deg) < 1e-12 ? 0.0 : at_peak.h_deg);
    place(axes.v, std::abs(at_peak.v_deg) < 1e-12 ? 0.0 : at_peak.v_deg);
    return axes;
}

/// Light within a cell: the native table's, where it has data, at 8 x 8 places; none where 3 x 3 of a cell whose corners are all `outside`
/// find no data, as in most of what a border leaves free.
double native_light(const Native& native, double h0, double h1, double v0, double v1, bool outside) {
    constexpr int parts = 8, looks = 3;
    bool empty = outside;
    for (int i = 0; empty && i < looks * looks; ++i) {
        const int column = i % looks, row = i / looks;
        empty = !native.at(h0 + (h1 - h0) * (column + 0.5) / looks, v0 + (v1 - v0) * (row + 0.5) / looks).known;
    }
    if (empty)
        return 0.0;
    double sum = 0.0;
    for (int j = 0; j < parts; ++j) {
        const double v = v0 + (v1 - v0) * (j + 0.5) / parts;
        for (int i = 0; i < parts; ++i)
            sum += native.at(h0 + (h1 - h0) * (i + 0.5) / parts, v).cd * std::cos(radians(v));
    }
    return sum / (parts * parts) * radians(h1 - h0) * radians(v1 - v0);
}

/// Each sample without data that has some beside it takes their mean; the cells it is a corner of are settled with it.
void fill_border(const std::vector<unsigned char>& known, CandelaTable& table) {
    const auto columns = static_cast<std::ptrdiff_t>(table.h_deg.size()), rows = static_cast<std::ptrdiff_t>(table.v_deg.size());
    for (std::ptrdiff_t y = 0; y < rows; ++y)
        for (std::ptrdiff_t x = 0; x < columns; ++x) {
            if (known[static_cast<std::size_t>(y * columns + x)])
                continue;
            double sum = 0.0;
            int count = 0;
            for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(y - 1, 0); j <= std::min(y + 1, rows - 1); ++j)
                for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(x - 1, 0); i <= std::min(x + 1, columns - 1); ++i)
                    if (const auto at = static_cast<std::size_t>(j * columns + i); known[at]) {
                        sum += table.cd[at];
                        ++count;
                    }
            if (count > 0)
                table.cd[static_cast<std::size_t>(y * columns + x)] = sum / count;
        }
}

/// Where data end inside cells, as many of these cells are data as hold the light of all their parts that have data: each is in or out,
/// and what that adds or takes is made up for by the next.
void settle_border(const Native& native, const std::vector<unsigned char>& known, CandelaTable& table) {
    fill_border(known, table);
    const std::size_t width = table.h_deg.size();
    double surplus_lm = 0.0;
    for (std::size_t y = 0; y + 1 < table.v_deg.size(); ++y)
        for (std::size_t x = 0; x + 1 < width; ++x) {
            const std::size_t i = y * width + x;
            const int corners = known[i] + known[i + 1] + known[i + width] + known[i + width + 1];
            bool gap = corners < 4;
            if (const double h0 = table.h_deg[x], h1 = table.h_deg[x + 1], v0 = table.v_deg[y], v1 = table.v_deg[y + 1]; gap) {
                surplus_lm -= native_light(native, h0, h1, v0, v1, corners == 0);
                const std::vector<double> cd{table.cd[i], table.cd[i + 1], table.cd[i + width], table.cd[i + width + 1]};
                const double whole_lm = corners > 0 ? flux_lm({{h0, h1}, {v0, v1}, cd, {}, table.rule}) : 0.0;
                gap = corners == 0 || surplus_lm + whole_lm / 2.0 > 0.0;
                surplus_lm += gap ? 0.0 : whole_lm;
            }
            table.gaps.push_back(gap);
        }
}

CandelaTable sampled(const Native& native, const Axes& axes) {
    CandelaTable out{axes.h, axes.v, {}, {}, native.table.rule};
    std::vector<unsigned char> known;
    out.cd.reserve(axes.h.size() * axes.v.size());
    known.reserve(out.cd.capacity());
    for (const double v : axes.v)
        for (const double h : axes.h) {
            const Native::Sample sample = native.at(h, v);
            out.cd.push_back(sample.cd);
            known.push_back(sample.known);
        }
    if (std::all_of(known.begin(), known.end(), [](unsigned char k) { return k != 0; }))
        return out;
    settle_border(native, known, out);
    return out;
}

/// Worst difference at directions spread evenly over the table (the additive sequence of the plastic number), and over its peak.
double worst_difference_cd(const Native& native, const CandelaTable& table) {
    const Peak peak = peak_of(table);
    double worst = 0.0;
    const auto count = static_cast<int>(std::min<std::size_t>(40'000, most_resampled));
    const auto probe = [&](double h0, double h1, double v0, double v1, int places) {
        for (int i = 1; i <= places; ++i) {
            const double a = i * 0.7548776662466927, b = i * 0.5698402909980532;
            const double h = h0 + (h1 - h0) * (a - std::floor(a)), v = v0 + (v1 - v0) * (b - std::floor(b));
            if (const Native::Sample sample = native.at(h, v); sample.known && has_data(table, h, v))
                worst = std::max(worst, std::abs(intensity_cd(table, h, v) - sample.cd));
        }
    };
    probe(table.h_deg.front(), table.h_deg.back(), table.v_deg.front(), table.v_deg.back(), count);
    probe(peak.h_deg - 5.0, peak.h_deg + 5.0, peak.v_deg - 3.0, peak.v_deg + 3.0, count / 2);
    return worst;
}

} // namespace

glm::dvec3 direction_of(double h_deg, double v_deg) {
    const double h = radians(h_deg), v = radians(v_deg);
    return {std::sin(h) * std::cos(v), std::sin(v), std::cos(h) * std::cos(v)};
}

AngleSystem type_b() {
    return {"type B",
            [](double h, double v) {
                const glm::dvec3 d = direction_of(h, v);
                return TwoAngles{degrees(std::atan2(d.x, std::hypot(d.y, d.z))), degrees(std::atan2(d.y, d.z))};
            },
            [](double h_deg, double v_deg) {
                const double h = radians(h_deg), v = radians(v_deg);
                return un_angles({std::sin(h), std::cos(h) * std::sin(v), std::cos(h) * std::cos(v)});
            },
            false};
}

AngleSystem flat_screen() {
    return {"flat screen",
            [](double h, double v) {
                const glm::dvec3 d = direction_of(h, v);
                // Behind the lamp there is no screen: 180 lies outside every screen's angles.
                return d.z > 0.0 ? TwoAngles{h, degrees(std::atan2(d.y, d.z))} : TwoAngles{180.0, 90.0};
            },
            [](double h_deg, double v_deg) {
                return un_angles({std::tan(radians(h_deg)), std::tan(radians(v_deg)), 1.0});
            },
            false};
}

AngleSystem beam_along_nadir() {
    return {"C planes about the beam",
            [](double h, double v) {
                const glm::dvec3 d = direction_of(h, v);
                const double gamma = degrees(std::atan2(std::hypot(d.x, d.y), d.z));
                const double c = d.x == 0.0 && d.y == 0.0 ? 0.0 : degrees(std::atan2(d.y, d.x));
                return TwoAngles{-c, gamma - 90.0};
            },
            [](double h_deg, double v_deg) {
                const double c = radians(-h_deg), gamma = radians(v_deg + 90.0);
                return un_angles({std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), std::cos(gamma)});
            },
            true};
}

MeasuredTable scaled(MeasuredTable measured, double factor) {
    measured.table = scaled(std::move(measured.table), factor);
    return measured;
}

MeasuredTable mirrored(MeasuredTable measured) {
    measured.system.to_native = [to_native = measured.system.to_native](double h, double v) { return to_native(-h, v); };
    measured.system.to_un = [to_un = measured.system.to_un](double h, double v) {
        const TwoAngles d = to_un(h, v);
        return TwoAngles{-d.h_deg, d.v_deg};
    };
    return measured;
}

void bring_onto_goniometer(CandelaTable native_table, AngleSystem system, LampFile& lamp) {
    const Native native{native_table, system};
    const double peak_cd = peak_of(native_table).cd;
    Axes axes = first_axes(native);
    if (axes.h.size() < 2 || axes.v.size() < 2)
        throw InputError({lamp.opened.empty() ? std::filesystem::path() : lamp.opened.front().path, 0, 0, system.name},
                         fmt::format("found all directions at one {}", axes.h.size() < 2 ? "H" : "V"),
                         "directions to all sides of the beam");
    while (split_worst(axes, interval_errors(native, axes), split_above * peak_cd)) {
    }
    CandelaTable table = sampled(native, axes);
    const double worst = peak_cd > 0.0 ? worst_difference_cd(native, table) / peak_cd : 0.0;
    lamp.notes.push_back(fmt::format(
        "Resampled from {} ({} x {} samples) onto the goniometer's H and V ({} x {}): differs by at most {:.2g} % of the peak.",
        system.name, native_table.h_deg.size(), native_table.v_deg.size(), table.h_deg.size(), table.v_deg.size(), 100.0 * worst));
    lamp.table = std::move(table);
    lamp.measured = MeasuredTable{std::move(native_table), std::move(system)};
}

} // namespace fernlicht
