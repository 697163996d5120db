#include "metrics/tolerances/cars_readings.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

const ReadingKey reach_of_cars = key_of("reach_5lx_target_own_m").value(), eye_of_cars = key_of("glare_x_facing_max_lx").value();

/// Cars whose pitch alone moves a reading, by a function.
struct Planted {
    ToleranceParameters tolerances = {};
    std::vector<CarPart> parts{{ToleranceKind::pitch, "left", {.sigma = 0.1, .from = {}, .to = {}, .source = {}}},
                               {ToleranceKind::flux, "left", {.sigma = 5.0, .from = {}, .to = {}, .source = {}}}};
    std::function<Value(double pitch_deg, double flux_percent)> read;
    double played = 0.0; ///< added to what a car as designed reads
    int evaluated = 0;

    SeriesFindings measure() {
        const EvaluateCars evaluate = [this](const std::vector<CarValues>& cars) {
            std::vector<Readings> all;
            for (const CarValues& car : cars) {
                ++evaluated;
                all.push_back({{reach_of_cars, read(car[0], car[1])}});
            }
            return all;
        };
        const Value designed = read(0.0, 0.0);
        return measure_cars(tolerances, parts, {{reach_of_cars, designed.number() ? Value(*designed.number() + played) : designed}},
                            evaluate, evaluate);
    }
};

TEST(CarsReadings, OfALinearReadingAreThoseOfANormalDistribution) {
    // 60 m + 30 m a degree of pitch + 0.2 m a per cent of flux: deviation sqrt(3^2 + 1^2) m.
    Planted cars{.read = [](double pitch, double flux) { return Value(60.0 + 30.0 * pitch + 0.2 * flux); }};
    cars.played = 1.5; // as rendered, not as calculated
    cars.tolerances.limits = {{"reach_5lx_target_own_m", 61.5, {}}, {"width_3lx_target_all_at_20m_m", 1.0, {}}};
    const SeriesFindings found = cars.measure();
    ASSERT_EQ(found.readings.size(), 1U);
    const ReadingOfCars& of = found.readings.front();
    const double deviation = std::sqrt(10.0), sampling = 3.0 * deviation * std::sqrt(0.05 * 0.95 / 10'000) / 0.1031; // density at 5 %
    EXPECT_TRUE(of.by_slopes);
    EXPECT_LT(of.slope_error.value(), 1e-9);
    EXPECT_NEAR(of.spread.value(), deviation, 3.0 * deviation / std::sqrt(2.0 * 200.0));
    EXPECT_NEAR(of.p05.number().value(), 61.5 - 1.6449 * deviation, sampling);
    EXPECT_NEAR(of.median.number().value(), 61.5, sampling);
    EXPECT_NEAR(of.p95.number().value(), 61.5 + 1.6449 * deviation, sampling);
    EXPECT_NEAR(of.variance_shares.at(0), 0.9, 0.01);
    EXPECT_EQ(cars.evaluated, 5 + 1 + 200) << "slopes at both ends of each part, then cars in full";
    EXPECT_NEAR(found.within.at(0).share_percent.number().value(), 50.0, 1.5);
    EXPECT_LT(found.within.at(0).low_percent, 50.0);
    EXPECT_GT(found.within.at(0).high_percent, 50.0);
    EXPECT_NEAR(found.within.at(0).in_full_percent.number().value(), 50.0, 10.6) << "three deviations of 200 cars";
    EXPECT_FALSE(found.within.at(1).share_percent.measured());
    EXPECT_FALSE(found.within.at(2).share_percent.measured()) << "all of them: one is on no reading";
}

TEST(CarsReadings, WhoseSlopesFailComeFromCarsInFull) {
    // A fold: down by 40 m a degree to either side. Each side's slope tells it, and a product of both parts does not.
    Planted fold{.read = [](double pitch, double) { return Value(60.0 - 40.0 * std::abs(pitch)); }};
    const ReadingOfCars folded = fold.measure().readings.at(0);
    EXPECT_TRUE(folded.by_slopes);
    EXPECT_NEAR(folded.median.number().value(), 60.0 - 40.0 * 0.1 * 0.6745, 0.1);
    EXPECT_LT(folded.p95.number().value(), 60.0);

    Planted step{.read = [](double pitch, double) { return Value(pitch < 0.12 ? 60.0 : 20.0); }}; // 11.5 % of cars lose it
    step.tolerances.limits = {{"reach_5lx_target_own_m", 50.0, {}}};
    const SeriesFindings stepped = step.measure();
    EXPECT_FALSE(stepped.readings.at(0).by_slopes);
    EXPECT_EQ(stepped.readings.at(0).p05, Value(20.0));
    EXPECT_EQ(stepped.readings.at(0).median, Value(60.0));
    EXPECT_EQ(stepped.within.at(0).of, 200U);
    EXPECT_LT(stepped.within.at(0).low_percent, 88.5);
    EXPECT_GT(stepped.within.at(0).high_percent, 88.5);
    EXPECT_FALSE(stepped.within.at(0).in_full_percent.measured()) << "it is of these";

    Planted far{.read = [](double pitch, double) { return pitch > 0.0 ? Value::at_least(200.0) : Value(150.0 + pitch); }};
    far.tolerances.limits = {{"reach_5lx_target_own_m", 149.9, {}}, {"reach_5lx_target_own_m", 210.0, {}}};
    const std::vector<CarsWithin> open = far.measure().within;
    EXPECT_EQ(open.at(0).open, 0U);
    EXPECT_TRUE(open.at(1).share_percent.censored()) << "those that go on beyond 200 m may reach 210 m";
    EXPECT_EQ(open.at(1).share_percent.figure(), 0.0);
    EXPECT_GT(open.at(1).open, 60U);
    EXPECT_GT(open.at(1).high_percent, 40.0);

    Planted bound{.read = [](double pitch, double) { return pitch > 0.05 ? Value::at_least(200.0) : Value(150.0 + pitch); }};
    const ReadingOfCars bounded = bound.measure().readings.at(0);
    EXPECT_FALSE(bounded.by_slopes);
    EXPECT_EQ(bounded.p95, Value::at_least(200.0));
    EXPECT_TRUE(bounded.p05.number());
}

TEST(CarsReadings, AnInterruptedSeriesSaysNothing) {
    const EvaluateCars none = [](const std::vector<CarValues>&) { return std::vector<Readings>(); };
    const SeriesFindings found =
        measure_cars({}, varying_parts({}, {"left"}, false), {{reach_of_cars, Value(60.0)}, {eye_of_cars, Value(0.2)}}, none, none);
    EXPECT_TRUE(found.readings.empty());
    EXPECT_TRUE(readings_of(found).empty());
}

TEST(CarsReadings, AreReadingsWithNamesOfTheirOwn) {
    Planted cars{.read = [](double pitch, double) { return Value(60.0 + 30.0 * pitch); }};
    cars.tolerances.limits = {{"reach_5lx_target_own_m", 50.0, 70.0}};
    const Readings readings = readings_of(cars.measure());
    std::vector<std::string> names;
    for (const Reading& reading : readings) {
        names.push_back(reading.name());
        EXPECT_EQ(key_of(names.back()), reading.key);
        EXPECT_TRUE(is_of_cars(reading.key));
        EXPECT_FALSE(is_uncertainty(reading.key));
    }
    EXPECT_EQ(names, (std::vector<std::string>{"reach_5lx_target_own_cars_p05_m", "reach_5lx_target_own_cars_median_m",
                                               "reach_5lx_target_own_cars_p95_m", "cars_within_reach_5lx_target_own_m_percent"}));
}

TEST(CarsReadings, IntervalsOfSharesAreWilsons) {
    // Newcombe 1998, Statistics in Medicine 17, table I, method 3: 81 of 263 and 15 of 148, 0 of 20.
    for (const auto& [within, of, low, high] : {std::tuple(81, 263, 25.53, 36.62), std::tuple(15, 148, 6.24, 16.05),
                                                std::tuple(0, 20, 0.0, 16.11), std::tuple(29, 29, 88.30, 100.0)}) {
        const auto interval = share_interval_percent(static_cast<std::size_t>(within), static_cast<std::size_t>(of));
        EXPECT_NEAR(interval.first, low, 0.01);
        EXPECT_NEAR(interval.second, high, 0.01);
    }
}

TEST(CarsReadings, CountFromDistributionsBesideTheDrivesOwnValue) {
    // All cars 0.1 to 0.3 degrees low: 40 m a degree, by the farther end's slope of what bends at 0.2 degrees.
    Planted low{.read = [](double pitch, double) { return Value(60.0 + 40.0 * std::max(pitch, -0.2)); }};
    low.parts = {{ToleranceKind::pitch, "left", {.from = -0.3, .to = -0.1, .source = {}}}, low.parts[1]};
    const ReadingOfCars bent = low.measure().readings.at(0);
    EXPECT_FALSE(bent.by_slopes);
    EXPECT_NEAR(bent.p05.number().value(), 52.0, 1e-9);
    Planted shifted{.read = [](double pitch, double) { return Value(60.0 + 40.0 * pitch); }};
    shifted.parts = {{ToleranceKind::pitch, "left", {.sigma = 0.0, .mean = -0.25, .from = {}, .to = {}, .source = {}}}, shifted.parts[1]};
    const ReadingOfCars all_low = shifted.measure().readings.at(0);
    EXPECT_NEAR(all_low.p05.number().value(), 50.0, 1e-9);
    EXPECT_NEAR(all_low.p95.number().value(), 50.0, 1e-9);
}

TEST(Cars, AreDrawnFromTheirTolerances) {
    ToleranceParameters tolerances;
    tolerances.yaw_deg = Tolerance{.from = -0.2, .to = 0.4, .source = "line 3"};
    tolerances.roll_deg = Tolerance{.from = {}, .to = {}, .source = {}};
    tolerances.load_kg = Tolerance{.sigma = 20.0, .mean = 60.0, .from = {}, .to = {}, .source = {}};
    std::vector<std::string> names;
    for (const CarPart& part : varying_parts(tolerances, {"left", "right"}, true))
        names.push_back(name_of(part));
    EXPECT_EQ(names, (std::vector<std::string>{"pitch of left", "yaw of left", "flux of left", "pitch of right", "yaw of right",
                                               "flux of right", "height", "load"}));
    EXPECT_EQ(varying_parts(tolerances, {"left"}, false).size(), 4U) << "nobody knows the springs of a car without a vehicle";

    const std::vector<CarPart> parts = varying_parts(tolerances, {"left"}, true);
    const std::vector<CarValues> cars = drawn_cars(parts, 7, 20'000), fewer = drawn_cars(parts, 7, 50);
    EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), cars.begin())) << "the first ones are the same";
    const auto spread = [&](std::size_t part) {
        std::vector<double> values;
        for (const CarValues& car : cars)
            values.push_back(car[part]);
        return spread_of(std::move(values)).value();
    };
    EXPECT_NEAR(spread(0).standard_deviation, 0.1, 0.0015);
    EXPECT_NEAR(spread(1).mean, 0.1, 0.004);
    EXPECT_GE(spread(1).minimum, -0.2);
    EXPECT_LE(spread(1).maximum, 0.4);
    EXPECT_NEAR(spread(4).mean, 60.0, 0.5);
}

} // namespace
} // namespace fernlicht
