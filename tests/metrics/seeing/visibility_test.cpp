// The ruler for visibility: Adrian's equations worked out by hand, branch by branch.
#include "metrics/seeing/visibility.h"

#include <gmock/gmock.h>

#include <cmath>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// An onlooker whose factors of time and age are known: no time, and the age at which AF = 1.
const Onlooker plain{19.0 + std::sqrt(21.6), 2.0, 2.6};

double positive(double lb, double alpha, const Onlooker& onlooker = plain) {
    return threshold_difference_cdm2(lb, alpha, true, onlooker).number().value();
}
double negative(double lb, double alpha) { return threshold_difference_cdm2(lb, alpha, false, plain).number().value(); }

TEST(Adrian, ThresholdsOfThreeBranches) {
    EXPECT_NEAR(positive(1.0, 10.0), 0.0499079, 5e-8); // cones
    EXPECT_NEAR(positive(1.0, 7.45), 0.0713158, 5e-8);
    EXPECT_NEAR(positive(0.1, 10.0), 0.0143087, 5e-8); // between
    // Rods, Lb = 0.001: lg sqrt(phi) = 0.028 - 0.519 = -0.491; lg sqrt(L) = -0.891 - 1.5825 + 0.2043 = -2.2692;
    // 2.6 (0.0322849 + 0.0053802)^2 = 0.0036885.
    EXPECT_NEAR(positive(0.001, 10.0), 0.0036885, 5e-8);
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

// Lb = 1, alpha = 10: m = 10^-(10^-0.1495) = 0.195541, beta = 0.6, Fcp = 1 - 0.195541 * 10^-0.6 / (2.4 * 0.0499079) = 0.589930.
// Lb = 0.1: m = 10^-(10^-0.0245) = 0.113462, beta = 0.6 * 0.1^-0.1488 = 0.845184, Fcp = 0.528094.
// Lb = 0.02, the other f: m = 10^-(10^-(0.075 * 0.698970^2 + 0.0245)) ..., Fcp = 0.4209.
TEST(Adrian, NegativeContrast) {
    EXPECT_NEAR(negative(1.0, 10.0) / positive(1.0, 10.0), 0.589930, 5e-7);
    EXPECT_NEAR(negative(0.1, 10.0) / positive(0.1, 10.0), 0.528094, 5e-7);
    EXPECT_NEAR(negative(0.02, 10.0) / positive(0.02, 10.0), 0.4209, 5e-5);
}

// Lb = 1, alpha = 10: x = 1.523, y = 6; a(alpha) = 0.36 - 0.0972 * 2.319529 / 1.281720 = 0.184097, a(L) = 0.355 - 0.1217 * 36 / 25.88 =
// 0.185711; a = 0.261498 / 2.1 = 0.124523; TF at 0.2 s: 1.622613.
TEST(Adrian, ExposureAndAge) {
    EXPECT_NEAR(positive(1.0, 10.0, {plain.age_years, 0.2, 2.6}) / positive(1.0, 10.0), 1.622613, 5e-7);
    EXPECT_DOUBLE_EQ(positive(1.0, 10.0, {plain.age_years, 60.0, 2.6}), positive(1.0, 10.0)) << "longer than 2 s does not count";
    EXPECT_NEAR(positive(1.0, 10.0, {60.0, 2.0, 2.6}) / positive(1.0, 10.0), 1681.0 / 2160.0 + 0.99, 1e-12);
    EXPECT_NEAR(positive(1.0, 10.0, {70.0, 2.0, 2.6}) / positive(1.0, 10.0), 13.4 * 13.4 / 116.3 + 1.43, 1e-12);
}

TEST(Adrian, LevelIsTheContrastInThresholds) {
    const double threshold = positive(0.1, 10.0);
    EXPECT_NEAR(visibility_level(0.1 + 5.0 * threshold, 0.1, 10.0, plain).number().value(), 5.0, 1e-9);
    EXPECT_NEAR(visibility_level(0.1 - 3.0 * negative(0.1, 10.0), 0.1, 10.0, plain).number().value(), 3.0, 1e-9);
    EXPECT_EQ(visibility_level(0.1, 0.1, 10.0, plain).number().value(), 0.0);
    EXPECT_NEAR(arc_minutes_of(0.18, 83.0), 7.455, 5e-4); // 2 atan(0.09 / 83) = 0.124256 degrees
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

} // namespace
} // namespace fernlicht
