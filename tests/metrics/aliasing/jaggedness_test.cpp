#include "metrics/aliasing/jaggedness.h"
#include "tests/metrics/aliasing/analytic_pictures.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace fernlicht {
namespace {

/// A line through the middle of 128 x 128 pixels; `ramp_px` wide, 0: a step.
auto slanted(double degrees, double ramp_px, double shift_px = 0.0) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return [nx = std::cos(angle), ny = std::sin(angle), ramp_px, shift_px](double x, double y) {
        const double across = (x - 64.0) * nx + (y - 64.0) * ny - shift_px;
        return ramp_px > 0.0 ? std::clamp(0.5 + across / ramp_px, 0.0, 1.0) : across > 0.0 ? 1.0 : 0.0;
    };
}

TEST(Jaggedness, AStepRoundedToPixelsStraysByItsClosedForm) {
    for (const double degrees : {4.0, 11.0, 86.0, 101.0, 23.0, 37.0}) {
        const auto edge = slanted(degrees, 0.0);
        const auto found = measure_jaggedness(drawn(128, 128, 1, edge), drawn(128, 128, k, edge), k, 0.5);
        ASSERT_TRUE(found);
        // Rounding to whole pixels along the axis that the edge stands across is uniform over one pixel, and so is rounding to samples of
        // the reference over 1/8: sqrt((1 + 1/64) / 12) of them, less what a mean over some 33 points takes (3 % of the square).
        const double cosine =
            std::max(std::abs(std::cos(degrees * std::numbers::pi / 180.0)), std::abs(std::sin(degrees * std::numbers::pi / 180.0)));
        EXPECT_NEAR(found->rms_px / (cosine / std::sqrt(12.0)), 1.0, 0.05);
        EXPECT_NEAR(static_cast<double>(found->points), 128.0, 2.0);
    }
}

TEST(Jaggedness, AnEvenRampIsSmoothAndAMovedOneToo) {
    const Image<float> reference = drawn(128, 128, k, slanted(11.0, 8.0));
    for (const double shift_px : {0.0, 0.7}) { // where the whole line lies is no jaggedness
        const auto found = measure_jaggedness(drawn(128, 128, 1, slanted(11.0, 8.0, shift_px)), reference, k, 0.5);
        ASSERT_TRUE(found);
        // Between samples, a ramp is linear: what is left are half a sample's offset beside the pixel's middle, 1/16 px tan 11 degrees =
        // 0.012.
        EXPECT_LT(found->rms_px, 0.005);
    }
}

TEST(Jaggedness, NothingToMeasureIsSaid) {
    const Image<float> flat(64, 64, 1.0F), fine(512, 512, 1.0F);
    EXPECT_FALSE(measure_jaggedness(flat, fine, k, 0.5));
    // A line that the reference has not within two pixels has no partner.
    EXPECT_FALSE(measure_jaggedness(drawn(128, 128, 1, slanted(11.0, 0.0, 10.0)), drawn(128, 128, k, slanted(11.0, 0.0)), k, 0.5));
    EXPECT_THROW(measure_jaggedness(flat, flat, k, 0.5), std::invalid_argument);
    EXPECT_THROW(measure_jaggedness(flat, fine, k, std::nan("")), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
