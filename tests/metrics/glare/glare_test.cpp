// The ruler for glare: values worked out by hand from the equations, each beside its working.
#include "metrics/glare/glare.h"

#include <gmock/gmock.h>

#include <cmath>

namespace fernlicht {
namespace {

using testing::HasSubstr;

double veil(VeilingEquation equation, double theta_deg, GlareEye eye = {}) {
    return veiling_luminance_cdm2(equation, {{1.0, theta_deg}}, eye).number().value();
}

TEST(VeilingLuminance, StilesHolladayByHand) {
    EXPECT_DOUBLE_EQ(veil(VeilingEquation::stiles_holladay, 2.0), 2.5); // 10 / 2^2
    EXPECT_DOUBLE_EQ(veil(VeilingEquation::stiles_holladay, 10.0), 0.1);
}

TEST(VeilingLuminance, AgeAdjustedByHand) { // 1 + (25/70)^4 = 1.016269
    EXPECT_NEAR(veil(VeilingEquation::age_adjusted, 1.0), 10.1627, 5e-5);
    EXPECT_NEAR(veil(VeilingEquation::age_adjusted, 3.0), 1.12919, 5e-6);
    EXPECT_NEAR(veil(VeilingEquation::age_adjusted, 10.0), 0.101627, 5e-7);
    EXPECT_DOUBLE_EQ(veil(VeilingEquation::age_adjusted, 10.0, {70.0, 0.5}), 0.2); // at 70 twice the classic value
}

TEST(VeilingLuminance, CieGeneralByHand) { // age 25, p = 0.5: 10/t^3 + (5/t^2 + 0.05/t) 1.0256 + 0.00125
    EXPECT_NEAR(veil(VeilingEquation::cie_general, 1.0), 15.1805, 5e-5);
    EXPECT_NEAR(veil(VeilingEquation::cie_general, 3.0), 0.958491, 5e-7); // 0.370370 + 0.572222 * 1.0256 + 0.00125
    EXPECT_NEAR(veil(VeilingEquation::cie_general, 10.0), 0.067658, 5e-7);
    // At 62.5 the age's factor is 2: 0.01 + 0.1 + 2 * 0.1 p / 10 + 0.0025 p.
    EXPECT_NEAR(veil(VeilingEquation::cie_general, 10.0, {62.5, 1.2}), 0.01 + 0.1 + 0.024 + 0.003, 1e-12);
}

TEST(VeilingLuminance, SourcesAddAndDarkOnesDoNotCount) {
    const GlareEye eye;
    const auto lv = [&](const std::vector<GlareSource>& sources) {
        return veiling_luminance_cdm2(VeilingEquation::age_adjusted, sources, eye).number().value();
    };
    EXPECT_DOUBLE_EQ(lv({{0.3, 2.0}, {0.7, 5.0}}), lv({{0.3, 2.0}}) + lv({{0.7, 5.0}}));
    EXPECT_DOUBLE_EQ(lv({{0.6, 2.0}}), 2.0 * lv({{0.3, 2.0}}));
    EXPECT_DOUBLE_EQ(lv({{0.3, 2.0}, {0.0, 0.0}}), lv({{0.3, 2.0}})) << "dark at an angle beyond the domain";
    EXPECT_EQ(lv({}), 0.0);
}

TEST(VeilingLuminance, EndsWithItsDomain) {
    struct Case {
        VeilingEquation equation;
        double inside, below, above;
    };
    for (const auto& [equation, inside, below, above] :
         {Case{VeilingEquation::stiles_holladay, 1.0, 0.99, 30.01}, Case{VeilingEquation::age_adjusted, 30.0, 0.99, 30.01},
          Case{VeilingEquation::cie_general, 0.1, 0.099, 100.01}, Case{VeilingEquation::cie_general, 100.0, 0.0, 180.0}}) {
        EXPECT_TRUE(veiling_luminance_cdm2(equation, {{1.0, inside}}, {}).measured());
        for (const double outside : {below, above}) {
            const Value lv = veiling_luminance_cdm2(equation, {{1.0, 5.0}, {1.0, outside}}, {});
            EXPECT_FALSE(lv.measured()) << name(equation) << ' ' << outside;
            EXPECT_THAT(lv.reason(), HasSubstr(std::string(name(equation)) + " holds from"));
        }
    }
}

TEST(VeilingLuminance, RefusesWhatIsNoLight) {
    for (const GlareSource source : {GlareSource{-1.0, 5.0}, GlareSource{std::nan(""), 5.0}, GlareSource{1.0, std::nan("")}})
        EXPECT_THROW(veiling_luminance_cdm2(VeilingEquation::cie_general, {source}, {}), std::invalid_argument);
}

TEST(ThresholdIncrement, BothBranchesByHand) {
    EXPECT_DOUBLE_EQ(threshold_increment_percent(0.2, 1.0).number().value(), 13.0);
    EXPECT_NEAR(threshold_increment_percent(0.1, 0.1).number().value(), 6.5 * std::pow(10.0, 0.8), 1e-9); // 0.1^-0.8 = 6.3096
    EXPECT_NEAR(threshold_increment_percent(1.0, 10.0).number().value(), 8.46688, 1e-5);                  // 95 / 10^1.05 = 95 / 11.22018
    EXPECT_NEAR(threshold_increment_percent(1.0, 5.0).number().value(), 17.93649, 1e-5);                  // 65 / 5^0.8 = 65 / 3.623898
    const double above = threshold_increment_percent(1.0, std::nextafter(5.0, 6.0)).number().value();
    EXPECT_NEAR(above, 17.53098, 1e-4) << "95 / 5^1.05 = 95 / 5.418975: the branches differ by 2.3 %";
}

TEST(ThresholdIncrement, KnowsNothingOfTheDark) {
    EXPECT_TRUE(threshold_increment_percent(0.2, 0.051).measured());
    for (const double lav : {0.05, 0.0}) {
        const Value ti = threshold_increment_percent(0.2, lav);
        EXPECT_FALSE(ti.measured());
        EXPECT_THAT(ti.reason(), HasSubstr("above 0.05"));
    }
}

// Lu = 1: 1 + sqrt(25) = 6. theta = 3.43 degrees = 205.8 arc minutes, ^0.46 = 11.593; 0.003 * 6 * 11.593 = 0.20867.
TEST(DeBoer, TakesDegreesAndMeansArcMinutes) {
    EXPECT_NEAR(de_boer_rating({{0.1, 3.43}}, 1.0).number().value(), 5.64, 0.005); // 5 - 2 lg 0.4792
    EXPECT_NEAR(de_boer_rating({{1.0, 3.43}}, 1.0).number().value(), 3.64, 0.005); // 5 - 2 lg 4.792
    EXPECT_GT(de_boer_rating({{1.0, 3.43}}, 1.0).number().value(), 3.0) << "2.00 is what 0.003 lx gives with theta in degrees";
}

TEST(DeBoer, TenTimesTheLightIsTwoSteps) {
    const double w = de_boer_rating({{0.05, 2.0}, {0.02, 3.0}}, 0.5).number().value();
    EXPECT_NEAR(de_boer_rating({{0.5, 2.0}, {0.2, 3.0}}, 0.5).number().value(), w - 2.0, 1e-12);
    EXPECT_NEAR(de_boer_rating({{0.1, 3.43}, {0.1, 3.43}}, 1.0).number().value(), 5.0 - 2.0 * std::log10(2.0 * 0.47923), 1e-4);
}

TEST(DeBoer, NeedsLightOffTheLineOfSight) {
    EXPECT_THAT(de_boer_rating({}, 1.0).reason(), HasSubstr("no light"));
    EXPECT_THAT(de_boer_rating({{0.0, 0.0}}, 1.0).reason(), HasSubstr("no light"));
    EXPECT_THAT(de_boer_rating({{1.0, 0.0}}, 1.0).reason(), HasSubstr("line of sight"));
}

} // namespace
} // namespace fernlicht
