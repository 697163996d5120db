// Extinction of fog, rain and snow against their sources' figures.
#include "scenarios/sky/weather.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(Weather, KoschmiederAtBothContrasts) {
    EXPECT_NEAR(extinction_of_range_per_m(100.0, 0.02), 0.03912, 1e-6);
    EXPECT_NEAR(extinction_of_range_per_m(100.0), 0.02996, 5e-6);
}

/// 1.076 R^0.67 dB/km: 1.988 dB/km at 2.5 mm/h, 4.188 at 7.6, 9.300 at 25; 4.343 dB are one neper.
TEST(Weather, RainAndSnowByClass) {
    EXPECT_NEAR(rain(Intensity::light).extinction_per_m, 1.988 / 4343.0, 1e-6);
    EXPECT_NEAR(rain(Intensity::moderate).extinction_per_m, 4.188 / 4343.0, 1e-6);
    EXPECT_NEAR(rain(Intensity::heavy).extinction_per_m, 9.300 / 4343.0, 1e-6);
    EXPECT_NEAR(snow(Intensity::light).extinction_per_m, 2.996 / 1500.0, 1e-6);
    EXPECT_GT(snow(Intensity::heavy).extinction_per_m, rain(Intensity::heavy).extinction_per_m);
    EXPECT_EQ(rain(Intensity::heavy).wetness, 1.0);
    EXPECT_EQ(snow(Intensity::heavy).wetness, 0.0);
}

TEST(Weather, MediaAdd) {
    const Weather fog{0.03, 1.0, 0.85, 0.0}, dark{0.01, 0.5, 0.0, 0.2};
    const Weather both = together(fog, dark);
    EXPECT_DOUBLE_EQ(both.extinction_per_m, 0.04);
    EXPECT_DOUBLE_EQ(both.scattering_albedo, 0.035 / 0.04);
    EXPECT_DOUBLE_EQ(both.asymmetry, 0.03 * 0.85 / 0.035);
    EXPECT_EQ(both.wetness, 0.2);
    EXPECT_EQ(together(fog, Weather{}), fog);
}

} // namespace
} // namespace fernlicht
