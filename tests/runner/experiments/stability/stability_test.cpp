// Every case of `fernlicht stability`, judged as the command judges it; and the judging itself.
#include "runner/experiments/stability/equations.h"
#include "runner/experiments/stability/trial.h"
#include "runner/write/document.h"
#include "scenarios/light/light.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>

namespace fernlicht {
namespace {

std::string test_name(const testing::TestParamInfo<const StabilityCase*>& info) {
    std::string name = info.param->full_name();
    std::ranges::replace_if(
        name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
    return name;
}

std::vector<const StabilityCase*> all_cases() {
    std::vector<const StabilityCase*> cases;
    for (const StabilityCase& one : stability_cases())
        cases.push_back(&one);
    return cases;
}

class Stability : public testing::TestWithParam<const StabilityCase*> {};

TEST_P(Stability, HoldsItsBound) {
    const TemporaryFolder folder;
    StabilityBench bench("auto", folder.path(), false);
    const StabilityRow row = judge(*GetParam(), bench);
    EXPECT_TRUE(row.passed) << document_text(document(row));
}

INSTANTIATE_TEST_SUITE_P(Cases, Stability, testing::ValuesIn(all_cases()), test_name);

StabilityRow judged(double bound, const StabilityCase::Measure& measure) {
    static StabilityCase one;
    one = {"trial", "case", "nothing", bound, "units", "none", measure};
    StabilityBench bench("auto", "unused", false);
    return judge(one, bench);
}

TEST(StabilityJudging, ComparesWithTheBound) {
    const StabilityRow row = judged(1.0, [](auto&, Found& worst) {
        worst.add(1.0, "here");
        worst.add(0.5, "there", 400);
    });
    EXPECT_TRUE(row.passed);
    EXPECT_THAT(document_text(document(row)), testing::HasSubstr("judged:  401 pixels"));
    EXPECT_FALSE(judged(1.0, [](auto&, Found& worst) { worst.add(1.0000001, "here"); }).passed);
    EXPECT_TRUE(judged(0.0, [](auto&, Found& worst) { worst.add(0.0, "here"); }).passed);
}

TEST(StabilityJudging, WhatIsNoNumberFails) {
    EXPECT_FALSE(judged(1e300, [](auto&, Found& worst) { worst.add(std::numeric_limits<double>::quiet_NaN(), "here"); }).passed);
    EXPECT_FALSE(judged(1e300, [](auto&, Found& worst) { worst.add(std::numeric_limits<double>::infinity(), "here"); }).passed);
    const StabilityRow thrown = judged(1.0, [](auto&, Found&) { throw std::logic_error("a bug"); });
    EXPECT_FALSE(thrown.passed);
    EXPECT_EQ(thrown.found.where, "thrown: a bug");
    StabilityResult result;
    result.rows = {thrown};
    EXPECT_THAT(document_text(document(result)), testing::HasSubstr("1 case: 0 pass, 1 fail: trial/case"));
}

TEST(StabilityJudging, TheWorstTrialStays) {
    Found worst;
    worst.add(1.0, "a");
    worst.add(3.0, "b");
    worst.add(2.0, "c");
    EXPECT_EQ(worst.where, "b");
    worst.add(std::numeric_limits<double>::quiet_NaN(), "d");
    worst.add(9.0, "e");
    EXPECT_EQ(worst.where, "d");
    EXPECT_TRUE(std::isnan(worst.error));
}

TEST(StabilityCases, HaveNamesOfTheirOwnAndReasons) {
    std::set<std::string> names;
    for (const StabilityCase& one : stability_cases()) {
        EXPECT_TRUE(names.insert(one.full_name()).second) << one.full_name();
        EXPECT_GT(one.reason.size(), 20U) << one.full_name();
        EXPECT_GT(one.could_break.size(), 10U) << one.full_name();
        EXPECT_FALSE(one.unit.empty()) << one.full_name();
    }
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

TEST(StabilityEquations, AreAllExaminedAndSayWhatIsHeld) {
    const std::vector<std::string> lines = lines_of(content_of(FERNLICHT_SOURCE_DIR "/scenarios/photometry.glsl"));
    std::set<std::string> examined;
    for (const Equation& equation : equations())
        examined.insert(equation.function);
    std::size_t functions = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        if (!lines[i].starts_with("FN "))
            continue;
        ++functions;
        const std::size_t name = lines[i].find(' ', 3) + 1;
        const std::string function = lines[i].substr(name, lines[i].find('(') - name);
        EXPECT_TRUE(examined.contains(function)) << function;
        EXPECT_EQ(lines[i - 1], "// " + bound_of(function).comment()) << "beside " << function;
    }
    EXPECT_EQ(functions, equation_bounds().size());
    EXPECT_EQ(examined.size(), functions);
}

TEST(StabilityEquations, AreCalledByTheirNumbers) {
    // E = I / d^2 from 1 mm to 10 km, by the twin, too; the dark end of the sRGB curve: 12.92 c.
    Moment moment;
    moment.lamps = {stability::lamp(stability::constant_table(1000.0), {})};
    for (double d = 1e-3; d < 1.01e4; d *= 1.1) {
        const double truth = 1000.0 / (d * d);
        EXPECT_DOUBLE_EQ(equation_in_double(10, {1000.0, 0.0, 0.0, 0.0, 0.0, d, 0.0})[0], truth);
        EXPECT_NEAR(target_illuminance_lx(moment, {d, 0.0, 0.0}) / truth, 1.0, 1e-14) << d; // some 20 roundings of a double
        EXPECT_NEAR(surface_illuminance_lx(moment, {d, 0.0, 0.0}, {-1.0, 0.0, 0.0}) / truth, 1.0, 1e-14) << d;
    }
    EXPECT_DOUBLE_EQ(equation_in_double(28, {0.001})[0], 0.01292);
    EXPECT_EQ(equation_in_float(10, {3.0F, 0.0F, 0.0F, 0.0F, 0.0F, 2.0F, 0.0F})[0], 0.75F);
    Device device = open_device("auto");
    EquationProbe probe(device, 10);
    std::vector<EquationArguments> points(70'000); // more than one draw takes
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = {static_cast<float>(i), 0.0F, 0.0F, 0.0F, 0.0F, 2.0F, 0.0F};
    const std::vector<EquationValue> values = probe.at(points);
    ASSERT_EQ(values.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_EQ(values[i][0], 0.25F * static_cast<float>(i));
}

/// In float, 1 + x loses what is below half a unit: the search must find that, far from where it begins.
TEST(StabilityEquations, TheSearchFindsWhatFloatsLose) {
    Device device = open_device("auto");
    const auto examination = [&] { return examine(equations()[26], device, 0.2, 1); }; // log(1 + s x) / log(1 + s)
    const Examination found = examination();
    EXPECT_GT(found.in_float.error, 1e-7);
    EXPECT_LT(found.in_float.error, 1e-6);
    EXPECT_EQ(found.in_float.at, examination().in_float.at) << "same seed, same search";
}

/// Any floats there are, infinities, denormals and what is no number among them: a wider processor computes the same bits.
TEST(StabilityEquations, AreTheSameBitsInPacksOfEachWidth) {
    std::mt19937 random(5);
    std::vector<EquationArguments> points(3001);
    for (EquationArguments& point : points)
        for (float& argument : point)
            argument = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & (random() % 4 == 0 ? 0xff800000U : 0xffffffffU));
    const auto bits_of = [](float value) { return std::isnan(value) ? ~0U : std::bit_cast<std::uint32_t>(value); };
    for (const Equation& equation : equations()) {
        const std::vector<EquationValue> narrow = equation_in_packs(packs::Level::plain, equation.number, points);
        for (const packs::Level level : packs::levels_here()) {
            const std::vector<EquationValue> wide = equation_in_packs(level, equation.number, points);
            for (std::size_t i = 0; i < points.size(); ++i)
                for (std::size_t k = 0; k < 4; ++k)
                    ASSERT_EQ(bits_of(wide[i][k]), bits_of(narrow[i][k])) << equation.function << " at point " << i;
        }
    }
}

/// Sun and fog where they are hardest, on a road with a board across it.
class StabilityWeather : public testing::Test {
  protected:
    StabilityWeather() {
        stability::add_sheet(scene, "road", 0, {-50.0, -50.0, 0.0}, {150.0, 0.0, 0.0}, {0.0, 100.0, 0.0});
        stability::add_sheet(scene, "board", 1, {30.0, 3.0, 0.0}, {0.0, -6.0, 0.0}, {0.0, 0.0, 3.0});
    }

    const View ahead = stability::camera({1.3, 0.35, 1.2}, 0.0, -0.02, 30.0, 24, 16);
    Scene scene = stability::empty_scene();
    Device device = open_device("auto");
};

/// At and below the horizon, at the zenith, faint as nothing and brightest.
TEST_F(StabilityWeather, SunEverywhere) {
    Renderer renderer(device, scene, stability::unshadowed());
    for (const double elevation_deg : {90.0, 89.999, 30.0, 0.01, 0.0, -0.01, -30.0})
        for (const double azimuth_deg : {0.0, 90.0, 359.999})
            for (const double lx : {1e-6, 0.2, 150'000.0}) {
                Moment moment;
                moment.daylight.sun = {radians(azimuth_deg), radians(elevation_deg), lx};
                const stability::AgainstTwin against = stability::against_twin(renderer, scene, moment, ahead);
                EXPECT_LE(against.error(), 1.0) << lx << " lx at " << elevation_deg << ", azimuth " << azimuth_deg << "; " << against.where;
            }
}

/// All that is drawn is a number, from within a lamp too, and without lamps and sky the air is black.
TEST_F(StabilityWeather, FogOfAllDensities) {
    Renderer renderer(device, scene, stability::unshadowed());
    const CandelaTable table = stability::cut_off_table();
    for (const double extinction : {1e-9, 1e-4, 0.03, 1.0, 10.0})
        for (const double g : {0.0, 0.9})
            for (const glm::dvec3& at : {glm::dvec3(3.4, 0.6, 0.65), glm::dvec3(1.3, 0.35, 1.2), glm::dvec3(25.0, 0.35, 1.2)}) {
                Moment moment;
                moment.weather = {extinction, 1.0, g, 0.0};
                moment.lamps = {stability::lamp(table, at)};
                const Frame lit = renderer.draw(moment, ahead, {.luminance = true});
                moment.lamps.clear();
                const Frame dark = renderer.draw(moment, ahead, {.luminance = true});
                const auto is_light = [](float cdm2) { return std::isfinite(cdm2) && cdm2 >= 0.0F; };
                EXPECT_TRUE(std::ranges::all_of(lit.luminance_cdm2.pixels(), is_light)) << extinction << " " << g << " " << at.x;
                EXPECT_TRUE(std::ranges::all_of(dark.luminance_cdm2.pixels(), [](float cdm2) { return cdm2 == 0.0F; })) << extinction;
            }
}

TEST(StabilityCommand, TriesWhatItIsAskedFor) {
    const std::string said = printed("stability --only 'table/p*' --json");
    const auto rows = nlohmann::json::parse(said).at("rows");
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].at("case"), "table/poles");
    EXPECT_EQ(rows[0].at("verdict"), "pass");
    EXPECT_LE(rows[0].at("error").get<double>(), rows[0].at("bound").get<double>());
}

TEST(StabilityCommand, RefusesAPatternThatFitsNothing) {
    EXPECT_THAT(printed("stability --only table/pole", 2), testing::HasSubstr("expected table/poles"));
}

} // namespace
} // namespace fernlicht
