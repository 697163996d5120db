#include "metrics/seeing/mesopic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fernlicht {
namespace {

TEST(Mesopic, WorkedValues) { // CIE 191's iteration carried out by hand
    const Mesopic dim = mesopic_luminance(0.1, 1.5);
    EXPECT_NEAR(dim.luminance_cdm2, 0.116234, 5e-7);
    EXPECT_NEAR(dim.m, 0.455382, 5e-7);
    const Mesopic dusk = mesopic_luminance(1.0, 1.5);
    EXPECT_NEAR(dusk.luminance_cdm2, 1.052418, 5e-7);
    EXPECT_NEAR(dusk.m, 0.774398, 5e-7);
}

TEST(Mesopic, EndsAtRodsAndCones) {
    const Mesopic day = mesopic_luminance(20.0, 1.7);
    EXPECT_EQ(day.m, 1.0);
    EXPECT_DOUBLE_EQ(day.luminance_cdm2, 20.0);
    const Mesopic dark = mesopic_luminance(0.001, 1.7);
    EXPECT_EQ(dark.m, 0.0);
    EXPECT_DOUBLE_EQ(dark.luminance_cdm2, 0.0017);
}

TEST(Mesopic, LightAsYellowAsItsLuminanceSaysStaysAsItIs) {
    for (const double photopic : {0.003, 0.01, 0.3, 3.0, 30.0})
        EXPECT_NEAR(mesopic_luminance(photopic, 1.0).luminance_cdm2, photopic, 1e-12 * photopic);
}

/// What m must be at the luminance that m gives.
double residual(const Mesopic& found) { return std::clamp(0.7670 + 0.3334 * std::log10(found.luminance_cdm2), 0.0, 1.0) - found.m; }

TEST(Mesopic, SolvesItsEquationsForEveryRatio) {
    bool stepped = false, bisected = false;
    for (int decade = -30; decade <= 15; ++decade)
        for (const double sp : {0.01, 0.1, 0.5, 1.0, 1.4, 2.0, 5.0, 15.0, 20.0, 50.0, 100.0}) {
            const Mesopic found = mesopic_luminance(std::pow(10.0, 0.1 * decade), sp);
            EXPECT_NEAR(residual(found), 0.0, 1e-9) << "Lp 10^" << 0.1 * decade << ", S/P " << sp;
            (found.bisected ? bisected : stepped) = true;
            EXPECT_FALSE(found.bisected && sp <= 15.0) << "the published steps arrive for all that lamps have";
        }
    EXPECT_TRUE(stepped && bisected);
}

TEST(Mesopic, BisectsWhereTheStepsGoInCircles) {
    const Mesopic found = mesopic_luminance(4.0, 20.0);
    EXPECT_TRUE(found.bisected);
    EXPECT_NEAR(residual(found), 0.0, 1e-12);
    EXPECT_GT(found.luminance_cdm2, 4.0);
}

TEST(Mesopic, RefusesNothing) {
    for (const auto& [photopic, sp] : {std::pair(0.0, 1.5), std::pair(-1.0, 1.5), std::pair(std::nan(""), 1.5), std::pair(1.0, 0.0)})
        EXPECT_THROW(mesopic_luminance(photopic, sp), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
