#include "metrics/fit/lamp_fit.h"

#include "metrics/statistics/statistics.h"
#include "tests/metrics/fit/planted_points.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using ::testing::HasSubstr;
using tests::planned_points;
using tests::planted_shifts;
using tests::point_at;
using tests::read_points;
using tests::two_lamps;
using tests::value_of;

const std::vector<FitQuantity> all_quantities{FitQuantity::pitch, FitQuantity::yaw, FitQuantity::flux, FitQuantity::height};

/// What was planted, as FittedValue tells it.
double planted(const FittedValue& value) {
    const LampShift shift = planted_shifts()[value.lamp == "left" ? 0 : 1];
    const double here = shift[static_cast<std::size_t>(value.quantity)];
    return value.quantity == FitQuantity::flux ? std::exp(here) : value.quantity == FitQuantity::height ? here : degrees(here);
}

LampFit fitted(std::vector<LuxPoint> points, unsigned seed, const Shifts& shifts = planted_shifts(), const FitOptions& options = {}) {
    std::mt19937_64 random(seed);
    read_points(two_lamps(), shifts, points, seed > 0 ? &random : nullptr);
    return fit_lamps({two_lamps()}, points, options);
}

std::vector<std::string> held_of(const LampFit& fit) {
    std::vector<std::string> held;
    for (const FittedValue& value : fit.values)
        if (!value.held.empty())
            held.push_back(value.lamp + " " + name_of(value.quantity));
    return held;
}

TEST(LampFit, WithoutNoiseIsWhatWasPlanted) {
    const LampFit fit = fitted(planned_points({10.0, 25.0, 50.0}), 0);
    EXPECT_EQ(fit.failed, "");
    EXPECT_EQ(fit.values.size(), 8U);
    for (const FittedValue& value : fit.values)
        EXPECT_NEAR(value.change, planted(value), 1e-5) << value.lamp << ' ' << name_of(value.quantity) << value.held;
    EXPECT_LT(fit.chi_squared, 1e-6);
    EXPECT_EQ(fit.unknowns, 8U);
    EXPECT_LT(fit.condition, collinear_from);
}

// 240 points at 10, 25 and 50 m, a third of them across the cut-off, a part with one lamp lit, 3 % noise.
TEST(LampFit, RecoversAimAndFluxFromNoisyPoints) {
    std::vector<double> pulls;
    double worst_deg = 0.0, worst_flux = 0.0;
    std::size_t outliers = 0, inconsistent = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const LampFit fit = fitted(planned_points({10.0, 25.0, 50.0}), seed);
        ASSERT_EQ(fit.failed, "");
        ASSERT_EQ(held_of(fit), std::vector<std::string>());
        for (const FittedValue& value : fit.values) {
            const double off = value.change - planted(value);
            if (value.quantity == FitQuantity::flux)
                worst_flux = std::max(worst_flux, std::abs(off) / planted(value));
            else if (value.quantity != FitQuantity::height)
                worst_deg = std::max(worst_deg, std::abs(off));
            ASSERT_TRUE(value.standard_error.has_value());
            pulls.push_back(off / *value.standard_error);
        }
        outliers += fit.points.size() - fit.used;
        inconsistent += *fit.consistent() ? 0U : 1U;
    }
    EXPECT_LE(worst_deg, 0.02);
    EXPECT_LE(worst_flux, 0.01);
    const std::optional<Spread> spread = spread_of(pulls);
    // 160 pulls: the deviation is known to 6 %, their mean to 0.08.
    EXPECT_NEAR(spread->standard_deviation, 1.0, 0.18);
    EXPECT_NEAR(spread->mean, 0.0, 0.25);
    EXPECT_LE(outliers, 2U); // of 4800 good ones; 0.2 expected
    EXPECT_EQ(inconsistent, 0U);
}

TEST(LampFit, FindsLampsThatAreFarOff) {
    const Shifts far{{radians(-1.9), radians(3.6), std::log(0.5), 0.02}, {radians(2.2), radians(-2.7), std::log(1.6), 0.0}};
    const LampFit fit = fitted(planned_points({10.0, 25.0, 50.0}), 3, far);
    EXPECT_EQ(fit.failed, "");
    for (const auto& [lamp, name] : {std::pair(0U, "left"), std::pair(1U, "right")})
        for (const FitQuantity quantity : {FitQuantity::pitch, FitQuantity::yaw}) {
            const FittedValue& value = value_of(fit, name, quantity);
            EXPECT_NEAR(value.change, degrees(far[lamp][static_cast<std::size_t>(quantity)]), 5.0 * value.standard_error.value_or(0.0));
        }
}

TEST(LampFit, NamesGrossErrorsAndNoOthers) {
    std::vector<LuxPoint> points = planned_points({10.0, 25.0, 50.0});
    std::mt19937_64 random(7);
    read_points(two_lamps(), planted_shifts(), points, &random);
    const std::vector<std::size_t> gross{3, 57, 101, 166, 239};
    for (std::size_t k = 0; k < gross.size(); ++k) // a decimal point, a forgotten range, a shadow, a reading of its neighbour's
        points[gross[k]].lux *= std::vector<double>{10.0, 0.1, 0.5, 1.6, 0.75}[k];
    const LampFit fit = fit_lamps({two_lamps()}, points);
    std::vector<std::size_t> named;
    for (std::size_t i = 0; i < fit.points.size(); ++i)
        if (fit.points[i].outlier)
            named.push_back(i);
    EXPECT_EQ(named, gross);
    EXPECT_EQ(fit.used, 235U);
    EXPECT_TRUE(*fit.consistent());
    for (const FittedValue& value : fit.values)
        EXPECT_NEAR(value.change, planted(value), 4.0 * *value.standard_error) << value.lamp << ' ' << name_of(value.quantity);
}

TEST(LampFit, OneDistanceCannotTellHeightFromPitch) {
    const LampFit fit = fitted(planned_points({25.0}), 5);
    EXPECT_EQ(held_of(fit), (std::vector<std::string>{"left height", "right height"}));
    const FittedValue& height = value_of(fit, "left", FitQuantity::height);
    EXPECT_THAT(height.held, HasSubstr("cannot tell it from pitch of left"));
    EXPECT_EQ(height.change, 0.0);
    EXPECT_FALSE(height.standard_error.has_value());
    // The planted 13 mm at 25 m stand for 0.03 degrees of pitch.
    const FittedValue& pitch = value_of(fit, "left", FitQuantity::pitch);
    EXPECT_NEAR(pitch.change, planted(pitch) + degrees(std::atan(0.013 / 25.0)), 5.0 * *pitch.standard_error);
    EXPECT_LT(fit.condition, collinear_from);
}

TEST(LampFit, OneLampLitTellsOfThatLampAlone) {
    std::vector<LuxPoint> points = planned_points({10.0, 25.0, 50.0});
    for (LuxPoint& point : points)
        point.lamps = {1};
    const LampFit fit = fitted(points, 6);
    ASSERT_EQ(fit.values.size(), 4U);
    for (const FittedValue& value : fit.values) {
        EXPECT_EQ(value.lamp, "right");
        EXPECT_NEAR(value.change, planted(value), 4.5 * *value.standard_error) << name_of(value.quantity);
    }
}

TEST(LampFit, LampsAlwaysLitTogetherFarAwayChangeAlike) {
    std::vector<LuxPoint> points;
    for (int i = 0; i < 60; ++i)
        points.push_back(point_at(200.0, -3.0 + 6.0 * ((i * 7) % 60) / 59.0, -0.2 - 2.0 * i / 59.0));
    const LampFit fit = fitted(points, 8, {{0.0, 0.0, std::log(0.8), 0.0}, {0.0, 0.0, std::log(0.8), 0.0}});
    const FittedValue &left = value_of(fit, "left", FitQuantity::flux), &right = value_of(fit, "right", FitQuantity::flux);
    EXPECT_EQ(left.with, "right");
    EXPECT_EQ(right.with, "left");
    EXPECT_EQ(left.change, right.change);
    EXPECT_NEAR(left.change, 0.8, 5.0 * *left.standard_error);
    EXPECT_LT(*left.standard_error, 0.05);
}

TEST(LampFit, BelowTheCutOffAimIsKnownPoorlyAndHonestly) {
    std::vector<LuxPoint> points;
    for (int i = 0; i < 80; ++i)
        points.push_back(
            point_at(i % 2 ? 10.0 : 25.0, -5.0 + 10.0 * ((i * 13) % 80) / 79.0, -2.5 - 2.0 * i / 79.0, {std::size_t(i / 2 % 2)}));
    const LampFit fit = fitted(points, 9);
    std::size_t fitted_values = 0;
    for (const FittedValue& value : fit.values)
        if (value.held.empty()) {
            EXPECT_NEAR(value.change, planted(value), 4.5 * *value.standard_error) << value.lamp << ' ' << name_of(value.quantity);
            ++fitted_values;
        }
    EXPECT_GE(fitted_values, 2U);
    // Fifteen times worse than with the cut-off in sight, where it is 0.002 degrees.
    const FittedValue& pitch = value_of(fit, "left", FitQuantity::pitch);
    EXPECT_TRUE(!pitch.held.empty() || *pitch.standard_error > 0.03) << *pitch.standard_error;
}

TEST(LampFit, OnePointTellsOneThing) {
    const LampFit fit = fitted({point_at(25.0, 0.0, -1.5, {0})}, 0, {{0.0, 0.0, std::log(0.9), 0.0}, {}});
    EXPECT_EQ(held_of(fit), (std::vector<std::string>{"left pitch", "left yaw", "left height"}));
    EXPECT_NEAR(value_of(fit, "left", FitQuantity::flux).change, 0.9, 1e-6);
    EXPECT_NEAR(*value_of(fit, "left", FitQuantity::flux).standard_error, 0.03 * 0.9, 1e-6);
    EXPECT_FALSE(fit.consistent().has_value()) << "nothing is left over";
    EXPECT_FALSE(fit.points[0].studentised.has_value());
}

TEST(LampFit, FewerPointsThanValuesHoldTheRestBeforeAnythingElse) {
    const LampFit both = fitted({point_at(25.0, 0.0, -1.5)}, 0, {{0.0, 0.0, std::log(0.9), 0.0}, {0.0, 0.0, std::log(0.9), 0.0}});
    EXPECT_EQ(both.failed, "");
    EXPECT_EQ(both.unknowns, 1U);
    EXPECT_NEAR(value_of(both, "left", FitQuantity::flux).change, 0.9, 1e-6);
    EXPECT_NEAR(value_of(both, "right", FitQuantity::flux).change, 0.9, 1e-6);
    EXPECT_EQ(value_of(both, "right", FitQuantity::flux).with, "left");
    EXPECT_EQ(value_of(both, "right", FitQuantity::pitch).held, "there are fewer points than values");
    const LampFit three = fitted({point_at(25.0, -1.0, -1.5, {0}), point_at(25.0, -1.0, -0.6, {0}), point_at(25.0, 1.5, -0.2, {0})}, 0,
                                 {{radians(0.1), radians(-0.2), std::log(0.9), 0.0}, {}});
    EXPECT_EQ(held_of(three), (std::vector<std::string>{"left height"}));
    EXPECT_NEAR(value_of(three, "left", FitQuantity::pitch).change, 0.1, 1e-3);
}

TEST(LampFit, WithoutLightThereIsNothingToFit) {
    std::vector<LuxPoint> points;
    for (int i = 0; i < 10; ++i)
        points.push_back(point_at(25.0, 0.3 * i, -1.0));
    for (LuxPoint& point : points) {
        point.place_m.x = -20.0; // behind the car
        point.lux = 0.3;
    }
    const LampFit fit = fit_lamps({two_lamps()}, points);
    EXPECT_THAT(fit.failed, HasSubstr("no lamp lights any point"));
    EXPECT_EQ(fit.unknowns, 0U);
    for (const FittedValue& value : fit.values)
        EXPECT_THAT(value.held, HasSubstr("no lamp lights any point"));
}

TEST(LampFit, HoldsWhatItIsAskedTo) {
    const LampFit fit = fitted(planned_points({10.0, 25.0, 50.0}), 0, {{radians(0.3), 0.0, 0.0, 0.0}, {radians(0.1), 0.0, 0.0, 0.0}},
                               {.hold = {{"", FitQuantity::height}, {"right", FitQuantity::yaw}}});
    EXPECT_EQ(held_of(fit), (std::vector<std::string>{"left height", "right yaw", "right height"}));
    EXPECT_EQ(value_of(fit, "right", FitQuantity::yaw).held, "as asked");
    EXPECT_NEAR(value_of(fit, "left", FitQuantity::pitch).change, 0.3, 1e-5);
}

TEST(LampFit, SaysWhenUncertaintiesAreTooSmall) {
    std::vector<LuxPoint> points = planned_points({10.0, 25.0, 50.0});
    std::mt19937_64 random(4);
    for (LuxPoint& point : points)
        point.relative = 0.08;
    read_points(two_lamps(), planted_shifts(), points, &random);
    for (LuxPoint& point : points)
        point.relative = 0.03;
    const LampFit fit = fit_lamps({two_lamps()}, points);
    EXPECT_FALSE(*fit.consistent());
    EXPECT_NEAR(fit.error_scale, 0.08 / 0.03, 0.4);
    EXPECT_LE(fit.points.size() - fit.used, 3U) << "who is noisier than stated is no outlier for it";
    for (const FittedValue& value : fit.values)
        EXPECT_NEAR(value.change, planted(value), 4.0 * *value.standard_error) << value.lamp << ' ' << name_of(value.quantity);
}

TEST(LampFit, UncertainPlacesWeighWhereTheLightIsSteep) {
    std::vector<LuxPoint> points = planned_points({10.0, 25.0, 50.0});
    std::mt19937_64 random(12);
    read_points(two_lamps(), planted_shifts(), points, nullptr);
    std::vector<LuxPoint> misplaced = points;
    for (LuxPoint& point : misplaced)
        for (int axis = 0; axis < 3; ++axis)
            point.place_m[axis] += 0.01 * tests::normal(random);
    const std::vector<CarAtReading> cars{two_lamps()};
    const std::vector<double> read = FitModel(cars, misplaced).lux(planted_shifts());
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].lux = read[i];
        points[i].relative = 0.01;
    }
    EXPECT_FALSE(*fit_lamps(cars, points).consistent());
    for (LuxPoint& point : points)
        point.place_uncertainty_m = 0.01;
    const LampFit fit = fit_lamps(cars, points);
    EXPECT_TRUE(*fit.consistent());
    for (const FittedValue& value : fit.values)
        EXPECT_NEAR(value.change, planted(value), 4.0 * *value.standard_error) << value.lamp << ' ' << name_of(value.quantity);
}

TEST(LampFit, RefusesPointsWithoutUncertainty) {
    LuxPoint point = point_at(25.0, 0.0, -1.0);
    point.lux = 3.0;
    point.relative = 0.0;
    EXPECT_THROW(fit_lamps({two_lamps()}, {point}), std::invalid_argument);
    point.relative = 0.03;
    point.lux = 0.0; // 3 % of nothing
    EXPECT_THROW(fit_lamps({two_lamps()}, {point}), std::invalid_argument);
    EXPECT_THROW(fit_lamps({two_lamps()}, {}), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
