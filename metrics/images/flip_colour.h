// FLIP's colours and its error of a pixel, for floats and SIMD (Andersson et al., "FLIP: A Difference Evaluator for Alternating Images",
// 2020). Colours here are tristimulus values over those of white (D65), so that grey is x = y = z. The paper's opponent space is Y = 116 y
// - 16, Cx = 500 (x - y), Cz = 200 (y - z); its filters are linear and sum to 1, so factors and offsets can stay out.
#pragma once

#include "metrics/images/quick_powers.h"

#include <array>
#include <cmath>

namespace fernlicht::flip {

/// Row by row.
using ColourMatrix = std::array<float, 9>;

constexpr float share(double part, double whole) { return static_cast<float>(part / whole); }

/// The matrix of BT.709's primaries and D65 as fractions, each row over its own sum.
inline constexpr ColourMatrix white_of_rgb{share(10135552, 23359437), share(8788810, 23359437), share(4435075, 23359437), //
                                           share(2613072, 12288897),  share(8788810, 12288897), share(887015, 12288897),  //
                                           share(1425312, 80288307),  share(8788810, 80288307), share(70074185, 80288307)};
/// Its inverse.
inline constexpr ColourMatrix rgb_of_white{3.0803419882804608F,   -1.5373989694887855F,  -0.54294301879167506F,
                                           -0.92117839616512365F, 1.8759299836951759F,   0.045248412469947583F,
                                           0.052881292875543252F, -0.20401120612390997F, 1.1511299132483668F};

/// L* 0..100, and a* and b* times 0.01 L*, since colours look the paler the darker they are (Hunt; section 4.1.2).
struct HuntLab {
    float l, a, b;
};

inline float unit(float v) { return v < 0.0F ? 0.0F : v > 1.0F ? 1.0F : v; }

/// CIE 15's f(t): cube root above (6/29)^3, a line below.
inline float lab_root(float t) {
    constexpr float end = 216.0F / 24389.0F;
    return t > end ? quick_cube_root(t > end ? t : 1.0F) : t * (841.0F / 108.0F) + 4.0F / 29.0F;
}

/// What is seen of a filtered colour, clamped to what a display can show.
inline HuntLab hunt_lab(float y, float x_less_y, float y_less_z) {
    const float x = y + x_less_y, z = y - y_less_z;
    const ColourMatrix &to = rgb_of_white, &from = white_of_rgb;
    const float r = unit(to[0] * x + to[1] * y + to[2] * z), g = unit(to[3] * x + to[4] * y + to[5] * z),
                b = unit(to[6] * x + to[7] * y + to[8] * z);
    const float fx = lab_root(from[0] * r + from[1] * g + from[2] * b), fy = lab_root(from[3] * r + from[4] * g + from[5] * b),
                fz = lab_root(from[6] * r + from[7] * g + from[8] * b);
    const float l = 116.0F * fy - 16.0F;
    return {l, 500.0F * (fx - fy) * 0.01F * l, 200.0F * (fy - fz) * 0.01F * l};
}

/// Section 4.1.3 and 4.1.4: distances to the power of 0.7; up to 0.4 of the largest they take 0.95 of the scale, evenly.
struct ErrorScale {
    float knee;         ///< 0.4 of the largest
    float below, above; ///< slopes
};
/// From the largest distance of two colours of a display, that of its green and its blue.
ErrorScale error_scale();

/// HyAB of two colours (section 4.1.3), about 0 to 203.
inline float distance_of(const HuntLab& a, const HuntLab& b) {
    const float da = a.a - b.a, db = a.b - b.b;
    return std::abs(a.l - b.l) + std::sqrt(da * da + db * db);
}

/// The error of colour, for a distance of at least 1e-30.
inline float colour_error(float distance, const ErrorScale& scale) {
    const float power = quick_exp2(0.7F * quick_log2(distance));
    return power < scale.knee ? scale.below * power : 0.95F + (power - scale.knee) * scale.above;
}

/// Section 4.3: the error of colour, raised where edges or points differ (`feature`, at most sqrt 2). colour above 1e-30.
inline float colour_and_features(float colour, float feature) {
    const float left = 1.0F - std::sqrt(unit(feature * 0.70710678F));
    return unit(quick_exp2(left * quick_log2(colour)));
}

} // namespace fernlicht::flip
