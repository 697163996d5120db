#include "metrics/images/pixel_errors.h"

#include <gmock/gmock.h>
#include <limits>
#include <stdexcept>

namespace fernlicht {
namespace {

using testing::ElementsAre;

/// Every pixel of a ramp from 1 to 100 lx, `factor` times too bright; each shows 2 m2.
PixelErrors of_ramp(double factor, double standard_error = 0.0) {
    PixelErrorFold fold;
    for (int x = 0; x < 100; ++x)
        fold.add({factor * (1.0 + x), 1.0 + x, standard_error, 2.0, 3, x, 7});
    return fold.finish().value();
}

TEST(PixelErrors, TwoPerCentTooBrightShowsAsTwoPerCent) {
    const PixelErrors errors = of_ramp(1.02);
    for (const double error : {errors.error.median, errors.error.p95, errors.error.p99, errors.worst.error, errors.mean})
        EXPECT_NEAR(error, 0.02, 1e-8); // kept as float
    EXPECT_EQ(errors.pixels, 100U);
    EXPECT_DOUBLE_EQ(errors.area_m2.value(), 200.0);
    EXPECT_THAT(errors.percent_beyond, ElementsAre(100.0, 0.0, 0.0));
    EXPECT_FALSE(errors.below_floor());
    EXPECT_NEAR(of_ramp(0.98).mean, -0.02, 1e-12);
    EXPECT_NEAR(of_ramp(0.98).error.median, 0.02, 1e-8);
}

TEST(PixelErrors, WhatTheReferenceMayHaveDoneItselfIsNotClaimed) {
    PixelErrorFold fold;
    fold.add({1.02, 1.0, 0.02, 1.0, 0, 0, 0});  // one standard error
    fold.add({1.049, 1.0, 0.02, 1.0, 0, 1, 0}); // two and a half
    const PixelErrors errors = fold.finish().value();
    EXPECT_NEAR(errors.floor.p95, 0.04, 1e-8);
    EXPECT_NEAR(errors.error.median, 0.0345, 1e-8);
    EXPECT_THAT(errors.percent_beyond, ElementsAre(0.0, 0.0, 0.0)); // 4.9 % is not more than 1 % + 4 %
    fold.add({1.06, 1.0, 0.02, 2.0, 0, 2, 0});
    EXPECT_THAT(fold.finish()->percent_beyond, ElementsAre(50.0, 0.0, 0.0));
    EXPECT_TRUE(of_ramp(1.0, 0.01).below_floor());
    EXPECT_FALSE(of_ramp(1.0).below_floor()); // no error, and no noise either
}

TEST(PixelErrors, QuantilesAreThoseOfTheErrorsByHand) {
    PixelErrorFold fold;
    for (int x = 0; x <= 100; ++x) // errors of 0, 0.1, ... 10 %
        fold.add({10.0 * (1.0 + 0.001 * x), 10.0, 0.0, 1.0, 0, x, 0});
    const PixelErrors errors = fold.finish().value();
    EXPECT_NEAR(errors.error.median, 0.050, 1e-8);
    EXPECT_NEAR(errors.error.p95, 0.095, 1e-8);
    EXPECT_NEAR(errors.error.p99, 0.099, 1e-8);
    EXPECT_NEAR(errors.percent_beyond[0], 100.0 * 90.0 / 101.0, 1.1); // 1 % itself is a matter of rounding
    EXPECT_EQ(errors.worst.x, 100);
    EXPECT_DOUBLE_EQ(errors.worst.tested, 11.0);
}

TEST(PixelErrors, AreaCountsNotPixels) {
    PixelErrorFold fold;
    for (int x = 0; x < 9; ++x)
        fold.add({1.0, 1.0, 0.0, 1.0, 0, x, 0});
    fold.add({1.5, 1.0, 0.0, 91.0, 2, 9, 4});
    const PixelErrors errors = fold.finish().value();
    EXPECT_THAT(errors.percent_beyond, ElementsAre(91.0, 91.0, 91.0));
    EXPECT_EQ(errors.error.median, 0.0);
    EXPECT_EQ(errors.worst.picture, 2);
    EXPECT_EQ(errors.worst.y, 4);
}

TEST(PixelErrors, InTheDarkErrorsAreAbsolute) {
    PixelErrorFold fold(ErrorRule{0.05, 2.0});
    fold.add({0.02, 0.049, 0.001, 1.0, 0, 0, 0});
    fold.add({0.0, 0.0, 0.0, 1.0, 0, 1, 0});
    PixelErrors errors = fold.finish().value();
    EXPECT_EQ(errors.pixels, 0U);
    EXPECT_EQ(errors.dark_pixels, 2U);
    EXPECT_NEAR(errors.dark_worst.error, 0.029, 1e-12);
    EXPECT_NEAR(errors.dark_floor.p99, 0.99 * 0.002, 1e-8);
    EXPECT_EQ(errors.mean, 0.0);
    fold.add({0.1, 0.05, 0.0, 1.0, 0, 2, 0}); // at the limit it is light
    errors = fold.finish().value();
    EXPECT_EQ(errors.pixels, 1U);
    EXPECT_NEAR(errors.worst.error, 1.0, 1e-12);
}

TEST(PixelErrors, RefusesWhatIsNoNumber) {
    EXPECT_FALSE(PixelErrorFold().finish());
    PixelErrorFold fold;
    EXPECT_THROW(fold.add({std::numeric_limits<double>::quiet_NaN(), 1.0, 0.0, 1.0, 0, 0, 0}), std::invalid_argument);
    EXPECT_THROW(fold.add({1.0, std::numeric_limits<double>::infinity(), 0.0, 1.0, 0, 0, 0}), std::invalid_argument);
    EXPECT_THROW(fold.add({1.0, 1.0, -1e-9, 1.0, 0, 0, 0}), std::invalid_argument);
    EXPECT_THROW(fold.add({1.0, 1.0, 0.0, -1.0, 0, 0, 0}), std::invalid_argument);
    EXPECT_FALSE(fold.finish());
}

TEST(PixelErrors, WithoutAreasPixelsAreCounted) {
    PixelErrorFold fold;
    for (int x = 0; x < 9; ++x)
        fold.add({1.0, 1.0, 0.0, {}, 0, x, 0});
    fold.add({1.5, 1.0, 0.0, {}, 0, 9, 0});
    const PixelErrors errors = fold.finish().value();
    EXPECT_FALSE(errors.area_m2);
    EXPECT_EQ(errors.pixels, 10U);
    EXPECT_DOUBLE_EQ(errors.percent_beyond[2], 10.0);
    EXPECT_THROW(fold.add({1.0, 1.0, 0.0, 1.0, 0, 0, 0}), std::invalid_argument);
    PixelErrorFold road;
    road.add({1.0, 1.0, 0.0, 2.0, 0, 0, 0});
    EXPECT_THROW(road.add({1.0, 1.0, 0.0, {}, 0, 0, 0}), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
