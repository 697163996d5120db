// How small a contrast the eye sees: the reciprocal of the modulation (amplitude / mean) at threshold.
#pragma once

namespace fernlicht {

/// Still gratings over 10 x 10 degrees. Barten (2004), Formula for the contrast sensitivity of the human eye, Proc. SPIE 5294, 231-238:
/// S = 5200 exp(-0.0016 u^2 (1 + 100 / L)^0.08) / sqrt((1 + 144 / X^2 + 0.64 u^2) (63 / L^0.83 + 1 / (1 - exp(-0.02 u^2)))), X^2 = 100.
/// u > 0 in cycles per degree, L > 0 in cd/m2; 0 at u = 0. Throws std::invalid_argument for others.
double still_contrast_sensitivity(double cycles_per_degree, double luminance_cdm2);

/// Gratings whose contrast goes up and down. Kelly (1979), Motion and vision II, J. Opt. Soc. Am. 69, 1340-1349, with a = 2 pi u and
/// v = f / u: S = (6.1 + 7.3 |log10(v / 3)|^3) v a^2 exp(-2 a (v + 2) / 45.9). Measured by day: an eye adapted to a road at night sees less
/// of fast flicker. u > 0 in cycles per degree, f > 0 in Hz; 0 at f = 0. Throws std::invalid_argument for others.
double flicker_sensitivity(double cycles_per_degree, double hertz);

} // namespace fernlicht
