// What `fernlicht fit` found. The writers only format it.
#pragma once

#include "metrics/fit/lamp_fit.h"
#include "runner/experiments/fit/lux_points.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

namespace fernlicht {

/// One value of a lamp: in the drive, and what the points make of it.
struct FitValue : FittedValue {
    double of_drive = 0.0; ///< degrees, flux factor or metres, as the drive's lamp set has it
    double fitted() const { return quantity == FitQuantity::flux ? of_drive * change : of_drive + change; }
};

/// A reading and what the fitted lamps give there.
struct FitPoint {
    LuxReading read;
    FittedPoint found;
    std::string lamp; ///< found.lamp by name
};

struct FitResult : Findings {
    std::string drive, title, lamp_set;
    std::filesystem::path points_file;
    std::vector<FitValue> values;                ///< as LampFit
    std::vector<std::vector<double>> covariance; ///< of `values`
    std::vector<FitPoint> points;
    std::vector<std::string> not_lit; ///< lamps of the lamp set that shone on no point
    std::size_t unknowns = 0, used = 0;
    int freedom = 0, iterations = 0;
    double chi_squared = 0.0, chi_squared_limit = 0.0, outlier_from = 0.0, error_scale = 1.0, condition = 0.0;
    std::optional<bool> consistent;      ///< nullopt: no more points than unknowns
    std::string failed;                  ///< as LampFit
    std::vector<std::string> notes;      ///< one sentence each
    Drive fitted_drive;                  ///< whose lamp set has the lamps as fitted; not in JSON
    std::optional<double> cut_off_v_deg; ///< level part of the cut-off of the first lamp's table, for plots; not in JSON
};

/// Fitted, and its residuals as large as the uncertainties say.
inline bool good(const FitResult& result) { return result.failed.empty() && result.consistent.value_or(false); }
/// "pitch of left"
std::string name_of(const FitValue& value);
/// What of the fit a reader must know first, one sentence each: what failed, is held, changes alike, is inconsistent.
std::vector<std::string> fit_verdicts(const FitResult& result);

/// docs/fit.md tells how to read it.
Document document(const FitResult& result);
JsonMembers fit_members(FitResult& result); ///< of fit.json
/// The readings with what was fitted to them, a line each.
std::string fit_csv(const FitResult& result);
/// Residuals over the height in the beam, and calculated over read.
plots::Figure residual_plot(const FitResult& result);
plots::Figure agreement_plot(const FitResult& result);

} // namespace fernlicht
