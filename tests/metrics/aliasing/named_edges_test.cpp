#include "metrics/aliasing/jaggedness.h"
#include "tests/metrics/aliasing/analytic_pictures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fernlicht {
namespace {

constexpr int side = 160;

/// A mark 12 pixels wide through the middle, its borders `degrees` from upright; ten times as bright as the road, under light that falls
/// off to the right by a third.
struct MarkedRoad {
    double nx, ny;
    explicit MarkedRoad(double degrees)
        : nx(std::cos(degrees * std::numbers::pi / 180.0)), ny(std::sin(degrees * std::numbers::pi / 180.0)) {}
    bool mark(double x, double y) const { return std::abs((x - 0.5 * side) * nx + (y - 0.5 * side) * ny) < 6.0; }
    double luminance(double x, double y) const { return (mark(x, y) ? 1.0 : 0.1) * (1.0 - x / (3.0 * side)); }
    EdgeReference reference() const {
        EdgeReference edges{k, drawn(side, side, k, [this](double x, double y) { return luminance(x, y); }), {}, {}, {}};
        edges.ground = Image<Ground>(side * k, side * k, Ground::road);
        for (int y = 0; y < side * k; ++y)
            for (int x = 0; x < side * k; ++x)
                if (mark((x + 0.5) / k, (y + 0.5) / k))
                    edges.ground.at(x, y) = Ground::mark;
        return edges;
    }
    /// The mean of n x n samples a pixel.
    Image<float> picture(int n) const {
        const Image<float> fine = drawn(side, side, n, [this](double x, double y) { return luminance(x, y); });
        Image<float> out(side, side);
        for (int y = 0; y < side * n; ++y)
            for (int x = 0; x < side * n; ++x)
                out.at(x / n, y / n) += fine.at(x, y) / static_cast<float>(n * n);
        return out;
    }
};

TEST(NamedEdges, StairsOfAMarkReadTheirClosedForm) {
    for (const double degrees : {5.0, 13.0, 22.0}) {
        const MarkedRoad road(degrees);
        const auto one = mark_jaggedness(road.picture(1), road.reference()), four = mark_jaggedness(road.picture(2), road.reference());
        ASSERT_TRUE(one && four);
        // Rounding to whole pixels, as for any step (jaggedness.h); 10 % for the light that falls off and for the middle between both
        // brightnesses, which is not where a pixel's step is.
        EXPECT_NEAR(one->found.rms_px / (road.nx / std::sqrt(12.0)), 1.0, 0.1) << degrees;
        EXPECT_LT(four->found.rms_px, 0.75 * one->found.rms_px);
        EXPECT_LT(one->floor_px, 0.08); // straight lines between pixels' centres are none across a pixel's area
        EXPECT_GT(one->found.standard_error_px, 0.0);
        EXPECT_LT(one->found.standard_error_px, 0.05);
    }
}

TEST(NamedEdges, TheEndsOfAMarkAndWhatIsNoRoadAreLeftOut) {
    const MarkedRoad road(13.0);
    EdgeReference whole = road.reference(), half = whole;
    const auto all = mark_jaggedness(road.picture(1), whole);
    for (int y = 0; y < side * k; ++y)
        for (int x = 0; x < side * k; ++x)
            if (y < side * k / 2)
                half.ground.at(x, y) = Ground::other;
    const auto rest = mark_jaggedness(road.picture(1), half);
    ASSERT_TRUE(all && rest);
    EXPECT_NEAR(static_cast<double>(rest->found.points), 0.5 * static_cast<double>(all->found.points), 8.0);
    EXPECT_FALSE(mark_jaggedness(Image<float>(side, side, 0.5F), {k, Image<float>(side * k, side * k, 0.5F), {}, {}, whole.ground}));
}

TEST(NamedEdges, TheCutOffIsALineOfLightOnTheRoadAndNoShadowOrSilhouette) {
    const auto beam = [](double x, double y) { return std::exp(0.1 * (y - 80.0) + 0.02 * (x - 80.0)); };
    EdgeReference reference{k, {}, drawn(side, side, k, beam), drawn(side, side, k, beam), Image<Ground>(side * k, side * k, Ground::road)};
    // A beam that is rounded up to whole texels of 5 pixels: each stair is a straight line's, level within the texel.
    const auto texels = [&](double x, double y) { return beam(5.0 * std::floor(x / 5.0) + 2.5, y); };
    const auto smooth = cut_off_jaggedness(drawn(side, side, 1, beam), reference, 1.0);
    const auto stairs = cut_off_jaggedness(drawn(side, side, 1, texels), reference, 1.0);
    ASSERT_TRUE(smooth && stairs);
    EXPECT_LT(smooth->found.rms_px, 0.02);
    EXPECT_LT(smooth->floor_px, 0.02);
    // The line is at y = 80 - 0.2 (x - 80) + const; a stair of 5 pixels strays by +-2, -+1, 0 pixels times 0.2, across it.
    EXPECT_NEAR(stairs->found.rms_px, 0.2 * std::sqrt(2.0) * std::cos(std::atan(0.2)), 0.02);
    EXPECT_EQ(smooth->found.points, 160U);
    for (int y = 0; y < side * k; ++y) // a shadow over the right half
        for (int x = side * k / 2; x < side * k; ++x)
            reference.illuminance_lx.at(x, y) *= 0.5F;
    const auto left = cut_off_jaggedness(drawn(side, side, 1, beam), reference, 1.0);
    ASSERT_TRUE(left);
    EXPECT_NEAR(static_cast<double>(left->found.points), 78.0, 2.0);
    EXPECT_FALSE(cut_off_jaggedness(drawn(side, side, 1, beam), reference, 1e6));
    EXPECT_THROW(cut_off_jaggedness(Image<float>(8, 8, 1.0F), reference, 1.0), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
