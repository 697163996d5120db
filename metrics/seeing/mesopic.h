// Mesopic luminance, CIE 191:2010, system MES2: between 0.005 and 5 cd/m2 eyes see by cones and rods, and light with more blue in it (a
// larger ratio S/P of scotopic to photopic) counts for more than its photopic luminance says.
//
//   Lmes = (m Lp + (1 - m) Ls V') / (m + (1 - m) V'),  V' = 683 / 1699,  Ls = S/P Lp,  m = clamp(0.7670 + 0.3334 lg Lmes, 0, 1)
//
// a and b were read in another's program (1 - lg(5)/3 and 1/3), V' and the iteration from m = 0.5 are from memory.
#pragma once

namespace fernlicht {

struct Mesopic {
    double luminance_cdm2 = 0.0;
    double m = 0.0;        ///< 0: rods alone (Lmes = Ls), 1: cones alone (Lmes = Lp)
    int iterations = 0;    ///< of the fixed point from m = 0.5
    bool bisected = false; ///< the fixed point went round in circles, m is the one zero of its residual
};

/// Lp > 0 and finite, S/P in [0.01, 100], else std::invalid_argument. The published fixed point is followed until m changes by less than
/// 1e-10. With S/P above 1 larger m means less Lmes, so that the residual has one zero; where the steps there grow instead of shrinking
/// (S/P of 16 and more, Lp of 0.2 to 5), that zero is found by bisection. With S/P below 1 the steps go one way and always arrive; at S/P
/// of 0.1 and less more than one m can solve the equations (Lp of 0.03 to 0.4), and it is the one that the steps from 0.5 meet.
Mesopic mesopic_luminance(double photopic_cdm2, double sp_ratio);

} // namespace fernlicht
