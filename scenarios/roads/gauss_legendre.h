// Gauss's rule of five points: exact for polynomials up to degree 9.
#pragma once

#include <array>

namespace fernlicht {

/// Over 0 .. 1; the weights' sum is 1 (Abramowitz and Stegun, table 25.4).
inline constexpr std::array<double, 5> gauss_node{0.04691007703066800, 0.23076534494715846, 0.5, 0.76923465505284154, 0.95308992296933200};
inline constexpr std::array<double, 5> gauss_weight{0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                                    0.11846344252809454};

} // namespace fernlicht
