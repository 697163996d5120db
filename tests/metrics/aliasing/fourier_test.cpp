#include "metrics/aliasing/contrast_sensitivity.h"
#include "metrics/aliasing/fourier.h"

#include <cmath>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <random>

namespace fernlicht {
namespace {

TEST(FourierTransform, IsThatOfOpenCV) {
    constexpr std::size_t side = 32;
    std::mt19937 generator(3);
    std::vector<std::complex<double>> block(side * side);
    cv::Mat_<cv::Vec2d> theirs(static_cast<int>(side), static_cast<int>(side));
    for (std::size_t i = 0; i < block.size(); ++i) {
        block[i] = {static_cast<double>(generator() % 2001) - 1000.0, static_cast<double>(generator() % 2001) - 1000.0};
        theirs(static_cast<int>(i / side), static_cast<int>(i % side)) = {block[i].real(), block[i].imag()};
    }
    cv::dft(theirs, theirs);
    fourier_transform(block, side);
    double largest = 0.0;
    for (std::size_t i = 0; i < block.size(); ++i) {
        const cv::Vec2d& expected = theirs(static_cast<int>(i / side), static_cast<int>(i % side));
        largest = std::max(largest, std::abs(block[i] - std::complex<double>(expected[0], expected[1])));
    }
    // Ten stages of rounding at values of up to 1000 * 1024 whose squares add to about 2.6e4^2.
    EXPECT_LT(largest, 1e-9);
    std::vector<std::complex<double>> three(3);
    EXPECT_THROW(fourier_transform(std::span(three)), std::invalid_argument);
    EXPECT_THROW(fourier_transform(three, 2), std::invalid_argument);
}

TEST(FourierTransform, NamesItsFrequencies) {
    EXPECT_EQ(bin_frequency(0, 32), 0.0);
    EXPECT_EQ(bin_frequency(15, 32), 15.0 / 32.0);
    EXPECT_EQ(bin_frequency(16, 32), -0.5);
    EXPECT_EQ(bin_frequency(31, 32), -1.0 / 32.0);
}

TEST(ContrastSensitivity, IsThatOfBartenAndOfKelly) {
    // The printed formulas, worked out apart from this program.
    EXPECT_NEAR(still_contrast_sensitivity(5.0, 100.0), 586.313020008566, 1e-9);
    EXPECT_NEAR(still_contrast_sensitivity(4.0, 0.01), 25.779198181579336, 1e-10);
    EXPECT_NEAR(still_contrast_sensitivity(4.75, 1.0), 148.1418777623553, 1e-9);
    // What every such measurement shows: a peak between 1 and 6 cycles per degree, less in the dark, next to nothing at 60.
    EXPECT_GT(still_contrast_sensitivity(4.0, 100.0), still_contrast_sensitivity(0.5, 100.0));
    EXPECT_GT(still_contrast_sensitivity(4.0, 100.0), still_contrast_sensitivity(10.0, 100.0));
    EXPECT_LT(still_contrast_sensitivity(4.0, 0.01), 0.1 * still_contrast_sensitivity(4.0, 100.0));
    EXPECT_LT(still_contrast_sensitivity(60.0, 100.0), 1.0);
    EXPECT_EQ(still_contrast_sensitivity(0.0, 100.0), 0.0);
    // Kelly at 3 degrees per second: the logarithm is 0, so 6.1 * 3 a^2 exp(-10 a / 45.9); a = 2 pi.
    EXPECT_NEAR(flicker_sensitivity(1.0, 3.0), 6.1 * 3.0 * 39.478417604 * std::exp(-62.83185307 / 45.9), 1e-6);
    EXPECT_LT(flicker_sensitivity(1.0, 60.0), 0.01 * flicker_sensitivity(1.0, 6.0));
    EXPECT_EQ(flicker_sensitivity(1.0, 0.0), 0.0);
    EXPECT_THROW(still_contrast_sensitivity(1.0, 0.0), std::invalid_argument);
    EXPECT_THROW(flicker_sensitivity(0.0, 1.0), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
