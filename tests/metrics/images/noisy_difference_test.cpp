#include "metrics/images/image_difference.h"

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
    Image<float> mixed{width, height};
    NoisyPicture picture() const { return {&mean, &variance, &mixed, 15}; }
};

NoisyDifference compared(const Noisy& a, const Noisy& b) { return compare_noisy(a.picture(), b.picture(), 1e-4, 1e-3, 1e-3); }

TEST(NoisyDifference, NoiseAloneAgrees) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const NoisyDifference difference = compared(Noisy(10.0, 0.05, seed), Noisy(10.0, 0.05, 1000 + seed));
        EXPECT_FALSE(difference.differs()) << seed << ": " << difference.worst_z << ", " << difference.sum_z;
        EXPECT_FALSE(difference.identical);
        EXPECT_EQ(difference.compared, static_cast<std::size_t>(width * height));
    }
}

// 1 % of light is 0.14 standard errors of a pixel's difference and 0.57 of a block's, seen in none; over 8000 pixels it is 12.7.
TEST(NoisyDifference, ALittleLightEverywhereIsSeenInTheSum) {
    const NoisyDifference difference = compared(Noisy(10.1, 0.05, 1), Noisy(10.0, 0.05, 2));
    EXPECT_TRUE(difference.differs());
    EXPECT_EQ(difference.blocks_over, 0U) << difference.worst_z;
    EXPECT_NEAR(difference.sum_z, std::sqrt(8000.0) * 0.01 / std::hypot(0.05 * 1.01, 0.05), 4.0) << "its own error is 1";
    EXPECT_NEAR(difference.sum_ratio, 1.01, 0.004);
    EXPECT_LT(compared(Noisy(10.0, 0.05, 2), Noisy(10.1, 0.05, 1)).sum_z, -8.0);
}

// 15 % less in 8 x 8 pixels: two standard errors of a pixel's difference, in each of four blocks sqrt(16) times that. The sum moves by
// 64 / 8000 of 15 %, 1.5 standard errors.
TEST(NoisyDifference, AZoneIsSeenByItsBlocks) {
    Noisy a(10.0, 0.05, 1);
    const Noisy b(10.0, 0.05, 2);
    for (int y = 40; y < 48; ++y)
        for (int x = 60; x < 68; ++x)
            a.mean.at(x, y) -= 1.5F;
    const NoisyDifference difference = compared(a, b);
    EXPECT_EQ(difference.blocks, 25U * 20U);
    EXPECT_EQ(difference.blocks_over, 4U);
    EXPECT_TRUE((difference.worst_x == 60 || difference.worst_x == 64) && (difference.worst_y == 40 || difference.worst_y == 44));
    EXPECT_NEAR(difference.worst_z, 4.0 * 0.15 / (0.05 * std::sqrt(2.0)), 3.0);
    EXPECT_LT(std::abs(difference.sum_z), difference.sum_bound);
}

// 16 pixels with 15 degrees of freedom each, two pictures: 480; where one pixel of one picture has all the variance: 15.
TEST(NoisyDifference, WhereOnePixelDecidesItsOwnFreedomDoes) {
    const Noisy a(10.0, 0.05, 1), b(10.0, 0.05, 2);
    const double even = compared(a, b).worst_bound;
    EXPECT_NEAR(even, 4.97, 0.02) << "Student's t, 480 degrees of freedom, two-sided at 0.0005 / 500";
    Noisy one(10.0, 0.0, 1), none(10.0, 0.0, 2);
    one.variance.at(50, 50) = 0.25F;
    const NoisyDifference alone = compare_noisy(one.picture(), none.picture(), 1e-4, 1e-3, 1e-3);
    EXPECT_EQ(alone.compared, 9U) << "those around it are as noisy, for all that is known";
    EXPECT_EQ(alone.blocks, 1U + (50 % 4 == 0 || 50 % 4 == 3 ? 3U : 0U));
    EXPECT_NEAR(alone.worst_bound, 4.417, 0.002) << "the tails of t beyond 4.4166 with 15 degrees of freedom hold 0.0005, by quadrature";
}

// An edge of light along a column: of its pixels some met light by a few samples only, all of one value, so that they know no variance, and
// are 0.3 apart. Those above and below met both sides.
TEST(NoisyDifference, AVarianceThatIsTooSmallIsRaisedByItsNeighbours) {
    Noisy a(10.0, 0.0, 1), b(10.0, 0.0, 2);
    for (int y = 0; y < height; ++y) {
        a.mean.at(50, y) = y % 2 == 0 ? 5.3F : 5.0F;
        b.mean.at(50, y) = 5.0F;
        a.variance.at(50, y) = y % 2 == 0 ? 0.0004F : 0.3F; // 15 of its errors, by itself
        b.variance.at(50, y) = y % 2 == 0 ? 0.0004F : 0.3F;
    }
    EXPECT_FALSE(compared(a, b).differs()) << compared(a, b).worst_z;
    for (int y = 0; y < height; ++y) // where all say so little, it is a difference
        a.variance.at(50, y) = b.variance.at(50, y) = 0.0004F;
    EXPECT_TRUE(compared(a, b).differs());
}

TEST(NoisyDifference, MixedPixelsAreLeftOutAndCounted) {
    Noisy a(10.0, 0.05, 1);
    const Noisy b(10.0, 0.05, 2);
    a.mean.at(63, 7) += 100.0F;
    EXPECT_TRUE(compared(a, b).differs());
    EXPECT_EQ(compared(a, b).worst_x, 60);
    EXPECT_EQ(compared(a, b).worst_y, 4);
    a.mixed.at(63, 7) = 1.0F;
    EXPECT_FALSE(compared(a, b).differs());
    EXPECT_EQ(compared(a, b).left_out, 1U);
    EXPECT_EQ(compared(b, a).left_out, 1U) << "in either picture";
    EXPECT_EQ(compared(a, b).compared, static_cast<std::size_t>(width * height) - 1);
    EXPECT_TRUE(compared(a, b).enough());
    a.mixed = Image<float>(width, height, 2.0F);
    EXPECT_FALSE(compared(a, b).enough());
    EXPECT_FALSE(compared(a, b).differs());
}

TEST(NoisyDifference, PixelsWithoutVarianceMayRoundOnly) {
    Noisy a(10.0, 0.0, 1), b(10.0, 0.0, 2);
    EXPECT_TRUE(compared(a, b).identical);
    a.mean.at(1, 2) = 10.009F;
    EXPECT_FALSE(compared(a, b).differs());
    a.mean.at(1, 2) = 10.011F;
    EXPECT_TRUE(compared(a, b).differs());
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
