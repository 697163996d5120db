// Pitch, yaw, flux and height of each lamp from readings of a luxmeter, with their covariance; what the readings cannot tell, held and
// named; readings that do not belong.
#pragma once

#include "metrics/fit/fit_model.h"

#include <string>

namespace fernlicht {

struct FitOptions {
    /// Quantities that keep the drive's value, by lamp's name ("": of all).
    std::vector<std::pair<std::string, FitQuantity>> hold;
    /// That one good reading of all is called an outlier: the threshold is the two-sided normal quantile at this over their number
    /// (Bonferroni), by the distribution of the largest of so many.
    double false_outlier = 0.01;
    /// That good readings with honest uncertainties are called inconsistent.
    double false_alarm = 0.001;
};

/// Units: degrees for pitch and yaw, a factor to the drive's flux, metres.
struct FittedValue {
    std::string lamp;
    FitQuantity quantity = FitQuantity::pitch;
    double change = 0.0;                  ///< against the drive; of flux the factor, 1: none
    std::optional<double> standard_error; ///< of `change`; nullopt: held
    std::string held;                     ///< why; "" where it is fitted
    std::string with; ///< "right": changes alike with that lamp's, since the readings cannot tell the two apart; "" alone
};

struct FittedPoint {
    double calculated_lx = 0.0, sigma_lx = 0.0; ///< sigma: of the reading, at the fit
    /// (read less calculated) / sigma; and that in multiples of its own deviation, which is smaller than sigma where the point itself
    /// decides the fit. nullopt where it decides it alone.
    double residual = 0.0;
    std::optional<double> studentised;
    bool outlier = false;
    std::size_t lamp = 0;            ///< that lights it most, as fitted
    double h_deg = 0.0, v_deg = 0.0; ///< as that lamp sees the point
};

struct LampFit {
    std::vector<FittedValue> values; ///< four for each lamp that shone on a point, in the order of FitQuantity
    Matrix covariance;               ///< of `values`, in degrees, relative flux and metres; 0 for what is held
    std::vector<FittedPoint> points;
    Shifts shifts;                                     ///< of all lamps, for shifted()
    std::size_t unknowns = 0;                          ///< fitted
    std::size_t used = 0;                              ///< points, without outliers
    double chi_squared = 0.0, chi_squared_limit = 0.0; ///< of those; what chance reaches with `false_alarm`. 0 without degrees of freedom
    double outlier_from = 0.0; ///< the threshold of |studentised|: the quantile times the residuals' robust scale, which is at least 1
    double error_scale = 1.0;  ///< by which standard errors and covariance are multiplied: above 1 where the residuals are inconsistent
                               ///< (Birge 1932: square root of chi squared over degrees of freedom)
    double condition = 0.0;    ///< condition index of what is fitted (scaled_svd.h)
    int iterations = 0;
    std::string failed; ///< why nothing was fitted, or the fit is not to be used; "" where it is

    int freedom() const { return static_cast<int>(used) - static_cast<int>(unknowns); }
    /// nullopt: nothing is left over to tell.
    std::optional<bool> consistent() const;
};

/// Of so many readings, at most these may be outliers of a fit that is consistent.
inline constexpr double most_outliers = 0.1;

/// Weighted least squares: starts by aim_search.h; Levenberg-Marquardt with Tukey's weights; readings beyond the threshold left out; least
/// squares of the rest, until the same ones are left out. What is collinear to harm, or known worse than to 1 degree of pitch, 2 of yaw,
/// 50 % of flux or 0.25 m, is held at the drive's value, height before yaw, pitch and flux; the same quantity of several lamps changes
/// alike. Standard errors take what is held for right. Throws std::invalid_argument as FitModel.
LampFit fit_lamps(const std::vector<CarAtReading>& cars, const std::vector<LuxPoint>& points, const FitOptions& options = {});

const char* name_of(FitQuantity quantity); ///< "pitch", "yaw", "flux", "height"

} // namespace fernlicht
