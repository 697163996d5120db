#include "scenarios/light/light_gradient.h"

#include "scenarios/light/light.h"
#include "tests/lamps.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace fernlicht {
namespace {

CandelaTable drawn_table(unsigned seed, BetweenSamples rule) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> cd(10.0, 5000.0);
    return tests::table_of(
        {-40.0, -11.0, -3.0, -0.5, 0.7, 4.0, 30.0}, {-9.0, -2.0, -1.1, 0.3, 5.0}, [&](double, double) { return cd(random); }, rule);
}

TEST(SampleWeights, AreTheDerivativesOfIntensityByEachSample) {
    for (const BetweenSamples rule : {BetweenSamples::linear_cd, BetweenSamples::log_cd})
        for (const auto& [h, v] : {std::pair(-7.3, -1.7), {0.1, 0.3}, {-40.0, -9.0}, {30.0, 5.0}, {2.2, 4.9}}) {
            const CandelaTable table = drawn_table(3, rule);
            const auto weights = sample_weights(table, h, v);
            ASSERT_TRUE(weights);
            std::vector<double> by_sample(table.cd.size());
            for (const SampleWeight& one : *weights)
                by_sample[one.sample] += one.weight;
            for (std::size_t i = 0; i < table.cd.size(); ++i) {
                const double step = 1e-4 * table.cd[i];
                CandelaTable more = table, less = table;
                more.cd[i] += step;
                less.cd[i] -= step;
                const double found = (intensity_cd(more, h, v) - intensity_cd(less, h, v)) / (2.0 * step);
                EXPECT_NEAR(by_sample[i], found, 1e-6 * std::max(std::abs(found), 1e-3)) << h << ' ' << v << " sample " << i;
            }
        }
}

TEST(SampleWeights, AreNoneWhereThereIsNoDataAndBilinearInADarkCell) {
    CandelaTable table = drawn_table(4, BetweenSamples::log_cd);
    EXPECT_FALSE(sample_weights(table, 31.0, 0.0));
    table.gaps.assign((table.h_deg.size() - 1) * (table.v_deg.size() - 1), 0);
    table.gaps[0] = 1;
    EXPECT_FALSE(sample_weights(table, -20.0, -5.0));
    table.cd[table.h_deg.size() + 2] = 0.0;
    const auto weights = sample_weights(table, -1.75, -1.55); // the middle of a cell with that sample
    ASSERT_TRUE(weights);
    for (const SampleWeight& one : *weights)
        EXPECT_DOUBLE_EQ(one.weight, 0.25);
}

/// Two lamps with one file and a third with another, in fog.
Moment three_lamps() {
    Moment moment;
    const auto low = tests::file_of(drawn_table(5, BetweenSamples::linear_cd));
    moment.lamps.push_back({.name = "left", .file = low, .pose = {{0.0, 0.6, 0.65}, axes_from_angles(0.01, -0.02, 0.005)}});
    moment.lamps.push_back(
        {.name = "right", .file = low, .pose = {{0.0, -0.6, 0.65}, axes_from_angles(-0.02, -0.01, 0.0)}, .intensity_factor = 0.8});
    moment.lamps.push_back({.name = "high",
                            .file = tests::file_of(drawn_table(6, BetweenSamples::log_cd)),
                            .pose = {{0.1, 0.4, 0.7}, glm::dmat3(1.0)},
                            .intensity_factor = 0.3});
    moment.weather.extinction_per_m = 0.004;
    moment.daylight.horizontal_illuminance_lx = 0.02;
    return moment;
}

TEST(LightGradient, IsTheDerivativeOfLightAtAPlaceByEachSampleOfEachLamp) {
    const Moment moment = three_lamps();
    const glm::dvec3 point_m(31.0, -2.0, 0.1), up = glm::normalize(glm::dvec3(0.01, 0.02, 1.0));
    EXPECT_NEAR(light_lx(moment, {point_m, Facing::lamps}), target_illuminance_lx(moment, point_m), 1e-13);
    EXPECT_NEAR(light_lx(moment, {point_m, Facing::surface, up}), surface_illuminance_lx(moment, point_m, up), 1e-13);
    for (const LightPlace& place : {LightPlace{point_m, Facing::lamps}, LightPlace{point_m, Facing::surface, up},
                                    LightPlace{point_m, Facing::eye, glm::dvec3(-1.0, 0.0, 0.0), {true, false, false}}}) {
        BeamGradient gradient;
        add_gradient(gradient, moment, place, 2.5);
        ASSERT_EQ(gradient.size(), place.hidden.empty() ? 3U : 2U);
        for (const LampGradient& lamp : gradient)
            for (std::size_t i = 0; i < lamp.per_cd.size(); ++i) {
                const double step = 1e-4 * lamp.file->table.cd[i];
                const auto changed = [&](double by) {
                    CandelaTable table = lamp.file->table;
                    table.cd[i] += by;
                    Moment with = moment;
                    for (LitLamp& one : with.lamps)
                        if (one.name == lamp.lamp)
                            one.file = tests::file_of(table);
                    return light_lx(with, place);
                };
                const double found = 2.5 * (changed(step) - changed(-step)) / (2.0 * step);
                EXPECT_NEAR(lamp.per_cd[i], found, 1e-6 * std::max(std::abs(found), 1e-6)) << lamp.lamp << " sample " << i;
            }
    }
}

} // namespace
} // namespace fernlicht
