#include "metrics/noisy_difference.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr int width = 100, height = 80;

/// `truth` with noise of this relative standard error, and the variance that says so.
struct Noisy {
    Image<float> mean{width, height}, variance{width, height};
    Noisy(double truth, double relative_error, unsigned seed) {
        std::mt19937_64 random(seed);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            double sum = 0.0; // of twelve uniform numbers: variance 1; the library's own normal distribution is not the same everywhere
            for (int k = 0; k < 12; ++k)
                sum += static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
            mean.data()[i] = static_cast<float>(truth * (1.0 + relative_error * sum));
            variance.data()[i] = static_cast<float>(truth * truth * relative_error * relative_error);
        }
    }
    NoisyPicture picture() const { return {&mean, &variance, 15}; }
};

NoisyDifference compared(const Noisy& a, const Noisy& b) { return compare_noisy(a.picture(), b.picture(), 1e-4, 1e-3, 1e-3); }

TEST(NoisyDifference, NoiseAloneAgrees) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const NoisyDifference difference = compared(Noisy(10.0, 0.05, seed), Noisy(10.0, 0.05, 1000 + seed));
        EXPECT_TRUE(difference.agrees()) << seed << ": " << difference.worst_z << ", " << difference.sum_z;
        EXPECT_FALSE(difference.identical);
        EXPECT_EQ(difference.compared, static_cast<std::size_t>(width * height));
    }
}

// 2 % of light is 0.28 standard errors of a pixel's difference, seen in no single pixel; over 8000 of them it is 25.
TEST(NoisyDifference, ALittleLightEverywhereIsSeenInTheSum) {
    const NoisyDifference difference = compared(Noisy(10.2, 0.05, 1), Noisy(10.0, 0.05, 2));
    EXPECT_FALSE(difference.agrees());
    EXPECT_LT(difference.worst_z, difference.pixel_bound);
    EXPECT_NEAR(difference.sum_z, std::sqrt(8000.0) * 0.02 / std::hypot(0.05 * 1.02, 0.05), 4.0) << "its own error is 1";
    EXPECT_NEAR(difference.sum_ratio, 1.02, 0.004);
    EXPECT_LT(compared(Noisy(10.0, 0.05, 2), Noisy(10.2, 0.05, 1)).sum_z, -20.0);
}

// One pixel 20 standard errors off moves the sum by 20 / sqrt(8000).
TEST(NoisyDifference, OnePixelIsSeenByItself) {
    Noisy a(10.0, 0.05, 1);
    const Noisy b(10.0, 0.05, 2);
    a.mean.at(63, 7) += static_cast<float>(20.0 * 0.5 * std::sqrt(2.0));
    const NoisyDifference difference = compared(a, b);
    EXPECT_FALSE(difference.agrees());
    EXPECT_EQ(difference.worst_x, 63);
    EXPECT_EQ(difference.worst_y, 7);
    EXPECT_NEAR(difference.worst_z, 20.0, 5.0);
    EXPECT_LT(std::abs(difference.sum_z), difference.sum_bound);
}

TEST(NoisyDifference, PixelsWithoutVarianceMayRoundOnly) {
    Noisy a(10.0, 0.0, 1), b(10.0, 0.0, 2);
    EXPECT_TRUE(compared(a, b).identical);
    a.mean.at(1, 2) = 10.009F;
    EXPECT_TRUE(compared(a, b).agrees());
    a.mean.at(1, 2) = 10.011F;
    EXPECT_FALSE(compared(a, b).agrees());
    EXPECT_EQ(compared(a, b).exact_over, 1U);
}

TEST(NoisyDifference, RefusesWhatIsNoPair) {
    Noisy a(10.0, 0.05, 1), b(10.0, 0.05, 2);
    b.variance.at(0, 0) = -1.0F;
    EXPECT_THROW(compared(a, b), std::invalid_argument);
    b.variance.at(0, 0) = NAN;
    EXPECT_THROW(compared(a, b), std::invalid_argument);
    b.variance = Image<float>(3, 3);
    EXPECT_THROW(compared(a, b), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
