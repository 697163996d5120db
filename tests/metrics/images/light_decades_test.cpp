#include "metrics/images/image_difference.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(LightDecades, PeakIsFourAndTheDarkIsZero) {
    Image<float> light(6, 1);
    light.pixels() = {100.0F, 10.0F, 0.01F, 0.001F, 0.0F, -1.0F};
    const auto decades = decades_of(light, 100.0);
    EXPECT_NEAR(static_cast<double>(decades.at(0, 0)), 4.0, 1e-6);
    EXPECT_NEAR(static_cast<double>(decades.at(1, 0)), 3.0, 1e-6);
    for (int x = 2; x < 6; ++x)
        EXPECT_NEAR(static_cast<double>(decades.at(x, 0)), 0.0, 1e-6);
    EXPECT_EQ(peak_of(light), 100.0);
    EXPECT_EQ(peak_of(Image<float>()), 0.0);
    EXPECT_THROW(decades_of(light, 0.0), std::invalid_argument);
}

// Ten times the light is one decade more everywhere: structure is the same, at any level.
TEST(LightDecades, RatiosBecomeDifferences) {
    Image<float> light(3, 1), more(3, 1);
    light.pixels() = {0.5F, 2.0F, 7.0F};
    more.pixels() = {5.0F, 20.0F, 70.0F};
    for (int x = 0; x < 3; ++x)
        EXPECT_NEAR(static_cast<double>(decades_of(more, 1e3).at(x, 0) - decades_of(light, 1e3).at(x, 0)), 1.0, 1e-5);
}

} // namespace
} // namespace fernlicht
