#include "runner/experiments/stability/float_habits.h"

#include <cfenv>
#include <cmath>
#include <limits>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace fernlicht {
namespace {

/// A value that the compiler does not know.
template <class T> T unknown(T value) {
    volatile T hidden = value;
    return hidden;
}

template <class T> void try_type(const std::string& type, T big, std::vector<std::string>& broken) {
    const auto must = [&](bool holds, const char* rule) {
        if (!holds)
            broken.push_back(type + ": " + rule);
    };
    using Limits = std::numeric_limits<T>;
    const T zero = unknown(T(0)), one = unknown(T(1)), nan = unknown(Limits::quiet_NaN()), infinity = unknown(Limits::infinity());
    // With -ffinite-math-only these comparisons are folded away.
    must(nan != nan && !(nan == nan) && !(nan < one) && std::isnan(nan * zero), "NaN is no number");
    must(one / zero == infinity && std::isinf(infinity) && infinity > Limits::max(), "1 / 0 is infinite");
    // -fno-signed-zeros, -freciprocal-math
    must(std::signbit(-zero) && one / -zero == -infinity && !std::signbit(-zero + zero), "zeros have signs");
    const T three = unknown(T(3)), ten = unknown(T(10));
    must(three / ten != three * (one / ten) || sizeof(T) == 4, "a quotient is no product with the reciprocal");
    // -fassociative-math would give back 1.
    must((one + big) - big == zero && one + (big - big) == one, "sums are taken in the order written");
    // (1 + e)^2 = 1 + 2 e + e^2: rounded the product loses e^2, fused it keeps it.
    const T e = unknown(Limits::epsilon()), factor = one + e, product = factor * factor;
    must(unknown(factor) * unknown(factor) + unknown(-product) == zero && std::fma(factor, factor, -product) == e * e,
         "a product is rounded before it is added");
    const T smallest = unknown(Limits::min()), half = unknown(T(0.5));
    must(smallest * half > zero && (smallest * half) * (one + one) == smallest, "denormals are kept");
    must(unknown(Limits::denorm_min()) > zero, "the least denormal is not 0");
}

} // namespace

std::vector<std::string> broken_float_rules() {
    std::vector<std::string> broken;
    try_type<float>("float", 1e9F, broken);
    try_type<double>("double", 1e17, broken);
    if (std::fegetround() != FE_TONEAREST)
        broken.emplace_back("rounding is to nearest");
#if defined(__SSE2__)
    constexpr unsigned flush_to_zero = 1U << 15U, denormals_are_zero = 1U << 6U;
    if ((_mm_getcsr() & (flush_to_zero | denormals_are_zero)) != 0)
        broken.emplace_back("MXCSR: neither flush-to-zero nor denormals-are-zero is set");
#endif
    return broken;
}

} // namespace fernlicht
