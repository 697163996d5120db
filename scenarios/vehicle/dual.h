// Numbers that carry their partial derivatives (forward differentiation): exact Jacobians out of the equations' own text.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace fernlicht {

template <std::size_t N> struct Dual {
    double value = 0.0;
    std::array<double, N> slope{};

    Dual() = default;
    Dual(double v) : value(v) {} // NOLINT: constants stand beside variables in the equations
    static Dual variable(double v, std::size_t index) {
        Dual x(v);
        x.slope[index] = 1.0;
        return x;
    }

    /// f(x) with its derivative there.
    Dual chain(double f, double derivative) const {
        Dual out(f);
        for (std::size_t i = 0; i < N; ++i)
            out.slope[i] = derivative * slope[i];
        return out;
    }

    friend Dual operator-(const Dual& a) { return a.chain(-a.value, -1.0); }
    friend Dual operator+(const Dual& a, const Dual& b) { return joined(a.value + b.value, a, 1.0, b, 1.0); }
    friend Dual operator-(const Dual& a, const Dual& b) { return joined(a.value - b.value, a, 1.0, b, -1.0); }
    friend Dual operator*(const Dual& a, const Dual& b) { return joined(a.value * b.value, a, b.value, b, a.value); }
    friend Dual operator/(const Dual& a, const Dual& b) {
        return joined(a.value / b.value, a, 1.0 / b.value, b, -a.value / (b.value * b.value));
    }
    friend Dual operator+(const Dual& a, double b) { return a.chain(a.value + b, 1.0); }
    friend Dual operator+(double a, const Dual& b) { return b.chain(a + b.value, 1.0); }
    friend Dual operator-(const Dual& a, double b) { return a.chain(a.value - b, 1.0); }
    friend Dual operator-(double a, const Dual& b) { return b.chain(a - b.value, -1.0); }
    friend Dual operator*(const Dual& a, double b) { return a.chain(a.value * b, b); }
    friend Dual operator*(double a, const Dual& b) { return b.chain(a * b.value, a); }
    friend Dual operator/(const Dual& a, double b) { return a.chain(a.value / b, 1.0 / b); }

  private:
    static Dual joined(double value, const Dual& a, double by_a, const Dual& b, double by_b) {
        Dual out(value);
        for (std::size_t i = 0; i < N; ++i)
            out.slope[i] = by_a * a.slope[i] + by_b * b.slope[i];
        return out;
    }
};

inline double value_of(double x) { return x; }
template <std::size_t N> double value_of(const Dual<N>& x) { return x.value; }

/// f(x) for a function whose value and derivative are known at x.
inline double chained(double, double f, double) { return f; }
template <std::size_t N> Dual<N> chained(const Dual<N>& x, double f, double derivative) { return x.chain(f, derivative); }

template <class Real> Real sine(const Real& x) { return chained(x, std::sin(value_of(x)), std::cos(value_of(x))); }
template <class Real> Real cosine(const Real& x) { return chained(x, std::cos(value_of(x)), -std::sin(value_of(x))); }
template <class Real> Real magnitude(const Real& x) { return chained(x, std::abs(value_of(x)), value_of(x) < 0.0 ? -1.0 : 1.0); }
template <class Real> Real hyperbolic_tangent(const Real& x) {
    const double t = std::tanh(value_of(x));
    return chained(x, t, 1.0 - t * t);
}
template <class Real> Real square_root(const Real& x) {
    const double root = std::sqrt(value_of(x));
    return chained(x, root, 0.5 / root);
}
/// The greater and the lesser of x and a constant; where they are equal the derivative is the constant's.
template <class Real> Real at_least(const Real& x, double least) { return value_of(x) > least ? x : Real(least); }
template <class Real> Real at_most(const Real& x, double most) { return value_of(x) < most ? x : Real(most); }

} // namespace fernlicht
