// The light equations of photometry.glsl as C++ over packs of floats: the third compile of the text, many lanes wide. As in GLSL, a lane's
// float differs from the twin's double by what stands beside each equation; where it differs from other floats is in exp, log, pow and atan
// below. For sources that are compiled once for each level (pack.h).
#pragma once

#include "scenarios/packs/pack.h"

namespace fernlicht::packs::FERNLICHT_LEVEL::photometry {

using real = Floats;

struct vec2 {
    real x, y;

    vec2() = default;
    vec2(real in_x, real in_y) : x(in_x), y(in_y) {}
};

struct vec3 {
    real x, y, z;

    vec3() = default;
    vec3(real in_x, real in_y, real in_z) : x(in_x), y(in_y), z(in_z) {}
};
inline vec3 operator+(const vec3& a, const vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline vec3 operator-(const vec3& a, const vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline vec3 operator-(real a, const vec3& b) { return {a - b.x, a - b.y, a - b.z}; }
inline vec3 operator*(const vec3& a, const vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline vec3 operator*(const vec3& a, real b) { return {a.x * b, a.y * b, a.z * b}; }
inline vec3 operator/(const vec3& a, real b) { return {a.x / b, a.y / b, a.z / b}; }

struct vec4 {
    real x, y, z, w;

    vec4() = default;
    vec4(real in_x, real in_y, real in_z, real in_w) : x(in_x), y(in_y), z(in_z), w(in_w) {}
};

inline real dot(const vec3& a, const vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline vec3 cross(const vec3& a, const vec3& b) { return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y}; }
inline real length(const vec2& a) { return sqrt(a.x * a.x + a.y * a.y); }
inline real length(const vec3& a) { return sqrt(dot(a, a)); }

/// 2^n for -126 <= n <= 127.
inline real power_of_two(Ints n) { return floats_of_bits((n + Ints(127)) << 23); }

/// Within 1.2e-7 relative, and half a unit in the last place below 1.2e-38: e^x = 2^n e^r with |r| <= ln(2) / 2, where ln(2) in two parts
/// leaves r exact; the polynomial is Cephes's (Moshier 1989).
inline real exp(real x) {
    x = clamp(x, -105.0, 89.0);    // 0 and infinity lie beyond
    const real round = 12582912.0; // 1.5 * 2^23: the sum has no bits below 1
    const real n = (x * 1.44269504088896341 + round) - round;
    const real r = (x - n * 0.693359375) + n * 2.12194440e-4;
    const real p = ((((1.9875691500e-4 * r + 1.3981999507e-3) * r + 8.3334519073e-3) * r + 4.1665795894e-2) * r + 1.6666665459e-1) * r +
                   5.0000001201e-1;
    const Ints whole = to_ints(n), half = whole >> 1;
    return ((p * (r * r) + r) + 1.0) * power_of_two(half) * power_of_two(whole - half);
}

/// Within 1e-7 relative, near 1 too, for normal x > 0: ln(m 2^n) = ln(m) + n ln(2) with m from sqrt(1/2) to sqrt(2); the polynomial is
/// Cephes's.
inline real log(real x) {
    const Ints n = (bits_of(x) - Ints(0x3f3504f3)) >> 23;
    const real f = floats_of_bits(bits_of(x) - (n << 23)) - 1.0, e = to_floats(n), z = f * f;
    const real p = ((((((((7.0376836292e-2 * f - 1.1514610310e-1) * f + 1.1676998740e-1) * f - 1.2420140846e-1) * f + 1.4249322787e-1) * f -
                       1.6668057665e-1) *
                          f +
                      2.0000714765e-1) *
                         f -
                     2.4999993993e-1) *
                        f +
                    3.3333331174e-1) *
                   f * z;
    return (f + ((p - e * 2.12194440e-4) - 0.5 * z)) + e * 0.693359375;
}

/// x > 0. Off by 1e-7 relative for each unit of |y ln(x)|, and 1.2e-7.
inline real pow(real x, real y) { return exp(y * log(x)); }

real quick_atan(real y, real x);
/// The text's own, within 1e-7 rad and the rounding of floats.
inline real atan(real y, real x) { return quick_atan(y, x); }

#define FN inline
#define OUT(type) type&
#define PRECISE
#define SELECT(condition, a, b) select(condition, a, b)
#include "scenarios/photometry.glsl"
#undef FN
#undef OUT
#undef PRECISE
#undef SELECT

} // namespace fernlicht::packs::FERNLICHT_LEVEL::photometry
