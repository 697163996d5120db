#include "scenarios/lamps/spots/spot_refinement.h"

#include "scenarios/lamps/goniometer.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace fernlicht {
namespace {

constexpr std::size_t per_spot = 4; // H and V in radians, cd, exponent

using Parameters = std::vector<double>;

Parameters parameters_of(std::span<const Spot> spots) {
    Parameters p;
    for (const Spot& spot : spots)
        p.insert(p.end(), {radians(spot.h_deg), radians(spot.v_deg), spot.cd, spot.exponent});
    return p;
}

struct Bounds {
    double low, high;
};
Bounds bounds_of(std::size_t parameter) {
    constexpr std::array<Bounds, per_spot> of{{{-pi / 2, pi / 2}, {-pi / 2, pi / 2}, {0.0, 1e300}, {0.0, 128.0}}};
    return of[parameter % per_spot];
}

void take(std::vector<Spot>& spots, const Parameters& p) {
    for (std::size_t k = 0; k < spots.size(); ++k) {
        spots[k].h_deg = degrees(p[k * per_spot]);
        spots[k].v_deg = degrees(p[k * per_spot + 1]);
        spots[k].cd = p[k * per_spot + 2];
        spots[k].exponent = p[k * per_spot + 3];
    }
}

double cutoff_cosine(const Spot& spot) { return std::max(std::cos(radians(spot.cutoff_deg)), 1e-12); }

/// Columns of d(fit) / d(parameter), each over all directions, times sqrt(weight).
std::vector<std::vector<double>> derivatives(const SpotDirections& d, std::span<const Spot> spots) {
    std::vector<std::vector<double>> columns(spots.size() * per_spot, std::vector<double>(d.size(), 0.0));
    for (std::size_t k = 0; k < spots.size(); ++k) {
        const Spot& spot = spots[k];
        const double h = radians(spot.h_deg), v = radians(spot.v_deg), least = cutoff_cosine(spot);
        const glm::dvec3 axis = direction_of(spot.h_deg, spot.v_deg);
        const glm::dvec3 along_h{std::cos(v) * std::cos(h), 0.0, -std::cos(v) * std::sin(h)};
        const glm::dvec3 along_v{-std::sin(v) * std::sin(h), std::cos(v), -std::sin(v) * std::cos(h)};
        for (std::size_t i = 0; i < d.size(); ++i) {
            const glm::dvec3 to{d.x[i], d.y[i], d.z[i]};
            const double cosine = glm::dot(axis, to);
            if (cosine < least)
                continue;
            const double logarithm = std::log(cosine), shape = std::exp(spot.exponent * logarithm) * std::sqrt(d.weight_sr[i]);
            const double slope = spot.cd * spot.exponent * shape / cosine;
            columns[k * per_spot][i] = slope * glm::dot(along_h, to);
            columns[k * per_spot + 1][i] = slope * glm::dot(along_v, to);
            columns[k * per_spot + 2][i] = shape;
            columns[k * per_spot + 3][i] = spot.cd * shape * logarithm;
        }
    }
    return columns;
}

/// Solves a symmetric positive definite system in place by Cholesky; false where it is not positive definite.
bool solve(std::vector<double>& a, std::vector<double>& b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = a[i * n + j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= a[i * n + k] * a[j * n + k];
            if (i == j && !(sum > 0.0))
                return false;
            a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
        }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k)
            b[i] -= a[k * n + i] * b[k];
        b[i] /= a[i * n + i];
    }
    return true;
}

/// The normal equations at one set of spots.
struct Normal {
    std::vector<double> matrix, gradient; ///< J'J, and J' (table - fit)
};

Normal normal_of(const SpotDirections& d, std::span<const Spot> spots, std::span<const double> residual) {
    const std::vector<std::vector<double>> columns = derivatives(d, spots);
    const std::size_t n = columns.size();
    Normal normal{std::vector<double>(n * n), std::vector<double>(n)};
    // Four sums side by side: in a fixed order, and without waiting for each addition.
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        std::array<double, 4> s{};
        std::size_t i = 0;
        for (; i + 4 <= a.size(); i += 4)
            for (std::size_t lane = 0; lane < 4; ++lane)
                s[lane] += a[i + lane] * b[i + lane];
        for (; i < a.size(); ++i)
            s[0] += a[i] * b[i];
        return (s[0] + s[1]) + (s[2] + s[3]);
    };
    std::vector<double> weighted(d.size());
    for (std::size_t i = 0; i < d.size(); ++i)
        weighted[i] = residual[i] * std::sqrt(d.weight_sr[i]);
    for (std::size_t row = 0; row < n; ++row) {
        normal.gradient[row] = dot(columns[row], weighted);
        for (std::size_t column = 0; column <= row; ++column)
            normal.matrix[row * n + column] = normal.matrix[column * n + row] = dot(columns[row], columns[column]);
    }
    return normal;
}

/// One damped step, kept within the bounds. Parameters that lie on a bound and would leave it are held.
Parameters step_from(const Parameters& p, const Normal& normal, double damping) {
    const std::size_t n = p.size();
    std::vector<std::size_t> freely;
    for (std::size_t i = 0; i < n; ++i) {
        const Bounds b = bounds_of(i);
        const bool held = (p[i] <= b.low && normal.gradient[i] < 0.0) || (p[i] >= b.high && normal.gradient[i] > 0.0);
        if (!held && normal.matrix[i * n + i] > 0.0)
            freely.push_back(i);
    }
    std::vector<double> a(freely.size() * freely.size()), b(freely.size());
    for (std::size_t i = 0; i < freely.size(); ++i) {
        b[i] = normal.gradient[freely[i]];
        for (std::size_t k = 0; k < freely.size(); ++k)
            a[i * freely.size() + k] = normal.matrix[freely[i] * n + freely[k]] * (i == k ? 1.0 + damping : 1.0);
    }
    Parameters next = p;
    if (!solve(a, b))
        return next;
    for (std::size_t i = 0; i < freely.size(); ++i) {
        const Bounds limits = bounds_of(freely[i]);
        next[freely[i]] = std::clamp(p[freely[i]] + b[i], limits.low, limits.high);
    }
    return next;
}

/// Spot intensity over all directions, for cd = 1.
std::vector<double> shape_over(const SpotDirections& d, const Spot& spot) {
    std::vector<double> shape(d.size());
    const glm::dvec3 axis = direction_of(spot.h_deg, spot.v_deg);
    const double least = cutoff_cosine(spot);
    for (std::size_t i = 0; i < d.size(); ++i) {
        const double cosine = axis.x * d.x[i] + axis.y * d.y[i] + axis.z * d.z[i];
        shape[i] = cosine < least ? 0.0 : std::exp(spot.exponent * std::log(cosine));
    }
    return shape;
}

/// The best cut-off, of all that differ on these directions, and the intensity that goes with it.
Gain best_cutoff(const SpotDirections& d, const std::vector<double>& residual, Spot spot) {
    spot.cutoff_deg = 90.0;
    spot.cd = 0.0;
    const std::vector<double> shape = shape_over(d, spot);
    const glm::dvec3 axis = direction_of(spot.h_deg, spot.v_deg);
    std::vector<std::pair<double, std::size_t>> outwards; // minus the cosine, direction
    for (std::size_t i = 0; i < d.size(); ++i)
        if (shape[i] > 1e-9)
            outwards.emplace_back(-(axis.x * d.x[i] + axis.y * d.y[i] + axis.z * d.z[i]), i);
    std::ranges::sort(outwards);
    Gain best{spot, 0.0};
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < outwards.size(); ++i) {
        const auto [minus_cosine, at] = outwards[i];
        product += d.weight_sr[at] * shape[at] * residual[at];
        square += d.weight_sr[at] * shape[at] * shape[at];
        const bool last = i + 1 == outwards.size();
        if (product <= 0.0 || (!last && outwards[i + 1].first == minus_cosine))
            continue;
        const double gain = product * product / square;
        if (gain < best.cd2_sr * (last ? 1.0 - 1e-12 : 1.0)) // no cut-off where it does not matter
            continue;
        best = {spot, gain};
        best.spot.cd = product / square;
        if (!last) // between this direction and the next
            best.spot.cutoff_deg =
                0.5 * degrees(std::acos(std::min(-minus_cosine, 1.0)) + std::acos(std::min(-outwards[i + 1].first, 1.0)));
    }
    return best;
}

} // namespace

std::vector<double> residual_of(const SpotDirections& d, std::span<const Spot> spots) {
    std::vector<double> residual = d.cd;
    for (const Spot& spot : spots) {
        const std::vector<double> shape = shape_over(d, spot);
        for (std::size_t i = 0; i < residual.size(); ++i)
            residual[i] -= spot.cd * shape[i];
    }
    return residual;
}

double left_over_cd2_sr(const SpotDirections& d, std::span<const double> residual) {
    double sum = 0.0;
    for (std::size_t i = 0; i < residual.size(); ++i)
        sum += d.weight_sr[i] * residual[i] * residual[i];
    return sum;
}

void refine_together(const SpotDirections& d, std::vector<Spot>& spots, int steps) {
    constexpr double converged = 1e-5; // of what is left over, gained by a step
    std::vector<double> residual = residual_of(d, spots);
    double left_over = left_over_cd2_sr(d, residual);
    double damping = 1e-3;
    std::vector<Spot> trial = spots;
    for (int step = 0; step < steps && left_over > 0.0; ++step) {
        const Parameters p = parameters_of(spots);
        const Normal normal = normal_of(d, spots, residual);
        bool better = false;
        double gained = 0.0;
        for (int attempt = 0; attempt < 6 && !better; ++attempt) {
            take(trial, step_from(p, normal, damping));
            std::vector<double> trial_residual = residual_of(d, trial);
            const double trial_left_over = left_over_cd2_sr(d, trial_residual);
            better = trial_left_over < left_over;
            damping = std::clamp(damping * (better ? 0.2 : 8.0), 1e-9, 1e9);
            if (!better)
                continue;
            gained = (left_over - trial_left_over) / left_over;
            spots = trial;
            residual = std::move(trial_residual);
            left_over = trial_left_over;
        }
        if (!better || gained < converged)
            return;
    }
}

void refine_alone(const SpotDirections& d, std::vector<Spot>& spots, std::size_t which, double step_deg, double finest_deg) {
    Spot& spot = spots[which];
    const double before = left_over_cd2_sr(d, residual_of(d, spots));
    const Spot known = spot;
    spot.cd = 0.0;
    const std::vector<double> residual = residual_of(d, spots); // of the others
    Gain best = best_cutoff(d, residual, known);
    while (step_deg >= finest_deg) {
        const double factor = 1.0 + 0.4 * step_deg;
        const Spot at = best.spot;
        Gain next = best;
        for (const auto& [h, v, exponent] :
             {std::array{step_deg, 0.0, 1.0}, std::array{-step_deg, 0.0, 1.0}, std::array{0.0, step_deg, 1.0},
              std::array{0.0, -step_deg, 1.0}, std::array{0.0, 0.0, factor}, std::array{0.0, 0.0, 1.0 / factor}}) {
            Spot trial = at;
            trial.h_deg = std::clamp(at.h_deg + h, -90.0, 90.0);
            trial.v_deg = std::clamp(at.v_deg + v, -90.0, 90.0);
            trial.exponent = std::clamp(at.exponent * exponent, 0.0, 128.0);
            if (const Gain there = best_cutoff(d, residual, trial); there.cd2_sr > next.cd2_sr)
                next = there;
        }
        if (next.cd2_sr <= best.cd2_sr)
            step_deg *= 0.5;
        best = next;
    }
    spot = best.spot;
    if (!(left_over_cd2_sr(d, residual_of(d, spots)) < before))
        spot = known;
}

} // namespace fernlicht
