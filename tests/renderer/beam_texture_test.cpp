#include "renderer/beam_texture.h"

#include "scenarios/values/pose.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace fernlicht {
namespace {

CandelaTable table_on(std::vector<double> h, std::vector<double> v, unsigned seed) {
    CandelaTable table{std::move(h), std::move(v), {}, {}, BetweenSamples::linear_cd};
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < table.h_deg.size() * table.v_deg.size(); ++i)
        table.cd.push_back(static_cast<double>(random() % 10000));
    return table;
}

double look_up(const BeamTexture& t, double h_deg, double v_deg) {
    const double x = (radians(h_deg) - t.h_first_rad) / t.h_step_rad, y = (radians(v_deg) - t.v_first_rad) / t.v_step_rad;
    const auto x0 = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(t.width) - 2);
    const auto y0 = std::min(static_cast<std::size_t>(y), static_cast<std::size_t>(t.height) - 2);
    const double fx = x - static_cast<double>(x0), fy = y - static_cast<double>(y0);
    const auto cd = [&](std::size_t i, std::size_t k) { return static_cast<double>(t.cd[k * static_cast<std::size_t>(t.width) + i]); };
    return (cd(x0, y0) * (1 - fx) + cd(x0 + 1, y0) * fx) * (1 - fy) + (cd(x0, y0 + 1) * (1 - fx) + cd(x0 + 1, y0 + 1) * fx) * fy;
}

TEST(BeamTexture, ReproducesTheLinearRuleExactlyWhereAStepIsCommon) {
    const CandelaTable table = table_on({-10, -5, -4.5, -4, 0, 1, 2.5, 10}, {-4, -2, -1, -0.75, -0.5, 0, 2}, 1);
    const BeamTexture texture = make_beam_texture(table);
    EXPECT_LE(degrees(texture.h_step_rad), 0.05 + 1e-12);
    EXPECT_LE(degrees(texture.v_step_rad), 0.05 + 1e-12);
    EXPECT_LT(texture.worst_error_of_peak, 1e-6);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> h(-10, 10), v(-4, 2);
    for (int i = 0; i < 2000; ++i) {
        const double a = h(random), b = v(random);
        ASSERT_NEAR(look_up(texture, a, b), intensity_cd(table, a, b), 1e-2) << a << ' ' << b;
    }
}

TEST(BeamTexture, SaysWhatItCostsWhereNoStepIsCommon) {
    const BeamTexture texture = make_beam_texture(table_on({-3.3, -1.0 / 3.0, 0.1234567, 2.71828}, {-1.41421, 0.3, 1.0}, 2));
    EXPECT_GT(texture.worst_error_of_peak, 1e-6);
    EXPECT_LT(texture.worst_error_of_peak, 0.05);
}

// A cut-off far narrower than a texel: between the two texels around it the drawn beam runs evenly while the table jumps. With the cut-off
// at a share f of the texel the difference is f of the step just above it and 1 - f just below: the larger one counts, wherever it lies.
TEST(BeamTexture, SaysWhatACutOffWithinATexelCosts) {
    for (const double at : {0.01, 0.5, 0.99}) {
        const double cut = 1.0 + 0.05 * at;
        CandelaTable table{{-1.0, 1.0}, {0.0, cut, cut + 1e-5, 2.0}, {}, {}, BetweenSamples::linear_cd};
        for (const double cd : {1000.0, 1000.0, 1.0, 1.0})
            table.cd.insert(table.cd.end(), {cd, cd});
        const BeamTexture texture = make_beam_texture(table);
        EXPECT_NEAR(texture.worst_error_of_peak, std::max(at, 1.0 - at), 2e-3) << at;
    }
}

TEST(BeamTexture, KeepsWithinItsSizeAndReportsTheLoss) {
    const CandelaTable table = table_on({-90, -45, 0, 45, 90}, {-90, -30, 0, 30, 90}, 3);
    const BeamTexture texture = make_beam_texture(table, 100'000);
    EXPECT_LE(texture.cd.size(), 100'000U);
    // Steps of 0.57 degrees beside samples 30 degrees apart: a kink of 2 / 30 of the peak a degree, missed by a quarter step on both axes.
    EXPECT_LT(texture.worst_error_of_peak, 0.02);
}

TEST(BeamTexture, ADarkTableIsDark) {
    CandelaTable table = table_on({-1, 0, 1}, {-1, 0, 1}, 4);
    table.cd.assign(9, 0.0);
    const BeamTexture texture = make_beam_texture(table);
    for (const float cd : texture.cd)
        ASSERT_EQ(cd, 0.0F);
}

TEST(BeamTexture, LeavesTheDarkRimOut) {
    CandelaTable table = table_on({-90, -20, -10, 0, 10, 20, 90}, {-90, -5, 0, 5, 90}, 5);
    for (std::size_t v = 0; v < 5; ++v)
        for (std::size_t h = 0; h < 7; ++h)
            if (v == 0 || v == 4 || h <= 1 || h >= 5)
                table.at(v, h) = 0.0;
    const BeamTexture texture = make_beam_texture(table);
    EXPECT_NEAR(degrees(texture.h_first_rad), -20.0, 1e-9);
    EXPECT_NEAR(degrees(texture.h_first_rad + (texture.width - 1) * texture.h_step_rad), 20.0, 1e-9);
}

TEST(BeamTexture, OfAGivenSizeRunsFromEdgeToEdgeInSteps) {
    const CandelaTable table = table_on({-10, -5, -4.5, -4, 0, 1, 2.5, 10}, {-4, -2, -1, -0.75, -0.5, 0, 2}, 6);
    const BeamTexture fine = make_beam_texture(table, {201, 121, 32}), coarse = make_beam_texture(table, {201, 121, 8});
    EXPECT_EQ(fine.width, 201);
    EXPECT_NEAR(degrees(fine.h_step_rad), 0.1, 1e-12); // 20 degrees in 200
    EXPECT_NEAR(degrees(fine.v_first_rad + 120 * fine.v_step_rad), 2.0, 1e-12);
    EXPECT_NEAR(look_up(fine, 1.0, -0.75), intensity_cd(table, 1.0, -0.75), 1e-2); // both on texels
    EXPECT_EQ(coarse.scale_cd, fine.scale_cd);
    for (std::size_t i = 0; i < fine.cd.size(); ++i) {
        const double steps = static_cast<double>(coarse.cd[i]) / fine.scale_cd * 255.0;
        ASSERT_NEAR(steps, std::round(steps), 1e-4);
        ASSERT_NEAR(coarse.cd[i], fine.cd[i], 0.5001 / 255.0 * fine.scale_cd);
    }
    EXPECT_GT(coarse.worst_error_of_peak, 0.4 / 255.0);
    EXPECT_LT(make_beam_texture(table, {201, 121, 16}).worst_error_of_peak, fine.worst_error_of_peak + 1.0 / 65535.0);
    EXPECT_THROW(make_beam_texture(table, {1, 121, 8}), std::invalid_argument);
    EXPECT_THROW(make_beam_texture(table, {201, 8193, 8}), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
