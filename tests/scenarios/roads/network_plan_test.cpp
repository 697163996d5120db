#include "scenarios/roads/plan.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// The reference line by brute force: heading integrated in closed form, position by Gauss-Legendre on very many pieces in long double.
PlanPoint clothoid_reference(double start_per_m, double end_per_m, double length_m, double ds_m) {
    using Real = long double;
    constexpr Real node = 0.57735026918962576450914878L;
    constexpr int pieces = 40'000;
    const Real change = (static_cast<Real>(end_per_m) - start_per_m) / length_m, h = static_cast<Real>(ds_m) / pieces;
    Real x = 0.0L, y = 0.0L;
    for (int i = 0; i < pieces; ++i)
        for (const Real side : {-node, node}) {
            const Real u = h * (static_cast<Real>(i) + 0.5L + 0.5L * side);
            const Real heading = u * (start_per_m + 0.5L * change * u);
            x += 0.5L * h * std::cos(heading);
            y += 0.5L * h * std::sin(heading);
        }
    return {static_cast<double>(x), static_cast<double>(y), ds_m * (start_per_m + 0.5 * static_cast<double>(change) * ds_m), 0.0, 1.0};
}

PlanElement element_of(double length_m, decltype(PlanElement::shape) shape) {
    PlanElement element;
    element.length_m = length_m;
    element.shape = std::move(shape);
    return element;
}

struct Clothoid {
    double start_per_m, end_per_m, length_m;
};

class NetworkClothoid : public testing::TestWithParam<Clothoid> {};

TEST_P(NetworkClothoid, AgreesWithIntegration) {
    const auto [start, end, length] = GetParam();
    PlanElement element = element_of(length, Spiral{start, end});
    const PlanElement bare = element;
    prepare(element);
    for (const double part : {0.1, 0.5, 0.77, 1.0}) {
        const PlanPoint expected = clothoid_reference(start, end, length, part * length);
        const PlanPoint cached = plan_point(element, part * length), computed = plan_point(bare, part * length);
        // The reference itself: order 4 with steps of length/40000; the worst turn here is 50 rad, so (50/40000)^4/4320 = 6e-16.
        EXPECT_NEAR(cached.x_m, expected.x_m, 1e-12 * length) << part;
        EXPECT_NEAR(cached.y_m, expected.y_m, 1e-12 * length) << part;
        EXPECT_NEAR(cached.heading_rad, expected.heading_rad, 1e-12 * (1.0 + std::abs(expected.heading_rad)));
        EXPECT_EQ(cached.x_m, computed.x_m);
        EXPECT_EQ(cached.y_m, computed.y_m);
    }
}

INSTANTIATE_TEST_SUITE_P(OfEveryCurvature, NetworkClothoid,
                         testing::Values(Clothoid{0.0, 0.0, 100.0},                 // straight
                                         Clothoid{0.0, 1e-12, 100.0},               // nearly straight
                                         Clothoid{1e-9, -1e-9, 5000.0},             //
                                         Clothoid{0.0, 1.0 / 150.0, 60.0},          // a country road's
                                         Clothoid{1.0 / 150.0, -1.0 / 250.0, 90.0}, // sign change
                                         Clothoid{0.01, 0.01, 300.0},               // an arc in disguise
                                         Clothoid{0.02, 0.020000001, 80.0},         //
                                         Clothoid{-0.2, 0.5, 12.0},                 // a corner
                                         Clothoid{0.0, 2.0, 25.0},                  // tightly wound: 25 rad
                                         Clothoid{5.0, -5.0, 10.0},                 // wound both ways
                                         Clothoid{1e-6, 1e-3, 1e4}));

TEST(NetworkPlan, ArcOfAnyCurvature) {
    for (const double curvature : {0.0, 1e-300, 1e-15, 1e-6, -1e-4, 0.001, 0.00999, 0.01001, -0.5, 3.0}) {
        const double length = 10.0;
        const PlanPoint point = plan_point(element_of(length, Arc{curvature}), length);
        const long double k = curvature, turn = k * length;
        const long double x = k == 0.0L ? length : std::sin(turn) / k;
        const long double half = std::sin(turn / 2.0L), y = k == 0.0L ? 0.0L : 2.0L * half * half / k;
        EXPECT_NEAR(point.x_m, static_cast<double>(x), 1e-13 * length) << curvature;
        EXPECT_NEAR(point.y_m, static_cast<double>(y), 1e-13 * length) << curvature;
        EXPECT_DOUBLE_EQ(point.heading_rad, curvature * length);
    }
}

TEST(NetworkPlan, ElementIsPlacedAndTurned) {
    PlanElement element = element_of(20.0, Line{});
    element.x_m = 680'000.0, element.y_m = 5'400'000.0, element.heading_rad = radians(90.0);
    const PlanPoint point = plan_point(element, 5.0);
    EXPECT_NEAR(point.x_m, 680'000.0, 1e-9);
    EXPECT_NEAR(point.y_m, 5'400'005.0, 1e-9);
}

/// Arc length of v = c u^2 from 0 to u in closed form.
double parabola_length(double c, double u) {
    const double w = 2.0 * c * u;
    return (w * std::sqrt(1.0 + w * w) + std::asinh(w)) / (4.0 * c);
}

TEST(NetworkPlan, Poly3FollowsItsArcLength) {
    for (const double c : {1e-4, 0.01, 1.0, -3.0}) {
        for (const double u : {0.5, 10.0, 40.0}) {
            const double s = parabola_length(std::abs(c), u);
            PlanElement element = element_of(s, Poly3{0.0, 0.0, c, 0.0});
            const PlanPoint bare = plan_point(element, s);
            prepare(element);
            const PlanPoint point = plan_point(element, s);
            EXPECT_NEAR(point.x_m, u, 1e-9 * u) << c;
            EXPECT_NEAR(point.y_m, c * u * u, 1e-9 * std::abs(c) * u * u) << c;
            EXPECT_NEAR(point.heading_rad, std::atan(2.0 * c * u), 1e-9);
            EXPECT_EQ(bare.x_m, point.x_m);
        }
    }
}

TEST(NetworkPlan, Poly3WithSharpBendStillHasUnitSpeed) {
    PlanElement element = element_of(100.0, Poly3{0.0, 0.1, -0.02, 0.0004});
    prepare(element);
    double worst = 0.0;
    for (double s = 0.0; s < 99.0; s += 0.1) {
        const PlanPoint a = plan_point(element, s), b = plan_point(element, s + 0.01);
        worst = std::max(worst, std::abs(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / 0.01 - 1.0));
    }
    EXPECT_LT(worst, 1e-4); // the chord of 1 cm is shorter than its arc by (k h)^2 / 24
}

TEST(NetworkPlan, ParamPoly3IsTheSameCurveInBothRanges) {
    const double length = 50.0;
    // u(p) = p, v(p) = 0.002 p^2 by metres; the same by p/length.
    const PlanElement metres = element_of(length, ParamPoly3{0, 1, 0, 0, 0, 0, 0.002, 0, false});
    const PlanElement unit = element_of(length, ParamPoly3{0, length, 0, 0, 0, 0, 0.002 * length * length, 0, true});
    for (double s = 0.0; s <= length; s += 2.5) {
        const PlanPoint a = plan_point(metres, s), b = plan_point(unit, s);
        EXPECT_NEAR(a.x_m, s, 1e-12);
        EXPECT_NEAR(a.y_m, 0.002 * s * s, 1e-12);
        EXPECT_NEAR(a.x_m, b.x_m, 1e-12);
        EXPECT_NEAR(a.y_m, b.y_m, 1e-12);
        EXPECT_NEAR(a.heading_rad, b.heading_rad, 1e-14);
        EXPECT_NEAR(a.heading_rate_per_m, b.heading_rate_per_m, 1e-14);
        EXPECT_NEAR(a.speed, b.speed, 1e-14);
    }
    EXPECT_NEAR(drawn_length_m(metres), parabola_length(0.002, length), 1e-10);
}

/// Heading is the direction of motion, heading_rate its derivative: by central differences, for every shape.
TEST(NetworkPlan, HeadingAndCurvatureAreDerivatives) {
    std::vector<PlanElement> elements{element_of(80.0, Line{}), element_of(80.0, Arc{-0.01}), element_of(80.0, Spiral{0.002, -0.03}),
                                      element_of(80.0, Poly3{0.0, 0.05, 0.001, -2e-5}),
                                      element_of(80.0, ParamPoly3{0, 78, 3, -1, 0, 0, 9, -5, true})};
    for (PlanElement& element : elements) {
        element.heading_rad = 2.0;
        prepare(element);
        for (double s = 1.0; s < 79.0; s += 3.7) {
            const double h = 1e-4;
            const PlanPoint a = plan_point(element, s - h), m = plan_point(element, s), b = plan_point(element, s + h);
            EXPECT_NEAR(std::remainder(std::atan2(b.y_m - a.y_m, b.x_m - a.x_m) - m.heading_rad, 2.0 * pi), 0.0, 1e-8);
            EXPECT_NEAR((b.heading_rad - a.heading_rad) / (2.0 * h), m.heading_rate_per_m, 1e-8);
            EXPECT_NEAR(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / (2.0 * h), m.speed, 1e-8);
        }
    }
}

} // namespace
} // namespace fernlicht
