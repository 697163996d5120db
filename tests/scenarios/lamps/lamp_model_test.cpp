// Our own lamps: files that are what the model writes, with the flux and the edges of common lamps. The rows of their regulations are held
// in tests/metrics/regulation/row_check_test.cpp.
#include "scenarios/lamps/lamp_model.h"
#include "tests/trial.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <iostream>
#include <map>

namespace fernlicht {
namespace {

std::filesystem::path shipped(const std::string& name) {
    return std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/lamps" / (name + ".ies");
}

const CandelaTable& table(const std::string& name) {
    static std::map<std::string, CandelaTable> tables;
    auto [it, added] = tables.try_emplace(name);
    if (added)
        it->second = read_lamp(shipped(name)).table;
    return it->second;
}

TEST(LampModel, ShippedFilesAreWhatTheModelWritesAndSayThatTheyAreAModel) {
    const auto folder = tests::new_folder();
    for (const LampModel& m : lamp_models()) {
        const auto path = folder / (m.name + ".ies");
        write_lamp(lamp_of_model(m), path);
        FilesRead opened;
        EXPECT_TRUE(read_file(path, opened) == read_file(shipped(m.name), opened)) << m.name;
        EXPECT_LT(opened.back().bytes, 1'000'000u);
        const LampFile lamp = read_lamp(shipped(m.name));
        EXPECT_THAT(lamp.labels, testing::Contains(testing::Pair("TEST", testing::HasSubstr("a model, not a measurement"))));
        EXPECT_EQ(lamp.table, lamp_of_model(m).table) << m.name; // no digit is lost
        EXPECT_TRUE(lamp.notes.empty()) << m.name;
    }
}

/// Sharpness: the largest fall of log10 I over 0.1 degrees upwards, and where the steepest point is.
struct Edge {
    double sharpness = 0.0, inflection_v_deg = 0.0;
};
Edge edge_at(const CandelaTable& t, double h) {
    Edge edge;
    for (double v = -2.0; v <= 1.5; v += 0.01) {
        const double fall = std::log10(intensity_cd(t, h, v)) - std::log10(intensity_cd(t, h, v + 0.1));
        if (fall > edge.sharpness)
            edge = {fall, v + 0.05};
    }
    return edge;
}

TEST(LampModel, CutOffIsSharpOnePercentDownAndRisesToTheKerb) {
    for (const std::string lamp : {"halogen-low", "xenon-low", "led-low"}) {
        const Edge edge = edge_at(table(lamp), -2.5);
        EXPECT_GE(edge.sharpness, 0.13) << lamp;
        EXPECT_LE(edge.sharpness, 0.40) << lamp;
        std::cout << fmt::format("    {:12} sharpness G {:.3f}, inflection at V {:.2f}\n", lamp, edge.sharpness, edge.inflection_v_deg);
        for (const double h : {-1.5, -2.5, -3.5}) // linearity: within 0.2 degrees of each other
            EXPECT_NEAR(edge_at(table(lamp), h).inflection_v_deg, -0.57, 0.05) << lamp << h;
        const double at_1 = edge_at(table(lamp), 1.0).inflection_v_deg, at_3 = edge_at(table(lamp), 3.0).inflection_v_deg;
        EXPECT_NEAR(std::atan((at_3 - at_1) / 2.0) * 180.0 / 3.14159265, 15.0, 1.5) << lamp;
        EXPECT_GE(edge_at(table(lamp), 2.0).sharpness, 0.08) << lamp;
        EXPECT_GT(peak_of(table(lamp)).h_deg, 0.0) << lamp;
    }
}

TEST(LampModel, FluxAndMaximaAreThoseOfCommonLamps) {
    const auto expect_between = [](const std::string& lamp, double lm_from, double lm_to, double lx_from, double lx_to) {
        const double flux = flux_lm(table(lamp));
        const Peak peak = peak_of(table(lamp));
        EXPECT_THAT(flux, testing::AllOf(testing::Ge(lm_from), testing::Le(lm_to))) << lamp;
        EXPECT_THAT(peak.cd / 625.0, testing::AllOf(testing::Ge(lx_from), testing::Le(lx_to))) << lamp;
        std::cout << fmt::format("    {:12} {:.0f} lm, {:.1f} lx at 25 m at H {:.2f} V {:.2f}\n", lamp, flux, peak.cd / 625.0, peak.h_deg,
                                 peak.v_deg);
    };
    expect_between("halogen-low", 400, 700, 30, 50);
    expect_between("xenon-low", 900, 1300, 60, 70);
    expect_between("halogen-high", 400, 900, 64, 120);
    expect_between("xenon-high", 900, 1700, 120, 220);
    expect_between("led-low", 1000, 1400, 60, 70);
    expect_between("led-high", 1000, 1700, 100, 220);
    expect_between("laser-spot", 200, 400, 160, 200);
}

TEST(LampModel, TablesFollowTheModelBetweenTheirSamples) {
    for (const LampModel& m : lamp_models()) {
        const CandelaTable& t = table(m.name);
        check_invariants(t);
        const double peak = peak_of(t).cd;
        for (double v = -20.9; v < 16.0; v += 0.173)
            for (double h = -51.9; h < 52.0; h += 0.219)
                ASSERT_NEAR(intensity_cd(t, h, v), model_intensity_cd(m, h, v), 0.01 * peak) << m.name << " H " << h << " V " << v;
    }
}

TEST(LampModel, LightEndsSmoothlyAtTheEdgesOfItsTable) {
    for (const LampModel& m : lamp_models()) {
        const CandelaTable& t = table(m.name);
        for (const double h : t.h_deg)
            EXPECT_EQ(intensity_cd(t, h, t.v_deg.front()) + intensity_cd(t, h, t.v_deg.back()), 0.0);
        for (const double v : t.v_deg)
            EXPECT_EQ(intensity_cd(t, t.h_deg.front(), v) + intensity_cd(t, t.h_deg.back(), v), 0.0);
    }
}

} // namespace
} // namespace fernlicht
