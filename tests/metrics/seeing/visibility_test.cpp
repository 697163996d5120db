// The ruler for visibility: Adrian's equations worked out by hand, branch by branch.
#include "metrics/seeing/homogeneity.h"
#include "metrics/seeing/visibility.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// An onlooker whose factors of time and age are known: no time, and the age at which AF = 1.
const Onlooker plain{19.0 + std::sqrt(21.6), 2.0, 2.6};

double positive(double lb, double alpha, const Onlooker& onlooker = plain) {
    return threshold_difference_cdm2(lb, alpha, true, onlooker).number().value();
}
double negative(double lb, double alpha) { return threshold_difference_cdm2(lb, alpha, false, plain).number().value(); }

TEST(Adrian, ThresholdsByHand) {
    EXPECT_NEAR(positive(1.0, 10.0), 0.0499079, 5e-8); // cones
    EXPECT_NEAR(positive(1.0, 7.45), 0.0713158, 5e-8);
    EXPECT_NEAR(positive(0.1, 10.0), 0.0143087, 5e-8); // between
    // Rods, Lb = 0.001: lg sqrt(phi) = 0.028 - 0.519 = -0.491; lg sqrt(L) = -0.891 - 1.5825 + 0.2043 = -2.2692;
    // 2.6 (0.0322849 + 0.0053802)^2 = 0.0036885.
    EXPECT_NEAR(positive(0.001, 10.0), 0.0036885, 5e-8);
    // Lb = 1, alpha = 10: m = 10^-(10^-0.1495) = 0.195541, beta = 0.6, Fcp = 1 - 0.195541 * 10^-0.6 / (2.4 * 0.0499079) = 0.589930.
    // Lb = 0.1: m = 10^-(10^-0.0245) = 0.113462, beta = 0.6 * 0.1^-0.1488 = 0.845184, Fcp = 0.528094.
    // Lb = 0.02, the other f: m = 10^-(10^-(0.075 * 0.698970^2 + 0.0245)) ..., Fcp = 0.4209.
    EXPECT_NEAR(negative(1.0, 10.0) / positive(1.0, 10.0), 0.589930, 5e-7);
    EXPECT_NEAR(negative(0.1, 10.0) / positive(0.1, 10.0), 0.528094, 5e-7);
    EXPECT_NEAR(negative(0.02, 10.0) / positive(0.02, 10.0), 0.4209, 5e-5);
    // Lb = 1, alpha = 10: x = 1.523, y = 6; a(alpha) = 0.36 - 0.0972 * 2.319529 / 1.281720 = 0.184097, a(L) = 0.355 - 0.1217 * 36 / 25.88 =
    // 0.185711; a = 0.261498 / 2.1 = 0.124523; TF at 0.2 s: 1.622613.
    EXPECT_NEAR(positive(1.0, 10.0, {plain.age_years, 0.2, 2.6}) / positive(1.0, 10.0), 1.622613, 5e-7);
    EXPECT_DOUBLE_EQ(positive(1.0, 10.0, {plain.age_years, 60.0, 2.6}), positive(1.0, 10.0)) << "longer than 2 s does not count";
    EXPECT_NEAR(positive(1.0, 10.0, {60.0, 2.0, 2.6}) / positive(1.0, 10.0), 1681.0 / 2160.0 + 0.99, 1e-12);
    EXPECT_NEAR(positive(1.0, 10.0, {70.0, 2.0, 2.6}) / positive(1.0, 10.0), 13.4 * 13.4 / 116.3 + 1.43, 1e-12);
    const double threshold = positive(0.1, 10.0);
    EXPECT_NEAR(visibility_level(0.1 + 5.0 * threshold, 0.1, 10.0, plain).number().value(), 5.0, 1e-9);
    EXPECT_NEAR(visibility_level(0.1 - 3.0 * negative(0.1, 10.0), 0.1, 10.0, plain).number().value(), 3.0, 1e-9);
    EXPECT_EQ(visibility_level(0.1, 0.1, 10.0, plain).number().value(), 0.0);
    EXPECT_NEAR(arc_minutes_of(0.18, 83.0), 7.455, 5e-4); // 2 atan(0.09 / 83) = 0.124256 degrees
}

TEST(Adrian, BranchesMeetWithinWhatIsStated) {
    const auto jump = [](double at, double alpha) {
        return positive(std::nextafter(at, 10.0), alpha) / positive(std::nextafter(at, 0.0), alpha) - 1.0;
    };
    for (const double alpha : {1.0, 7.45, 10.0, 30.0, 60.0}) {
        EXPECT_GT(jump(0.6, alpha), -0.0201) << alpha;
        EXPECT_LT(jump(0.6, alpha), -0.0128) << alpha;
        EXPECT_GT(jump(0.00418, alpha), -0.0023) << alpha;
        EXPECT_LT(jump(0.00418, alpha), 0.0058) << alpha;
        EXPECT_NEAR(negative(std::nextafter(0.1, 1.0), alpha) / negative(std::nextafter(0.1, 0.0), alpha), 1.0, 1e-12) << alpha;
    }
    const auto aged = [](double age) { return positive(1.0, 10.0, {age, 2.0, 2.6}); };
    EXPECT_NEAR(aged(64.0) / aged(std::nextafter(64.0, 0.0)) - 1.0, -0.013826, 5e-7); // 1.900851 / 1.9275
}

TEST(Adrian, SaysWhereItEnds) {
    const auto why = [](double lb, double alpha, bool lighter, const Onlooker& onlooker) {
        const Value found = threshold_difference_cdm2(lb, alpha, lighter, onlooker);
        EXPECT_FALSE(found.measured());
        return found.reason();
    };
    EXPECT_THAT(why(0.0, 10.0, true, plain), HasSubstr("dark background"));
    EXPECT_THAT(why(1.0, 10.0, true, {22.9, 2.0, 2.6}), HasSubstr("23 to 75"));
    EXPECT_THAT(why(1.0, 10.0, true, {75.1, 2.0, 2.6}), HasSubstr("23 to 75"));
    EXPECT_THAT(why(1.0, 60.0, true, {25.0, 0.2, 2.6}), HasSubstr("exposure holds below 60"));
    EXPECT_TRUE(threshold_difference_cdm2(1.0, 60.0, true, plain).measured());
    EXPECT_THAT(why(0.004, 10.0, false, plain), HasSubstr("above 0.004"));
    EXPECT_TRUE(threshold_difference_cdm2(0.0041, 10.0, false, plain).measured());
    EXPECT_THROW(threshold_difference_cdm2(1.0, 0.0, true, plain), std::invalid_argument);
    EXPECT_THROW(threshold_difference_cdm2(std::nan(""), 10.0, true, plain), std::invalid_argument);
}

// CIE 191's iteration carried out by hand
TEST(Mesopic, IsTheWorkedValuesAndEndsAtRodsAndCones) {
    const Mesopic dim = mesopic_luminance(0.1, 1.5);
    EXPECT_NEAR(dim.luminance_cdm2, 0.116234, 5e-7);
    EXPECT_NEAR(dim.m, 0.455382, 5e-7);
    const Mesopic dusk = mesopic_luminance(1.0, 1.5);
    EXPECT_NEAR(dusk.luminance_cdm2, 1.052418, 5e-7);
    EXPECT_NEAR(dusk.m, 0.774398, 5e-7);
    const Mesopic day = mesopic_luminance(20.0, 1.7);
    EXPECT_EQ(day.m, 1.0);
    EXPECT_DOUBLE_EQ(day.luminance_cdm2, 20.0);
    const Mesopic dark = mesopic_luminance(0.001, 1.7);
    EXPECT_EQ(dark.m, 0.0);
    EXPECT_DOUBLE_EQ(dark.luminance_cdm2, 0.0017);
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
    const Mesopic found = mesopic_luminance(4.0, 20.0);
    EXPECT_TRUE(found.bisected);
    EXPECT_NEAR(residual(found), 0.0, 1e-12);
    EXPECT_GT(found.luminance_cdm2, 4.0);
    for (const auto& [photopic, sp] : {std::pair(0.0, 1.5), std::pair(-1.0, 1.5), std::pair(std::nan(""), 1.5), std::pair(1.0, 0.0)})
        EXPECT_THROW(mesopic_luminance(photopic, sp), std::invalid_argument);
}

// Evenness of light against lights whose gradients and patches are known.

/// 1 to 80 m every 0.5 m, 3.5 m wide every 0.25 m; a driver's eye 1.2 m above the lamps' place.
template <class Lux> LaneLight lane(Lux lux) {
    LaneLight light;
    for (int k = 2; k <= 160; ++k)
        light.ahead_m.push_back(0.5 * k);
    for (int k = -7; k <= 7; ++k)
        light.offset_m.push_back(0.25 * k);
    for (const double ahead_m : light.ahead_m)
        for (const double offset_m : light.offset_m) {
            light.lx.push_back(lux(ahead_m, offset_m));
            light.seen_at.push_back({ahead_m, offset_m, -1.2});
        }
    return light;
}

double cube(double x) { return x * x * x; }

TEST(Homogeneity, GradientsOfKnownLightsAndNoPatchesInAPower) {
    // lg E falls by 0.02 a metre along and by 0.1 across.
    const Gradients even = largest_gradients(lane([](double x, double y) { return 100.0 * std::pow(10.0, -0.02 * x - 0.1 * y); }), 1e-9);
    EXPECT_NEAR(even.along.per_m, 0.02, 1e-12);
    EXPECT_NEAR(even.across.per_m, 0.1, 1e-12);
    // Seen from the driver a metre along is smallest at the far end: 0.5 m at 79.5 m, in front of the eye: atan(1.2/79.5) - atan(1.2/80).
    const double degrees_along = (std::atan(1.2 / 79.5) - std::atan(1.2 / 80.0)) * 180.0 / 3.14159265358979323846;
    EXPECT_NEAR(even.along.per_degree, 0.01 / degrees_along, 2e-3 * 0.01 / degrees_along) << "columns beside the eye differ by 0.1 %";
    const Gradients cubic = largest_gradients(lane([](double x, double) { return 1e6 / cube(x); }), 1e-9);
    EXPECT_NEAR(cubic.along.per_m, 3.0 * std::log10(1.5) / 0.5, 1e-9) << "between 1 and 1.5 m";
    EXPECT_EQ(cubic.across.per_m, 0.0);
    EXPECT_EQ(largest_gradients(lane([](double, double) { return 0.5; }), 1.0).along.per_m, 0.0) << "too dark to count";
    for (const double power : {1.0, 2.0, 3.0, 4.0}) {
        const Unevenness found =
            patches(lane([&](double x, double y) { return 1e6 * std::pow(x, -power) * std::pow(1.5, y); }), 1e-9, 1.01);
        EXPECT_EQ(found.dark.count, 0) << power;
        EXPECT_EQ(found.bright.count, 0) << power;
    }
}

TEST(Homogeneity, FindsPlantedPatches) {
    const auto strip = [](double from_m, double to_m, double times) {
        return lane([=](double x, double y) { return 1e6 / cube(x) * (x > from_m && x < to_m && y > 0.6 ? times : 1.0); });
    };
    const Unevenness dark = patches(strip(29.9, 34.1, 0.4), 1e-9, 1.5); // rows 30 to 34 m: nine of 0.5 m
    EXPECT_EQ(dark.dark.count, 1);
    EXPECT_NEAR(dark.dark.longest_m, 4.5, 1e-9);
    EXPECT_EQ(dark.bright.count, 0);
    const Unevenness bright = patches(strip(29.9, 34.1, 2.5), 1e-9, 1.5);
    EXPECT_EQ(bright.bright.count, 1);
    EXPECT_NEAR(bright.bright.longest_m, 4.5, 1e-9);
    EXPECT_EQ(patches(strip(29.9, 34.1, 0.9), 1e-9, 1.5).dark.count, 0) << "weaker than the factor";
    EXPECT_EQ(patches(strip(29.9, 34.1, 0.4), 1e9, 1.5).dark.count, 0) << "all too dark to count";
}

TEST(Homogeneity, ForegroundAgainstDistance) {
    EXPECT_NEAR(foreground_ratio(lane([](double, double) { return 7.0; })).number().value(), 1.0, 1e-12);
    EXPECT_NEAR(foreground_ratio(lane([](double x, double) { return x < 20.0 ? 30.0 : 3.0; })).number().value(), 10.0, 1e-12);
    // 1/x from 5 to 15 m and from 40 to 60 m: (ln 3 / 10) / (ln 1.5 / 20); trapezia of half a metre lie h^2/12 (1/25 - 1/225) = 7e-4 above
    // ln 3.
    const double by_hand = std::log(3.0) / 10.0 / (std::log(1.5) / 20.0);
    EXPECT_NEAR(foreground_ratio(lane([](double x, double) { return 1.0 / x; })).number().value(), by_hand, 7e-4 * by_hand);
    EXPECT_FALSE(foreground_ratio(lane([](double x, double) { return x < 20.0 ? 30.0 : 0.0; })).measured());
    EXPECT_FALSE(foreground_ratio({}).measured());
    LaneLight light = lane([](double, double) { return 1.0; });
    light.lx.pop_back();
    EXPECT_THROW(largest_gradients(light, 1.0), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
