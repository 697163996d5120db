// Roots and powers of floats in a form that compilers turn into SIMD. Errors were found by trying all floats of the stated ranges
// (tests/metrics/images/flip_test.cpp tries a part).
#pragma once

#include <bit>
#include <cstdint>

namespace fernlicht {

/// Cube root for 1e-30 <= x <= 1e30, relative error below 3e-7. Two steps of Halley's method from a guess by the exponent.
inline float quick_cube_root(float x) {
    const auto bits = static_cast<float>(std::bit_cast<std::int32_t>(x));
    float y = std::bit_cast<float>(static_cast<std::int32_t>(bits * (1.0F / 3.0F)) + 709921077);
    for (int step = 0; step < 2; ++step) {
        const float cube = y * y * y;
        y = y * ((cube + 2.0F * x) / (2.0F * cube + x));
    }
    return y;
}

/// log2 for 1e-37 <= x <= 1e37, absolute error below 3e-7 + 6e-8 |log2 x|. atanh's series over a mantissa from sqrt(1/2) to sqrt(2).
inline float quick_log2(float x) {
    const std::int32_t bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;
    const float m = std::bit_cast<float>(bits - (exponent << 23));
    const float s = (m - 1.0F) / (m + 1.0F), z = s * s;
    const float series = (((0.32059889F * z + 0.41219858F) * z + 0.57707802F) * z + 0.96179669F) * z + 2.8853901F; // 2 / (k ln 2)
    return static_cast<float>(exponent) + s * series;
}

/// 2^x for -126 <= x <= 126, relative error below 3e-7. Taylor's series of exp over half an octave to each side.
inline float quick_exp2(float x) {
    const float rounded = static_cast<float>(static_cast<std::int32_t>(x + (x < 0.0F ? -0.5F : 0.5F)));
    const float t = (x - rounded) * 0.69314718F;
    const float p =
        ((((((t * (1.0F / 5040.0F) + 1.0F / 720.0F) * t + 1.0F / 120.0F) * t + 1.0F / 24.0F) * t + 1.0F / 6.0F) * t + 0.5F) * t + 1.0F) *
            t +
        1.0F;
    return p * std::bit_cast<float>((static_cast<std::int32_t>(rounded) + 127) << 23);
}

} // namespace fernlicht
