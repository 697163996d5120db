#include "renderer/beam_texture.h"
#include "renderer/projected_beam.h"
#include "scenarios/lamps/lamp_model.h"
#include "scenarios/light/light.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>
#include <random>
#include <tuple>

namespace fernlicht {
namespace {

LitLamp turned_lamp(glm::dvec3 position, double yaw_rad, double factor = 1.0) {
    static const auto file = std::make_shared<LampFile>(lamp_of_model(lamp_models()[0]));
    return {"lamp", file, Pose{position, axes_from_angles(yaw_rad, 0.0, 0.0)}, factor, {}, 0.0};
}

double merged_lx(const ProjectedBeam& beam, const Pose& pose, const glm::dvec3& point) {
    const glm::dvec3 p = to_local(pose, point);
    const glm::dvec4 place = texture_from_lamp(beam.window) * glm::dvec4(-p.y, p.z, p.x, 1.0);
    return place.w > 0.0 ? projected_lx(beam, place.x / place.w, place.y / place.w) * 625.0 / glm::dot(p, p) : 0.0;
}

TEST(MergedBeam, StandsMidwayAlongTheMeanAxis) {
    const std::vector<LitLamp> lamps{turned_lamp({3.5, 0.6, 0.6}, 0.1), turned_lamp({3.5, -0.6, 0.7}, 0.3)};
    const Pose pose = merged_pose(lamps);
    EXPECT_NEAR(glm::distance(pose.position_m, glm::dvec3(3.5, 0.0, 0.65)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(pose.forward(), glm::dvec3(std::cos(0.2), std::sin(0.2), 0.0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(pose.left(), glm::dvec3(-std::sin(0.2), std::cos(0.2), 0.0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(pose.up(), glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-12);
}

TEST(MergedBeam, LampsThatAreOffDoNotMoveIt) {
    const std::vector<LitLamp> lamps{turned_lamp({3.5, 0.6, 0.6}, 0.1), turned_lamp({3.5, -0.6, 0.7}, 3.0, 0.0)};
    EXPECT_EQ(merged_pose(lamps).position_m, glm::dvec3(3.5, 0.6, 0.6));
    EXPECT_EQ(merged_pose({}), Pose());
    EXPECT_EQ(make_merged_beam({}, {4, 4, 32}).scale_lx, 0.0);
}

TEST(MergedBeam, AxesThatCancelAreRefused) {
    const std::vector<LitLamp> lamps{turned_lamp({3.5, 0.6, 0.6}, 0.0), turned_lamp({-1.0, 0.6, 0.6}, pi)};
    EXPECT_THROW(merged_pose(lamps), InputError);
}

TEST(MergedBeam, IsExactAt25MetresAndWrongNearer) {
    Moment moment{.lamps = {turned_lamp({3.5, 0.6, 0.65}, 0.02), turned_lamp({3.5, -0.6, 0.65}, -0.01, 0.7)}};
    const Pose pose = merged_pose(moment.lamps);
    const ProjectedBeam beam = make_merged_beam(moment.lamps, {512, 256, 32});
    double worst_nearer = 0.0;
    for (int row = 0; row < beam.height; row += 5)
        for (int column = 0; column < beam.width; column += 7) {
            const double x = beam.window.left + (beam.window.right - beam.window.left) * (column + 0.5) / beam.width;
            const double y = beam.window.bottom + (beam.window.top - beam.window.bottom) * (row + 0.5) / beam.height;
            const glm::dvec3 direction = pose.axes * glm::normalize(glm::dvec3(1.0, -x, y));
            const glm::dvec3 exact = pose.position_m + 25.0 * direction, near = pose.position_m + 8.0 * direction;
            const double truth = target_illuminance_lx(moment, exact);
            ASSERT_NEAR(merged_lx(beam, pose, exact), truth, 1e-6 * beam.scale_lx) << row << ' ' << column; // a float, and rounding of s, t
            const double truth_near = target_illuminance_lx(moment, near);
            worst_nearer = std::max(worst_nearer, std::abs(merged_lx(beam, pose, near) - truth_near));
        }
    EXPECT_GT(worst_nearer, 0.05 * beam.scale_lx * 625.0 / 64.0);
}

TEST(MergedBeam, OneLampIsItsOwnProjection) {
    const std::vector<LitLamp> one{turned_lamp({1.0, 2.0, 0.5}, 0.4)};
    const ProjectedBeam merged = make_merged_beam(one, {128, 64, 8}), own = make_projected_beam(one[0].file->table, {128, 64, 8});
    EXPECT_NEAR(merged.window.left, own.window.left, 1e-12);
    EXPECT_NEAR(merged.window.top, own.window.top, 1e-12);
    EXPECT_NEAR(merged.scale_lx, own.scale_lx, 1e-5);
    EXPECT_NEAR(merged.worst_error_of_peak, own.worst_error_of_peak, 1e-6);
}

TEST(MergedBeam, SeesBothWindowsWhole) {
    const std::vector<LitLamp> lamps{turned_lamp({3.5, 5.0, 0.65}, 0.1), turned_lamp({3.5, -5.0, 0.65}, -0.1)};
    const TangentWindow own = lit_window(lamps[0].file->table);
    const ProjectedBeam beam = make_merged_beam(lamps, {64, 32, 32});
    EXPECT_LT(beam.window.left, own.left);
    EXPECT_GT(beam.window.right, own.right);
    EXPECT_LE(beam.window.right, 1.4);
}

TEST(MergedBeam, GoesWithTheCar) {
    std::vector<LitLamp> lamps{turned_lamp({3.5, 0.6, 0.65}, 0.02), turned_lamp({3.5, -0.6, 0.65}, -0.01)};
    const ProjectedBeam at_origin = make_merged_beam(lamps, {64, 32, 32});
    const Pose car{{3e6, -2e6, 400.0}, axes_from_angles(1.0, 0.05, 0.02)}, before = compose(car, merged_pose(lamps));
    for (LitLamp& lamp : lamps)
        lamp.pose = compose(car, lamp.pose);
    const Pose after = merged_pose(lamps);
    EXPECT_LT(glm::distance(before.position_m, after.position_m), 1e-8); // a unit in the last place of 3e6 m is 5e-10
    EXPECT_LT(glm::distance(before.forward(), after.forward()), 1e-12);
    const ProjectedBeam far = make_merged_beam(lamps, {64, 32, 32});
    for (std::size_t i = 0; i < far.lx.size(); ++i)
        ASSERT_NEAR(static_cast<double>(far.lx[i]), static_cast<double>(at_origin.lx[i]), 1e-5 * at_origin.scale_lx);
}

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

TEST(BeamTexture, SaysWhatItCosts) {
    const BeamTexture texture = make_beam_texture(table_on({-3.3, -1.0 / 3.0, 0.1234567, 2.71828}, {-1.41421, 0.3, 1.0}, 2));
    EXPECT_GT(texture.worst_error_of_peak, 1e-6);
    EXPECT_LT(texture.worst_error_of_peak, 0.05);
    // A cut-off far narrower than a texel: between the two texels around it the drawn beam runs evenly while the table jumps. With the
    // cut-off at a share f of the texel the difference is f of the step just above it and 1 - f just below: the larger one counts, wherever
    // it lies.
    for (const double at : {0.01, 0.5, 0.99}) {
        const double cut = 1.0 + 0.05 * at;
        CandelaTable table{{-1.0, 1.0}, {0.0, cut, cut + 1e-5, 2.0}, {}, {}, BetweenSamples::linear_cd};
        for (const double cd : {1000.0, 1000.0, 1.0, 1.0})
            table.cd.insert(table.cd.end(), {cd, cd});
        EXPECT_NEAR(make_beam_texture(table).worst_error_of_peak, std::max(at, 1.0 - at), 2e-3) << at;
    }
    const CandelaTable table = table_on({-90, -45, 0, 45, 90}, {-90, -30, 0, 30, 90}, 3);
    const BeamTexture other_texture = make_beam_texture(table, 100'000);
    EXPECT_LE(other_texture.cd.size(), 100'000U);
    // Steps of 0.57 degrees beside samples 30 degrees apart: a kink of 2 / 30 of the peak a degree, missed by a quarter step on both axes.
    EXPECT_LT(other_texture.worst_error_of_peak, 0.02);
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

/// 6250 cd = 10 lx at 25 m everywhere between these angles.
CandelaTable even_table(double left_deg, double right_deg, double bottom_deg, double top_deg) {
    return {{left_deg, right_deg}, {bottom_deg, top_deg}, std::vector<double>(4, 6250.0), {}, BetweenSamples::linear_cd};
}

/// Rises from 0 at H = -10 to 6250 cd at H = 10 degrees, the same at every V.
CandelaTable rising_table() { return {{-10, 10}, {-5, 5}, {0, 6250, 0, 6250}, {}, BetweenSamples::linear_cd}; }

double tan_deg(double angle) { return std::tan(radians(angle)); }

glm::dvec4 texture_place(const glm::dmat4& matrix, double x, double y, double z) { return matrix * glm::dvec4(x, y, z, 1.0); }

TEST(ProjectedBeam, WindowIsTheLitPartInTangents) {
    const TangentWindow w = lit_window(even_table(-20, 30, -10, 5));
    EXPECT_NEAR(w.left, tan_deg(-20), 1e-12);
    EXPECT_NEAR(w.right, tan_deg(30), 1e-12);
    EXPECT_NEAR(w.bottom, tan_deg(-10) / std::cos(radians(30)), 1e-12); // y / z of V is largest at the side
    EXPECT_NEAR(w.top, tan_deg(5) / std::cos(radians(30)), 1e-12);
}

TEST(ProjectedBeam, WindowLeavesTheDarkRimOutAndIsNeverWiderThanItsLimits) {
    CandelaTable table{{-60, -10, -5, 5, 10, 60}, {-2, -1, 0, 1, 2}, std::vector<double>(30, 0.0), {}, BetweenSamples::linear_cd};
    table.at(2, 2) = 100.0; // H -5, V 0: light reaches to H -10 and 5, V -1 and 1
    const TangentWindow w = lit_window(table);
    EXPECT_NEAR(w.left, tan_deg(-10), 1e-12);
    EXPECT_NEAR(w.right, tan_deg(5), 1e-12);
    EXPECT_NEAR(w.bottom, tan_deg(-1) / std::cos(radians(10)), 1e-12);
    EXPECT_NEAR(w.top, tan_deg(1) / std::cos(radians(10)), 1e-12);
    const TangentWindow all = lit_window(even_table(-180, 180, -90, 90));
    EXPECT_EQ(std::tuple(all.left, all.right, all.bottom, all.top), std::tuple(-1.4, 1.4, -0.45, 0.36));
}

TEST(ProjectedBeam, TexelsStandAtHalvesFromBelowUpwards) {
    const CandelaTable table = rising_table();
    const ProjectedBeam beam = make_projected_beam(table, {4, 2, 32});
    ASSERT_EQ(beam.lx.size(), 8u);
    const double edge = tan_deg(10); // texel centres at -3/4, -1/4, 1/4 and 3/4 of it
    for (std::size_t row = 0; row < 2; ++row)
        for (std::size_t i = 0; i < 4; ++i) {
            const double h = degrees(std::atan(edge * (-0.75 + 0.5 * static_cast<double>(i))));
            EXPECT_NEAR(static_cast<double>(beam.lx[row * 4 + i]), 10.0 * (h + 10.0) / 20.0, 1e-6) << i;
        }
    EXPECT_EQ(std::tuple(beam.scale_lx, beam.distance_m, beam.bytes()), std::tuple(static_cast<double>(beam.lx[3]), 25.0, 32u));
    CandelaTable other_table = rising_table();
    other_table.cd = {6250, 6250, 0, 0}; // bright below
    const ProjectedBeam other_beam = make_projected_beam(other_table, {3, 2, 32});
    EXPECT_GT(other_beam.lx[1], other_beam.lx[4]);
}

TEST(ProjectedBeam, IsBilinearBetweenTexelsHeldAtTheEdgeAndDarkOutside) {
    ProjectedBeam beam{.width = 2, .height = 2, .lx = {0.0F, 4.0F, 8.0F, 20.0F}};
    EXPECT_EQ(projected_lx(beam, 0.25, 0.25), 0.0);
    EXPECT_EQ(projected_lx(beam, 0.75, 0.25), 4.0);
    EXPECT_EQ(projected_lx(beam, 0.5, 0.25), 2.0);
    EXPECT_EQ(projected_lx(beam, 0.5, 0.5), 8.0);
    EXPECT_EQ(projected_lx(beam, 1.0, 1.0), 20.0);
    EXPECT_EQ(projected_lx(beam, 1.0 + 1e-9, 0.5), 0.0);
    EXPECT_EQ(projected_lx(beam, std::nan(""), 0.5), 0.0);
}

TEST(ProjectedBeam, EightBitsAreStepsOfTheLargestValue) {
    const ProjectedBeam fine = make_projected_beam(rising_table(), {64, 8, 32}), coarse = make_projected_beam(rising_table(), {64, 8, 8});
    ASSERT_EQ(coarse.steps.size(), 512u);
    EXPECT_TRUE(coarse.lx.empty());
    EXPECT_EQ(std::tuple(coarse.scale_lx, coarse.steps[63]), std::tuple(fine.scale_lx, 255));
    for (std::size_t i = 0; i < 512; ++i)
        EXPECT_EQ(coarse.steps[i], std::lround(255.0 * static_cast<double>(fine.lx[i]) / fine.scale_lx));
    EXPECT_LE(coarse.worst_error_of_peak, fine.worst_error_of_peak + 0.5 / 255.0 + 1e-12);
    EXPECT_GT(coarse.worst_error_of_peak, 0.4 / 255.0);
}

TEST(ProjectedBeam, ResolutionErrorIsThatOfAKinkMissedBetweenTexels) {
    // A ridge at H = 0 between two texels, in tangents nearly a triangle: the texels beside it miss its top.
    CandelaTable table{{-1, 0, 1}, {-40, 40}, {0, 6250, 0, 0, 6250, 0}, {}, BetweenSamples::linear_cd};
    const ProjectedBeam beam = make_projected_beam(table, {16, 2, 32});
    EXPECT_NEAR(beam.worst_error_of_peak, 0.5 / 8.0, 2e-4); // half a texel beside it, 8 texels from foot to top
    EXPECT_NEAR(make_projected_beam(table, {64, 2, 32}).worst_error_of_peak, 0.5 / 32.0, 2e-4);
}

TEST(ProjectedBeam, DarkAndBackwardBeamsAreDark) {
    CandelaTable dark = rising_table();
    dark.cd.assign(4, 0.0);
    for (const CandelaTable& table : {dark, even_table(100, 170, -5, 5), even_table(-5, 5, 60, 80)}) {
        const ProjectedBeam beam = make_projected_beam(table, {8, 4, 8});
        EXPECT_EQ(std::tuple(beam.scale_lx, beam.worst_error_of_peak), std::tuple(0.0, 0.0));
        for (const std::uint16_t step : beam.steps)
            EXPECT_EQ(step, 0);
    }
    EXPECT_THROW(make_projected_beam(dark, {0, 4, 32}), std::invalid_argument);
    EXPECT_THROW(make_projected_beam(dark, {4, 16385, 32}), std::invalid_argument);
}

TEST(ProjectedBeam, MatrixPutsTheWindowsCornersOnTheTexturesCorners) {
    const TangentWindow w{-0.5, 1.0, -0.25, 0.125};
    const glm::dmat4 m = texture_from_lamp(w);
    for (const double z : {0.1, 1.0, 25.0}) {
        const glm::dvec4 low = texture_place(m, -0.5 * z, -0.25 * z, z), high = texture_place(m, z, 0.125 * z, z);
        EXPECT_NEAR(low.w, z, 1e-12);
        EXPECT_NEAR(low.x / low.w, 0.0, 1e-12);
        EXPECT_NEAR(low.y / low.w, 0.0, 1e-12);
        EXPECT_NEAR(low.z / low.w, 1.0 - 0.1 / z, 1e-12);
        EXPECT_NEAR(high.x / high.w, 1.0, 1e-12);
        EXPECT_NEAR(high.y / high.w, 1.0, 1e-12);
    }
    const glm::dvec4 axis = texture_place(m, 0.0, 0.0, 10.0);
    EXPECT_NEAR(axis.x / axis.w, 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(axis.y / axis.w, 2.0 / 3.0, 1e-12);
    EXPECT_LT(texture_place(m, 0.0, 0.0, -0.5).w, 0.0);
}

TEST(ProjectedBeam, AsPrintedTheBeamIsTwiceAsWideAtOneMetreAnd4PerCentAt25) {
    const glm::dmat4 m = texture_from_lamp_as_printed({-0.5, 0.5, -0.25, 0.25});
    const glm::dvec4 near = texture_place(m, 1.0, 0.5, 1.0); // twice the half width 0.5 and height 0.25
    EXPECT_NEAR(near.w, 2.0, 1e-12);
    EXPECT_NEAR(near.x / near.w, 1.0, 1e-12);
    EXPECT_NEAR(near.y / near.w, 1.0, 1e-12);
    const glm::dvec4 far = texture_place(m, 12.5 * 1.04, 0.0, 25.0);
    EXPECT_NEAR(far.x / far.w, 1.0, 1e-12);
    EXPECT_GT(texture_place(m, 0.0, 0.0, -0.9).w, 0.0); // behind the lamp, and still passes
}

TEST(ProjectedBeam, ProjectsWhatTheTableSays) {
    const CandelaTable table = lamp_of_model(lamp_models()[0]).table;
    const ProjectedBeam beam = make_projected_beam(table, {2048, 1024, 32});
    const glm::dmat4 m = texture_from_lamp(beam.window);
    for (const double h : {-30.0, -3.0, 1.6, 12.0})
        for (const double v : {-8.0, -3.0, -1.2}) {
            const glm::dvec3 p = 40.0 * glm::dvec3(std::sin(radians(h)), std::tan(radians(v)), std::cos(radians(h)));
            const glm::dvec4 place = texture_place(m, p.x, p.y, p.z);
            EXPECT_NEAR(projected_lx(beam, place.x / place.w, place.y / place.w), intensity_cd(table, h, v) / 625.0,
                        beam.worst_error_of_peak * peak_of(table).cd / 625.0 + 1e-6);
        }
    EXPECT_LT(beam.worst_error_of_peak, 0.1);
}

TEST(ProjectedBeam, OfTheThesisAliasesAtTheCutOff) {
    const CandelaTable table = lamp_of_model(lamp_models()[0]).table;
    const ProjectedBeam old = make_projected_beam(table, {512, 128, 8}), fine = make_projected_beam(table, {1024, 512, 32});
    EXPECT_GT(old.worst_error_of_peak, 0.05);
    EXPECT_LT(fine.worst_error_of_peak, 0.3 * old.worst_error_of_peak); // a quarter of the height: 1/4 to 1/16, kink or curve
}

} // namespace
} // namespace fernlicht
