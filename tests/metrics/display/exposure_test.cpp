#include "metrics/display/tone_fit.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(AdaptedLuminance, FollowsByItsTimeConstants) {
    AdaptedLuminance eye(0.5, 10.0);
    EXPECT_EQ(eye.cdm2(), 0.0);
    eye.see(1.0, 0.1);
    EXPECT_EQ(eye.cdm2(), 1.0); // the first picture
    eye.see(100.0, 0.5);        // one time constant: 1 - 1/e of two decades
    EXPECT_NEAR(std::log10(eye.cdm2()), 2.0 * (1.0 - std::exp(-1.0)), 1.0e-12);
    AdaptedLuminance other(0.5, 10.0);
    other.see(100.0, 0.1);
    other.see(1.0, 10.0);
    EXPECT_NEAR(std::log10(other.cdm2()), 2.0 * std::exp(-1.0), 1.0e-12);
}

TEST(AdaptedLuminance, StepsDoNotMatter) {
    AdaptedLuminance one(0.5, 10.0), many(0.5, 10.0);
    one.see(1.0, 1.0);
    many.see(1.0, 1.0);
    one.see(30.0, 0.7);
    for (int i = 0; i < 70; ++i)
        many.see(30.0, 0.01);
    EXPECT_NEAR(one.cdm2(), many.cdm2(), 1.0e-12 * one.cdm2());
}

TEST(AdaptedLuminance, DarknessWithoutAnyLightChangesNothing) {
    AdaptedLuminance eye(0.5, 10.0);
    eye.see(3.0, 1.0);
    eye.see(0.0, 1.0);
    eye.see(std::nan(""), 1.0);
    EXPECT_EQ(eye.cdm2(), 3.0);
}

} // namespace
} // namespace fernlicht
