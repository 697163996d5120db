#include "renderer/projected_beam.h"

#include "scenarios/lamps/lamp_model.h"
#include "scenarios/values/pose.h"

#include <cmath>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

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
    EXPECT_EQ(all.left, -1.4);
    EXPECT_EQ(all.right, 1.4);
    EXPECT_EQ(all.bottom, -0.45);
    EXPECT_EQ(all.top, 0.36);
}

TEST(ProjectedBeam, TexelsStandAtHalvesAndHoldLuxAt25Metres) {
    const CandelaTable table = rising_table();
    const ProjectedBeam beam = make_projected_beam(table, {4, 2, 32});
    ASSERT_EQ(beam.lx.size(), 8u);
    const double edge = tan_deg(10); // texel centres at -3/4, -1/4, 1/4 and 3/4 of it
    for (std::size_t row = 0; row < 2; ++row)
        for (std::size_t i = 0; i < 4; ++i) {
            const double h = degrees(std::atan(edge * (-0.75 + 0.5 * static_cast<double>(i))));
            EXPECT_NEAR(static_cast<double>(beam.lx[row * 4 + i]), 10.0 * (h + 10.0) / 20.0, 1e-6) << i;
        }
    EXPECT_EQ(beam.scale_lx, static_cast<double>(beam.lx[3]));
    EXPECT_EQ(beam.distance_m, 25.0);
    EXPECT_EQ(beam.bytes(), 32u);
}

TEST(ProjectedBeam, RowsRunFromBelowUpwards) {
    CandelaTable table = rising_table();
    table.cd = {6250, 6250, 0, 0}; // bright below
    const ProjectedBeam beam = make_projected_beam(table, {3, 2, 32});
    EXPECT_GT(beam.lx[1], beam.lx[4]);
}

TEST(ProjectedBeam, IsBilinearBetweenTexelsHeldAtTheEdgeAndDarkOutside) {
    ProjectedBeam beam;
    beam.width = 2;
    beam.height = 2;
    beam.lx = {0.0F, 4.0F, 8.0F, 20.0F};
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
    EXPECT_EQ(coarse.scale_lx, fine.scale_lx);
    EXPECT_EQ(coarse.steps[63], 255);
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
        EXPECT_EQ(beam.scale_lx, 0.0);
        EXPECT_EQ(beam.worst_error_of_peak, 0.0);
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
