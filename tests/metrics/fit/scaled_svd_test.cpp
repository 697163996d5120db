#include "metrics/fit/scaled_svd.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

Matrix matrix(std::size_t rows, std::size_t columns, std::vector<double> values) {
    Matrix m(rows, columns);
    m.values = std::move(values);
    return m;
}

// A straight line a + b t through t = 0, 1, 2, 3 in units that differ by a million: J^T J = [4 6; 6 14], its inverse [14 -6; -6 4] / 20.
TEST(ScaledSvd, IsTheStraightLineByHand) {
    constexpr double u = 1e6;
    const ScaledSvd svd(matrix(4, 2, {1, 0, 1, 1 * u, 1, 2 * u, 1, 3 * u}));
    const Matrix c = svd.covariance();
    EXPECT_NEAR(c.at(0, 0), 0.7, 1e-12);
    EXPECT_NEAR(c.at(0, 1), -0.3 / u, 1e-12 / u);
    EXPECT_NEAR(c.at(1, 1), 0.2 / (u * u), 1e-12 / (u * u));
    // Residuals are of 0 against 1, 2, 2, 4: a = 0.9, b = 0.9.
    const std::vector<double> r{-1, -2, -2, -4}, x = svd.step(r, 0.0);
    EXPECT_NEAR(x[0], 0.9, 1e-12);
    EXPECT_NEAR(x[1], 0.9 / u, 1e-12 / u);
    // What of 25 is explained: 25 - 0.7 squares of residuals left.
    EXPECT_NEAR(svd.decrement(r), 25.0 - 0.7, 1e-12);
    const std::vector<double> h = svd.leverage(); // 0.7, 0.3, 0.3, 0.7 of the textbook
    EXPECT_NEAR(h[0], 0.7, 1e-12);
    EXPECT_NEAR(h[1], 0.3, 1e-12);
    // Scaled columns stand at an angle of cosine 6 / sqrt(56): singular values sqrt(1 +- cosine).
    const double cosine = 6.0 / std::sqrt(56.0);
    EXPECT_NEAR(svd.condition(), std::sqrt((1 + cosine) / (1 - cosine)), 1e-12);
}

TEST(ScaledSvd, DampingShortensTheStep) {
    const ScaledSvd svd(matrix(2, 2, {3, 0, 0, 4}));
    const std::vector<double> x = svd.step({-3, -4}, 1.0); // each scaled unknown by 1 / (1 + 1)
    EXPECT_NEAR(x[0], 0.5, 1e-12);
    EXPECT_NEAR(x[1], 0.5, 1e-12);
}

TEST(ScaledSvd, WhatStandsInForAnotherIsSeen) {
    const ScaledSvd same(matrix(3, 2, {1, 10, 2, 20, 3, 30}));
    EXPECT_TRUE(std::isinf(same.condition()));
    EXPECT_TRUE(std::isinf(same.covariance().at(0, 0)));
    EXPECT_NEAR(std::abs(same.weakest()[0]), std::sqrt(0.5), 1e-12);
    const ScaledSvd fewer(matrix(1, 2, {1, 1}));
    EXPECT_TRUE(std::isinf(fewer.condition()));
    EXPECT_NEAR(fewer.step({-2}, 0.0)[0], 1.0, 1e-12);                          // of all that explain it, the shortest
    EXPECT_TRUE(std::isinf(ScaledSvd(matrix(2, 2, {1, 0, 2, 0})).condition())); // changes nothing
}

} // namespace
} // namespace fernlicht
