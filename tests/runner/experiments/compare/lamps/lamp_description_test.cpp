#include "runner/experiments/compare/lamps/lamp_description.h"

#include "runner/findings/plots/isocandela.h"
#include "runner/write/plots/png.h"
#include "runner/write/plots/svg.h"
#include "scenarios/lamps/lamp_model.h"
#include "scenarios/values/pose.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The same 625 cd everywhere between these edges.
LampFile even_lamp(double h_deg, double v_deg) {
    LampFile lamp;
    lamp.name = "even";
    lamp.format = "test";
    for (int i = -10; i <= 10; ++i) {
        lamp.table.h_deg.push_back(h_deg * i / 10.0);
        lamp.table.v_deg.push_back(v_deg * i / 10.0);
    }
    lamp.table.cd.assign(21 * 21, 625.0);
    return lamp;
}

TEST(LampDescription, WholeSphereHasFourPiTimesItsIntensityAndNothingOutside) {
    const LampDescription d = describe(even_lamp(180.0, 90.0));
    EXPECT_NEAR(d.flux_lm, 4.0 * pi * 625.0, 1e-6);
    EXPECT_NEAR(d.covered_share, 1.0, 1e-12);
    EXPECT_EQ(d.edge_cd, 0.0);
    EXPECT_THAT(text_of(d), HasSubstr("covers every direction"));
    EXPECT_THAT(text_of(d), HasSubstr("625 cd = 1 lx at 25 m"));
}

TEST(LampDescription, ADarkLampIsDescribedInNumbers) {
    LampFile lamp = even_lamp(10.0, 10.0);
    lamp.table.cd.assign(21 * 21, 0.0);
    lamp.declared_flux_lm = 1000.0; // so that no number may be missing
    const LampDescription d = describe(lamp);
    EXPECT_EQ(d.flux_lm, 0.0);
    const std::string text = text_of(d) + json_of(d);
    for (const char* none : {"nan", "null", " inf"})
        EXPECT_THAT(text, Not(HasSubstr(none)));
}

TEST(LampDescription, LightThatEndsAtTheTablesEdgeIsTold) {
    const LampDescription d = describe(even_lamp(30.0, 10.0));
    EXPECT_EQ(d.edge_cd, 625.0);
    EXPECT_NEAR(d.covered_share, 2.0 * std::sin(radians(10.0)) * radians(60.0) / (4.0 * pi), 1e-12);
    EXPECT_THAT(text_of(d), HasSubstr("up to 625 cd (100 % of the peak)"));
    EXPECT_EQ(d.h_finest_deg, 3.0);
}

TEST(LampDescription, AGapIsAnEdgeInside) {
    LampFile lamp = even_lamp(30.0, 10.0);
    CandelaTable& t = lamp.table;
    for (std::size_t i = 0; i < 21; ++i)
        t.at(0, i) = t.at(20, i) = t.at(i, 0) = t.at(i, 20) = 0.0;
    EXPECT_EQ(describe(lamp).edge_cd, 0.0);
    t.gaps.assign(20 * 20, 0);
    t.gaps[10 * 20 + 10] = 1;
    const LampDescription d = describe(lamp);
    EXPECT_EQ(d.edge_cd, 625.0);
    EXPECT_EQ(d.gap_cells, 1u);
    EXPECT_THAT(text_of(d), HasSubstr("1 cells without data"));
}

TEST(LampDescription, DeclaredFluxStandsBesideTheIntegratedOne) {
    LampFile lamp = even_lamp(180.0, 90.0);
    EXPECT_THAT(text_of(describe(lamp)), HasSubstr("the file declares none"));
    EXPECT_TRUE(nlohmann::json::parse(json_of(describe(lamp)))["declared_flux_lm"].is_null());
    lamp.declared_flux_lm = 10000.0;
    EXPECT_THAT(text_of(describe(lamp)), HasSubstr("declares 10000 lm of its light source (78.5 %)"));
    EXPECT_EQ(nlohmann::json::parse(json_of(describe(lamp)))["declared_flux_lm"], 10000.0);
}

TEST(LampDescription, JsonHoldsHostileLabels) {
    LampFile lamp = even_lamp(30.0, 10.0);
    lamp.labels = {{"TEST", "a \"quoted\" \x1b[31m text \xff"}};
    lamp.notes = {"angles descend: sorted"};
    const auto j = nlohmann::json::parse(json_of(describe(lamp)));
    EXPECT_EQ(j["labels"][0]["key"], "TEST");
    EXPECT_EQ(j["notes"][0], "angles descend: sorted");
    EXPECT_EQ(j["peak"]["cd"], 625.0);
    EXPECT_THAT(text_of(describe(lamp)), Not(HasSubstr("\x1b")));
}

TEST(IsocandelaDiagram, ShowsTheBeamWithItsLines) {
    const LampFile lamp = lamp_of_model(lamp_models().front());
    const plots::Figure f = plots::isocandela_diagram(lamp.table, lamp.name);
    EXPECT_LT(f.x.from, -15.0);
    EXPECT_GT(f.x.to, 15.0);
    EXPECT_LT(f.y.from, -5.0);
    EXPECT_TRUE(f.equal_units);
    std::vector<std::string> labels;
    for (const plots::Isoline& line : f.isolines) {
        labels.push_back(line.label);
        EXPECT_FALSE(line.lines.empty()) << line.label;
    }
    EXPECT_THAT(labels, testing::IsSupersetOf({"0.5 lx", "1 lx", "5 lx", "20 lx"}));
    // Above the left cut-off it is darker than below it.
    const Image<plots::Colour>& pixels = *f.rasters.front().pixels;
    const auto at = [&](double h, double v) {
        return plots::luminance(pixels.at(static_cast<int>((h - f.x.from) / (f.x.to - f.x.from) * pixels.width()),
                                          static_cast<int>((f.y.to - v) / (f.y.to - f.y.from) * pixels.height())));
    };
    EXPECT_LT(at(-5.0, 1.0), at(-5.0, -2.0));
    EXPECT_LT(at(-5.0, 0.3), at(5.0, 0.3)); // the rise is on the kerb side, right
}

TEST(IsocandelaDiagram, ADarkLampIsAnEmptyDiagramThatSaysSo) {
    LampFile lamp = even_lamp(30.0, 10.0);
    lamp.table.cd.assign(lamp.table.cd.size(), 0.0);
    EXPECT_THAT(plots::svg_of(plots::isocandela_diagram(lamp.table, "dark")), HasSubstr("no light in any direction"));
}

TEST(IsocandelaDiagram, OutsideTheTableIsGrey) {
    const LampFile lamp = even_lamp(3.0, 3.0);
    const plots::Figure f = plots::isocandela_diagram(lamp.table, "small", plots::AngleWindow{-10.0, 10.0, -10.0, 10.0});
    const Image<plots::Colour>& pixels = *f.rasters.front().pixels;
    EXPECT_EQ(pixels.at(0, 0), (plots::Colour{225, 225, 225}));
    EXPECT_NE(pixels.at(pixels.width() / 2, pixels.height() / 2), (plots::Colour{225, 225, 225}));
}

} // namespace
} // namespace fernlicht
