// By how much one beam lies beside another: a robust fit of shift and level on log intensity.
#pragma once

#include "metrics/beam/beam_field.h"

#include <optional>
#include <span>

namespace fernlicht {

/// One direction at which two beams are compared.
struct BeamSample {
    std::size_t v = 0, h = 0; ///< indices of the tested table
    double h_deg = 0.0, v_deg = 0.0;
    double log_cd = 0.0; ///< of the tested beam
    double sigma = 0.0;  ///< standard deviation of the difference of logs by noise and rounding, as it counts in a sum over many
    double noise = 0.0;  ///< of one sample of either file
};

struct ShiftFit {
    BeamShift shift;
    double log_level = 0.0;                           ///< log of tested over against, the shift undone
    double right_error_deg = 0.0, up_error_deg = 0.0; ///< standard errors
    double scale = 0.0;                               ///< of the residuals: 1.4826 times their median size, at least the noise
    bool found = false;                               ///< false: too few directions, or none that is steep
};

/// Least squares on log intensity by Gauss-Newton, each direction weighted by its noise and by Tukey's biweight (c = 4.685: 95 % efficient
/// for normal noise), so that a zone that differs pulls at nothing. A direction says as much about a shift as the beam is steep there.
/// The noise of the other file's samples is in the differences and in the slopes alike, and interpolation smooths it between them: what
/// that pulls towards the middle of its cells, and what it adds to the slopes, is taken off. Where the beams do not agree as they are, the
/// start is searched for within 2 degrees.
ShiftFit fit_shift(const BeamField& against, std::span<const BeamSample> samples, BeamTurn turn);

/// log tested - log against at the shifted place, and what interpolation leaves open there. nullopt where `against` has no data.
std::optional<FieldValue> residual(const BeamField& against, const BeamSample& sample, const BeamShift& shift);

} // namespace fernlicht
