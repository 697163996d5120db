#include "metrics/fit/descent.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double lux_tukey_c = 4.685;
constexpr int most_iterations = 200;
constexpr double near_enough = 1e-10;                      // of the decrement: 1e-5 standard errors
constexpr double least_damping = 1e-12, no_way_down = 1e8; // of damping

double tukey_weight(double z) {
    const double rest = 1.0 - z * z / (lux_tukey_c * lux_tukey_c);
    return rest > 0.0 ? rest * rest : 0.0;
}

Shifts moved(Shifts shifts, const FreeGroups& free, const std::vector<double>& step, const FitBounds& bounds) {
    for (std::size_t g = 0; g < free.size(); ++g)
        for (const Unknown unknown : free[g]) {
            double& value = of_unknown(shifts, unknown);
            value = std::clamp(value + step[g], -bounds.of(unknown), bounds.of(unknown));
        }
    return shifts;
}

/// Rows of J and residuals times a weight each.
struct WeightedProblem {
    std::vector<double> weight, residuals;

    double cost(const std::vector<LuxPoint>& points, const std::vector<double>& lux) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i)
            sum += std::pow(weight[i] * (lux[i] - points[i].lux), 2.0);
        return sum;
    }
};

WeightedProblem weighted(const std::vector<LuxPoint>& points, const Descent& at, const std::vector<bool>& used, bool robust) {
    WeightedProblem problem;
    const std::vector<double> z = normalised_residuals(points, at);
    const double scale = robust ? residual_scale(z, used) : 1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double share = !used[i] ? 0.0 : robust ? std::sqrt(tukey_weight(z[i] / scale)) : 1.0;
        problem.weight.push_back(share / at.sigma_lx[i]);
        problem.residuals.push_back(share * z[i]);
    }
    return problem;
}

Matrix times_rows(Matrix jacobian, const std::vector<double>& weight) {
    for (std::size_t i = 0; i < jacobian.rows; ++i)
        for (std::size_t k = 0; k < jacobian.columns; ++k)
            jacobian.at(i, k) *= weight[i];
    return jacobian;
}

} // namespace

Matrix by_groups(const Matrix& jacobian, const FreeGroups& free) {
    Matrix sums(jacobian.rows, free.size());
    for (std::size_t i = 0; i < jacobian.rows; ++i)
        for (std::size_t g = 0; g < free.size(); ++g)
            for (const Unknown unknown : free[g])
                sums.at(i, g) += jacobian.at(i, unknown);
    return sums;
}

std::vector<double> normalised_residuals(const std::vector<LuxPoint>& points, const Descent& at) {
    std::vector<double> z;
    for (std::size_t i = 0; i < points.size(); ++i)
        z.push_back((at.lux[i] - points[i].lux) / at.sigma_lx[i]);
    return z;
}

double residual_scale(const std::vector<double>& residuals, const std::vector<bool>& used) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < residuals.size(); ++i)
        if (used[i])
            sizes.push_back(std::abs(residuals[i]));
    return std::max(1.0, 1.4826 * middle_of(std::move(sizes)));
}

Matrix weighted_jacobian(const FitModel& model, const FreeGroups& free, const Descent& at, const std::vector<bool>& used) {
    std::vector<double> weight;
    for (std::size_t i = 0; i < used.size(); ++i)
        weight.push_back(used[i] ? 1.0 / at.sigma_lx[i] : 0.0);
    return times_rows(by_groups(model.jacobian(at.shifts), free), weight);
}

Descent descend(const FitModel& model, const FreeGroups& free, Shifts start, const std::vector<bool>& used, bool robust,
                const FitBounds& bounds) {
    Descent at;
    at.shifts = std::move(start);
    at.lux = model.lux(at.shifts);
    at.sigma_lx = model.sigma_lx(at.shifts, at.lux);
    double damping = 1e-3;
    at.converged = free.empty();
    while (!at.converged && at.iterations < most_iterations) {
        ++at.iterations;
        const WeightedProblem problem = weighted(model.points(), at, used, robust);
        const ScaledSvd svd(times_rows(by_groups(model.jacobian(at.shifts), free), problem.weight));
        if (svd.decrement(problem.residuals) < near_enough) {
            at.converged = true;
            break;
        }
        const double cost = problem.cost(model.points(), at.lux);
        for (bool lower = false; !lower && !at.converged;) {
            Shifts next = moved(at.shifts, free, svd.step(problem.residuals, damping), bounds);
            std::vector<double> lux = model.lux(next);
            lower = problem.cost(model.points(), lux) < cost;
            if (lower) {
                at.shifts = std::move(next);
                at.lux = std::move(lux);
                damping = std::max(0.1 * damping, least_damping);
            } else if ((damping = std::max(10.0 * damping, 1e-6)) > no_way_down)
                at.converged = true; // at a kink of the table, or of rounding
        }
        at.sigma_lx = model.sigma_lx(at.shifts, at.lux);
    }
    const std::vector<double> z = normalised_residuals(model.points(), at);
    for (std::size_t i = 0; i < z.size(); ++i)
        at.misfit += used[i] ? std::min(z[i] * z[i], lux_tukey_c * lux_tukey_c) : 0.0;
    return at;
}

} // namespace fernlicht
