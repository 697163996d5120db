#include "metrics/images/quick_powers.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(QuickPowers, StayWithinWhatTheySay) {
    double worst = 0.0;
    for (double x = 1e-30; x < 1e30; x *= 1.00037)
        worst = std::max(worst, std::abs(static_cast<double>(quick_cube_root(static_cast<float>(x))) /
                                             std::cbrt(static_cast<double>(static_cast<float>(x))) -
                                         1.0));
    EXPECT_LT(worst, 3e-7);
    for (double x = 1e-37; x < 1e37; x *= 1.00037) {
        const double exact = std::log2(static_cast<double>(static_cast<float>(x)));
        ASSERT_NEAR(static_cast<double>(quick_log2(static_cast<float>(x))), exact, 3e-7 + 6e-8 * std::abs(exact)) << x;
    }
    EXPECT_EQ(quick_log2(1.0F), 0.0F);
    double other_worst = 0.0;
    for (double x = -126.0; x <= 126.0; x += 0.00137)
        other_worst = std::max(
            other_worst,
            std::abs(static_cast<double>(quick_exp2(static_cast<float>(x))) / std::exp2(static_cast<double>(static_cast<float>(x))) - 1.0));
    EXPECT_LT(other_worst, 3e-7);
    EXPECT_EQ(quick_exp2(0.0F), 1.0F);
}

} // namespace
} // namespace fernlicht
