// The nonlinear part of fitting spot lights: from given spots to nearby ones that leave less over.
#pragma once

#include "scenarios/lamps/spots/spot_fit.h"

#include <span>

namespace fernlicht {

/// The table less the spots, in cd, for each direction.
std::vector<double> residual_of(const SpotDirections& directions, std::span<const Spot> spots);

double left_over_cd2_sr(const SpotDirections& directions, std::span<const double> residual);

/// A spot with its best intensity, and what it gains: (sum w r s)^2 / sum w s^2.
struct Gain {
    Spot spot;
    double cd2_sr = 0.0;
};

/// Levenberg-Marquardt on axes, intensities and exponents together, within their bounds, cut-offs held. Never leaves more over than
/// before. At most `steps` steps.
void refine_together(const SpotDirections& directions, std::vector<Spot>& spots, int steps);

/// Axis, exponent, cut-off and intensity of one spot, the others held: a pattern search with steps from `step_deg` down to `finest_deg`
/// that takes the best of all cut-offs everywhere. Never leaves more over than before.
void refine_alone(const SpotDirections& directions, std::vector<Spot>& spots, std::size_t which, double step_deg, double finest_deg);

} // namespace fernlicht
