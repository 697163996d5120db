#include "metrics/beam/cut_off_elbow.h"

#include "metrics/statistics/statistics.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

constexpr double from_h_deg = -5.0, to_h_deg = 6.0, from_v_deg = -3.5, to_v_deg = 5.0;
constexpr double half_window_deg = 0.16;
constexpr double min_fall = 1.5;     // ln I per degree
constexpr double min_light = 0.02;   // of the peak, below the edge
constexpr double min_slope = 0.0524; // tan 3 degrees
constexpr double fewest_rising_columns = 2.0;
constexpr double z99 = 2.576;

/// Steps of a column: V of its middle, and the fall of ln I per degree there.
struct Fall {
    double v_deg, fall;
};

std::vector<Fall> falls_of(const CandelaTable& t, std::size_t column, double darkest) {
    std::vector<double> ln(t.v_deg.size());
    for (std::size_t j = 0; j < ln.size(); ++j)
        ln[j] = std::log(std::max(t.at(j, column), darkest));
    std::vector<Fall> falls;
    for (std::size_t j = 0; j + 1 < ln.size(); ++j) {
        const double middle = (t.v_deg[j] + t.v_deg[j + 1]) / 2.0;
        if (middle < from_v_deg || middle > to_v_deg)
            continue;
        // The straight line through the samples within the window, at least the step's own two.
        std::size_t first = j, last = j + 1;
        while (first > 0 && t.v_deg[first - 1] >= middle - half_window_deg)
            --first;
        while (last + 1 < ln.size() && t.v_deg[last + 1] <= middle + half_window_deg)
            ++last;
        double v_mean = 0.0, ln_mean = 0.0, vv = 0.0, vl = 0.0;
        const auto n = static_cast<double>(last - first + 1);
        for (std::size_t k = first; k <= last; ++k) {
            v_mean += t.v_deg[k] / n;
            ln_mean += ln[k] / n;
        }
        for (std::size_t k = first; k <= last; ++k) {
            vv += (t.v_deg[k] - v_mean) * (t.v_deg[k] - v_mean);
            vl += (t.v_deg[k] - v_mean) * (ln[k] - ln_mean);
        }
        falls.push_back({v_mean, -vl / vv});
    }
    return falls;
}

/// How far off the middle of a logistic fall sampled in steps is found, in steps, where one step holds `share` of it: the first harmonic of
/// the sum that stands for the integral, four times for edges of other forms. Where one step holds all, the edge lies anywhere within it.
double sampling_error(double share) {
    if (share > 0.99)
        return 0.5;
    const double u = 2.0 * std::atanh(std::max(share, 0.1)), pi = 3.14159265358979;
    return std::min(0.5, 0.01 + 4.0 * pi / u * std::exp(-pi * pi / u));
}

/// The middle of the steepest fall: where the falls of the file's own steps, weighed by a Gaussian round it, have their centroid.
std::optional<EdgePoint> edge_of(const CandelaTable& t, std::size_t column, double turned_v_deg, double peak) {
    const std::vector<Fall> smooth = falls_of(t, column, 1e-4 * peak);
    const Fall* top = nullptr;
    for (const Fall& f : smooth)
        if (f.fall >= min_fall && (!top || f.fall > top->fall) &&
            intensity_cd(t, t.h_deg[column], f.v_deg - half_window_deg) >= min_light * peak)
            top = &f;
    if (!top)
        return std::nullopt;
    const auto ln = [&](std::size_t j) { return std::log(std::max(t.at(j, column), 1e-4 * peak)); };
    double middle = top->v_deg, share = 1.0, step = 0.0;
    for (int round = 0; round < 30; ++round) {
        double total = 0.0, place = 0.0, most = 0.0, all = 0.0;
        for (std::size_t j = 0; j + 1 < t.v_deg.size(); ++j) {
            const double v = (t.v_deg[j] + t.v_deg[j + 1]) / 2.0, width = t.v_deg[j + 1] - t.v_deg[j];
            const double spread = std::max(0.2, width);
            if (std::abs(v - middle) > 4.0 * spread)
                continue;
            const double fall = ln(j) - ln(j + 1), weight = std::exp(-0.5 * (v - middle) * (v - middle) / (spread * spread));
            total += weight * fall;
            place += weight * fall * v;
            if (std::abs(v - middle) < 2.0 * spread)
                all += std::max(0.0, fall);
            if (fall > most) {
                most = fall;
                step = width;
            }
        }
        if (total <= 0.0)
            return std::nullopt;
        const double next = place / total;
        share = most / std::max(all, most);
        if (std::abs(next - top->v_deg) > std::max(0.5, step))
            return std::nullopt;
        if (std::abs(next - middle) < 1e-5)
            break;
        middle = next;
    }
    return EdgePoint{0.0, middle + turned_v_deg, step * sampling_error(share), true};
}

/// v0 + slope * clamp(h - h0, 0, h1 - h0): v0 and slope by least squares for given h0 and h1.
struct Fit {
    double h0 = 0.0, h1 = 0.0, v0 = 0.0, slope = 0.0;
    double cost = std::numeric_limits<double>::infinity();
    double at(double h) const { return v0 + slope * (std::clamp(h, h0, h1) - h0); }
};

Fit level_and_slope(const std::vector<EdgePoint>& points, double h0, double h1) {
    double n = 0.0, sf = 0.0, sff = 0.0, sv = 0.0, sfv = 0.0, svv = 0.0;
    for (const EdgePoint& p : points) {
        if (!p.used)
            continue;
        const double f = std::clamp(p.h_deg, h0, h1) - h0;
        n += 1.0;
        sf += f;
        sff += f * f;
        sv += p.v_deg;
        sfv += f * p.v_deg;
        svv += p.v_deg * p.v_deg;
    }
    Fit fit{h0, h1};
    const double det = n * sff - sf * sf;
    if (det < 1e-9)
        return fit;
    fit.slope = (n * sfv - sf * sv) / det;
    fit.v0 = (sv - fit.slope * sf) / n;
    if (fit.slope > 0.0)
        fit.cost = std::max(0.0, svv - fit.v0 * sv - fit.slope * sfv);
    return fit;
}

/// A rise of at least `shortest_deg` between the first and the last column.
Fit best_fit(const std::vector<EdgePoint>& points, double shortest_deg) {
    const double first = points.front().h_deg, last = points.back().h_deg;
    Fit best;
    const auto search = [&](double h0_from, double h0_to, double h1_from, double h1_to, double step) {
        for (double h0 = h0_from; h0 <= h0_to; h0 += step)
            for (double h1 = std::max(h1_from, h0 + shortest_deg); h1 <= h1_to; h1 += step)
                if (const Fit fit = level_and_slope(points, h0, std::min(h1, last)); fit.cost < best.cost)
                    best = fit;
    };
    search(first + 0.5, std::min(3.0, last - shortest_deg), first, last + 0.1, 0.1);
    for (const double step : {0.02, 0.004}) {
        const Fit middle = best;
        const double reach = 6.0 * step;
        search(middle.h0 - reach, middle.h0 + reach, middle.h1 - reach, std::min(middle.h1 + reach, last + step), step);
    }
    return best;
}

/// Leaves out what lies far off and fits again.
Fit robust_fit(std::vector<EdgePoint>& points, double shortest_deg, double row_step_deg, double& sigma) {
    Fit fit = best_fit(points, shortest_deg);
    for (int round = 0; round < 3; ++round) {
        std::vector<double> off;
        for (const EdgePoint& p : points)
            off.push_back(std::abs(p.v_deg - fit.at(p.h_deg)));
        sigma = 1.4826 * middle_of(off);
        const double most = std::max(4.0 * sigma, 0.03 + 0.3 * row_step_deg);
        bool changed = false;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool use = off[i] <= most + 2.0 * points[i].error_deg;
            changed = changed || use != points[i].used;
            points[i].used = use;
        }
        if (!changed)
            break;
        fit = best_fit(points, shortest_deg);
    }
    // On a coarse file most of the level part is found at one height: the scatter is that of the rise.
    double squares = 0.0, used = 0.0;
    for (const EdgePoint& p : points)
        if (p.used) {
            squares += (p.v_deg - fit.at(p.h_deg)) * (p.v_deg - fit.at(p.h_deg));
            used += 1.0;
        }
    sigma = std::max(sigma, std::sqrt(squares / used));
    return fit;
}

/// Variances of h0 and v0 for a variance of 1 in each point: the inverse of the sum of outer products of d v / d (v0, slope, h0, h1).
std::pair<double, double> variances(const std::vector<EdgePoint>& points, const Fit& fit) {
    constexpr std::size_t n = 4;
    std::array<std::array<double, 2 * n>, n> m{};
    for (const EdgePoint& p : points) {
        if (!p.used)
            continue;
        const bool rising = p.h_deg > fit.h0 && p.h_deg < fit.h1, beyond = p.h_deg >= fit.h1;
        const std::array<double, n> d{1.0, std::clamp(p.h_deg, fit.h0, fit.h1) - fit.h0, rising || beyond ? -fit.slope : 0.0,
                                      beyond ? fit.slope : 0.0};
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t b = 0; b < n; ++b)
                m[a][b] += d[a] * d[b];
    }
    for (std::size_t a = 0; a < n; ++a) {
        m[a][a] += 1e-9; // without a shoulder nothing depends on h1
        m[a][n + a] = 1.0;
    }
    for (std::size_t a = 0; a < n; ++a) {
        const double pivot = m[a][a];
        for (double& x : m[a])
            x /= pivot;
        for (std::size_t b = 0; b < n; ++b) {
            if (b == a)
                continue;
            const double times = m[b][a];
            for (std::size_t c = 0; c < 2 * n; ++c)
                m[b][c] -= times * m[a][c];
        }
    }
    return {m[2][n + 2], m[0][n]};
}

} // namespace

double CutOffElbow::edge_deg(double h_deg) const {
    const double to = rise_to_h_deg.value_or(std::numeric_limits<double>::infinity());
    return at->v_deg + std::tan(radians(rise_angle_deg)) * (std::clamp(h_deg, at->h_deg, to) - at->h_deg);
}

CutOffElbow fit_elbow(const AimedLamp& lamp) {
    const CandelaTable& t = *lamp.table;
    CutOffElbow elbow;
    const double peak = peak_of(t).cd;
    double column_step = 0.0;
    for (std::size_t i = 0; i < t.h_deg.size() && peak > 0.0; ++i) {
        const double h = t.h_deg[i] + lamp.turned.h_deg;
        if (h < from_h_deg || h > to_h_deg)
            continue;
        if (i > 0)
            column_step = std::max(column_step, t.h_deg[i] - t.h_deg[i - 1]);
        if (auto edge = edge_of(t, i, lamp.turned.v_deg, peak)) {
            edge->h_deg = h;
            elbow.points.push_back(*edge);
        }
    }
    if (elbow.points.size() < 8 || elbow.points.back().h_deg - elbow.points.front().h_deg < 3.0) {
        elbow.reason = fmt::format("an edge in {} columns only between 5 degrees left and 6 right", elbow.points.size());
        return elbow;
    }
    const double shortest = std::max(0.1, fewest_rising_columns * column_step);
    double sigma = 0.0;
    double row_step = 0.0;
    for (std::size_t j = 1; j < t.v_deg.size(); ++j)
        if (std::abs(t.v_deg[j] + lamp.turned.v_deg - elbow.points.front().v_deg) < 1.0)
            row_step = std::max(row_step, t.v_deg[j] - t.v_deg[j - 1]);
    const Fit fit = robust_fit(elbow.points, shortest, row_step, sigma);
    if (!(fit.slope >= min_slope)) {
        elbow.reason = "the edge has no rise of 3 degrees or more";
        return elbow;
    }
    double level_error = 0.0, rise_error = 0.0, level = 0.0, rising = 0.0, v_step = 0.0;
    for (const EdgePoint& p : elbow.points) {
        if (!p.used)
            continue;
        const bool left = p.h_deg <= fit.h0, right = p.h_deg > fit.h0 && p.h_deg < fit.h1;
        (left ? level_error : rise_error) += left || right ? p.error_deg : 0.0;
        level += left;
        rising += right;
        v_step = std::max(v_step, p.error_deg);
    }
    if (level < 3.0 || rising < fewest_rising_columns) {
        elbow.reason =
            fmt::format("{:.0f} columns on the level part and {:.0f} on the rise, and at least 3 and 2 are needed", level, rising);
        return elbow;
    }
    // The level part meets the file's rows in one place, the rise in as many as it crosses.
    level_error /= level;
    rise_error /= rising * std::sqrt(std::max(1.0, (fit.at(fit.h1) - fit.v0) / std::max(2.0 * v_step, 1e-3)));
    const auto [h_variance, v_variance] = variances(elbow.points, fit);
    sigma = std::max(sigma, 0.003);
    // Between two columns the break may lie anywhere: what few columns on the rise leave open comes on top.
    elbow.uncertainty = {2.0 * (z99 * sigma * std::sqrt(h_variance) + std::hypot(level_error, rise_error) / fit.slope) + 0.003 +
                             0.8 * column_step / rising,
                         z99 * sigma * std::sqrt(v_variance) + level_error};
    if (elbow.uncertainty.h_deg > std::max(0.1, column_step)) {
        elbow.reason = fmt::format("the file's samples place the elbow to {:.2f} degrees only", elbow.uncertainty.h_deg);
        return elbow;
    }
    elbow.at = Direction{fit.h0, fit.v0};
    elbow.rise_angle_deg = degrees(std::atan(fit.slope));
    if (fit.h1 < elbow.points.back().h_deg - column_step)
        elbow.rise_to_h_deg = fit.h1;
    return elbow;
}

} // namespace fernlicht
