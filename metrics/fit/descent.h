// Levenberg-Marquardt over those of the lamps' shifts that are free.
#pragma once

#include "metrics/fit/fit_model.h"

#include <string>

namespace fernlicht {

/// An unknown by its place among all: fit_quantities * lamp + quantity.
using Unknown = std::size_t;
inline double& of_unknown(Shifts& shifts, Unknown unknown) { return shifts[unknown / fit_quantities][unknown % fit_quantities]; }

/// Unknowns that change alike stand in one group; what stands in none is held.
using FreeGroups = std::vector<std::vector<Unknown>>;
/// Columns summed by group.
Matrix by_groups(const Matrix& jacobian, const FreeGroups& free);

/// No fit leaves these.
struct FitBounds {
    double pitch_rad = radians(4.0), yaw_rad = radians(6.5), ln_flux = 4.6, height_m = 0.5;
    double of(Unknown unknown) const { return std::array{pitch_rad, yaw_rad, ln_flux, height_m}[unknown % fit_quantities]; }
};

struct Descent {
    Shifts shifts;
    std::vector<double> lux, sigma_lx;
    int iterations = 0;
    bool converged = false;
    double misfit = 0.0; ///< sum of min(z^2, 4.685^2), z in multiples of sigma: what starts are compared by
};

/// Points in `used` alone count. `robust`: each with Tukey's biweight at c = 4.685 times the residuals' robust scale (Beaton and Tukey
/// 1974; 95 % efficient for normal errors), the scale 1.4826 times the median absolute residual, at least 1. Weights and sigma are those of
/// the point of departure of each step. Ends when the minimum lies within 1e-5 of its standard error, or nothing further down is found.
Descent descend(const FitModel& model, const FreeGroups& free, Shifts start, const std::vector<bool>& used, bool robust,
                const FitBounds& bounds = {});

/// Residuals (calculated less read) in multiples of sigma.
std::vector<double> normalised_residuals(const std::vector<LuxPoint>& points, const Descent& at);
/// The robust scale of those in use, at least 1.
double residual_scale(const std::vector<double>& residuals, const std::vector<bool>& used);
/// By the unknowns that are free, in multiples of sigma; rows of points not in use are 0.
Matrix weighted_jacobian(const FitModel& model, const FreeGroups& free, const Descent& at, const std::vector<bool>& used);

} // namespace fernlicht
