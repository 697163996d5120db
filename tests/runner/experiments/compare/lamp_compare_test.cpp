// Two lamps against each other, through the program.
#include "metrics/beam/lamp_difference.h"
#include "runner/experiments/compare/lamps/lamp_comparison.h"
#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/files/picture_file.h"
#include "scenarios/lamps/lamp_file.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct LampCompare : ::testing::Test {
    TemporaryFolder folder;
    std::string halogen = library_file("lamps/halogen-low.ies"), xenon = library_file("lamps/xenon-low.ies");

    static json json_of(const std::string& arguments) {
        const Outcome outcome = run_program(arguments + " --json");
        EXPECT_LE(outcome.exit_code, 1) << outcome.output;
        return json::parse(outcome.output);
    }
    static json fact(const json& found, const std::string& name) { return tests::entry(found.at("facts"), "name", name); }
};

TEST_F(LampCompare, SaysWhatTheCommandsOfOneLampSay) {
    const json found = tests::checked(printed("compare " + halogen + " " + xenon + " --regulation r112-b --json"), lamps_members);
    EXPECT_EQ(found.at("difference"), json_of("lamp " + xenon + " --against " + halogen));
    const json before = json_of("lamp " + halogen), now = json_of("lamp " + xenon);
    EXPECT_EQ(fact(found, "flux_lm").at("old_value"), before.at("flux_lm"));
    EXPECT_EQ(fact(found, "flux_lm").at("new_value"), now.at("flux_lm"));
    const auto edge = [&](const std::string& lamp) {
        return json_of("lamp " + lamp + " --cut-off").at("level").at(1).at("inflection_v_deg").get<double>();
    };
    EXPECT_DOUBLE_EQ(fact(found, "cut_off_v_deg").at("change").get<double>(), edge(xenon) - edge(halogen));
    const json rows = json_of("lamp " + xenon + " --regulation r112-b").at("rows");
    ASSERT_EQ(rows.size(), found.at("regulation").at("rows").size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(found.at("regulation").at("rows").at(i).at("id"), rows.at(i).at("id"));
        EXPECT_EQ(found.at("regulation").at("rows").at(i).at("new_margin"), rows.at(i).at("margin"));
    }
    EXPECT_EQ(found.at("passed"), true);
}

/// Where neither a turn nor a moved cut-off explains what differs, it still says how far apart the cut-offs lie.
TEST_F(LampCompare, CutOffsThatLieApartAreToldBesideOtherDifferences) {
    const LampFile other = read_lamp(halogen);
    LampFile lamp = read_lamp(library_file("lamps/led-low.ies"));
    const auto said = [&] { return sentences_of(difference_of(lamp, other, 0.0)); };
    EXPECT_THAT(said(), Not(testing::Contains(HasSubstr("its cut-off lies")))) << "both at 0.57 D";
    for (double& v_deg : lamp.table.v_deg)
        v_deg += 0.2;
    EXPECT_THAT(said(), testing::Contains(testing::ContainsRegex(
                            "its cut-off lies 0.(19|20|21) degrees higher; all else is told with both cut-offs at one height")));
}

/// Our halogen lamp made brighter keeps its own name: the files tell them apart.
TEST_F(LampCompare, CallsLampsByTheirFiles) {
    const std::string brighter = folder / "brighter.ies";
    ASSERT_EQ(run_program("lamp " + halogen + " --scale 1.05 --convert " + brighter).exit_code, 0);
    const std::string old_name = "halogen-low.ies (halogen low beam (model))", new_name = "brighter.ies (halogen low beam (model))";
    const Outcome outcome = run_program("compare " + halogen + " " + brighter + " --out " + (folder / "named"));
    for (const std::string& text :
         {outcome.output, content_of(folder / "named/report.html"), content_of(folder / "named/figures/isocandela-overlay.svg")})
        EXPECT_THAT(text, AllOf(HasSubstr(old_name), HasSubstr(new_name)));
    EXPECT_THAT(run_program("lamp " + brighter + " --against " + halogen).output,
                AllOf(HasSubstr("lamp           " + new_name), HasSubstr("against        " + old_name), HasSubstr("±")));
}

TEST_F(LampCompare, ALampIsLikeItself) {
    const json found = json_of("compare " + xenon + " " + xenon);
    EXPECT_EQ(found.at("difference").at("differs"), false);
    for (const json& one : found.at("facts"))
        if (!one.at("change").is_null()) {
            EXPECT_EQ(one.at("change"), 0.0) << one;
        }
}

// 5 % more light: orange wherever there is light, blue nowhere; a margin above a minimum grows by 5 % of what is found.
TEST_F(LampCompare, DrawsMoreLightOrange) {
    const std::string brighter = folder / "brighter.ies";
    ASSERT_EQ(run_program("lamp " + halogen + " --scale 1.05 --convert " + brighter).exit_code, 0);
    const Outcome outcome = run_program("compare " + halogen + " " + brighter + " --regulation r112-b --out " + (folder / "out"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const json found = json::parse(content_of(folder / "out/compare.json"));
    EXPECT_NEAR(found.at("difference").at("level_share").at("value").get<double>(), 0.05, 1e-3);
    EXPECT_NEAR(fact(found, "peak_cd").at("change").get<double>(), 0.05 * fact(found, "peak_cd").at("old_value").get<double>(), 1.0);
    EXPECT_NEAR(fact(found, "cut_off_v_deg").at("change").get<double>(), 0.0, 0.002) << "digits of the files";
    for (const json& row : found.at("regulation").at("rows"))
        if (row.at("id") == "50V") { // at least 5100 cd
            EXPECT_NEAR(row.at("new_margin").get<double>() + 1.0, 1.05 * (row.at("old_margin").get<double>() + 1.0), 1e-3);
        }
    const Image<Rgb8> picture = read_png(folder / "out/figures/difference.png");
    std::size_t orange = 0, blue = 0;
    for (int y = picture.height() / 4; y < picture.height() * 3 / 4; ++y)
        for (int x = picture.width() / 10; x < picture.width() * 8 / 10; ++x) { // without the colour bar
            orange += picture.at(x, y).r > picture.at(x, y).b + 40 ? 1U : 0U;
            blue += picture.at(x, y).b > picture.at(x, y).r + 40 ? 1U : 0U;
        }
    EXPECT_GT(orange, 10'000U);
    EXPECT_EQ(blue, 0U);
    for (const json& figure : found.at("figures"))
        for (const char* form : {"svg", "png"})
            EXPECT_GT(std::filesystem::file_size(folder / ("out/" + figure.at(form).get<std::string>())), 2000U) << figure;
    EXPECT_EQ(found.at("figures").size(), 5U);
    EXPECT_THAT(content_of(folder / "out/report.html"), AllOf(HasSubstr("brighter all over"), HasSubstr("B50L"), Not(HasSubstr("{{"))));
    EXPECT_THAT(content_of(folder / "out/compare.csv"), HasSubstr("r112-b,50V,cd,"));
}

TEST_F(LampCompare, ALampThatFailsGivesOne) {
    const std::string high = library_file("lamps/halogen-high.ies");
    const Outcome outcome = run_program("compare " + halogen + " " + high + " --regulation r112-b");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.output, HasSubstr("verdict  A pass, B fail"));
    EXPECT_EQ(run_program("compare " + high + " " + halogen + " --regulation r112-b").exit_code, 0) << "B is judged";
}

TEST_F(LampCompare, BeamTexturesAreLampsWhereTheUserSaysSo) {
    const std::string texture = folder / "beam.exr";
    ASSERT_EQ(run_program("lamp " + xenon + " --convert " + texture).exit_code, 0);
    EXPECT_EQ(run_program("compare " + xenon + " " + texture + " --as-lamps").exit_code, 0);
    EXPECT_EQ(run_program("compare " + xenon + " " + texture).exit_code, 2);
}

TEST_F(LampCompare, WrongInputIsOneSentenceAndTwo) {
    const auto refused = [&](const std::string& arguments, const std::string& words) {
        const Outcome outcome = run_program("compare " + arguments);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
        EXPECT_THAT(outcome.output, HasSubstr(words));
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    };
    const std::string black = folder / "black.png";
    write_png(Image<Rgb8>(8, 8), black);
    std::ofstream(folder / "text.ies") << "no lamp";
    refused(halogen + " " + black, "is a picture, expected a lamp file");
    refused(black + " " + halogen, "expected a picture as A is");
    refused(folder.path().string() + " " + halogen, "expected a folder as A is");
    refused(halogen + " " + xenon + " --strictness identical", "--strictness: found beside what it says nothing of");
    refused(halogen + " " + xenon + " --regulation r112-x", "found 'r112-x', expected 'r112-a'");
    refused(halogen + " " + xenon + " --noise 200%", "--noise");
    refused(halogen + " " + (folder / "text.ies"), "text.ies");
    refused(black + " " + black + " --regulation r112-b", "two lamps");
}

} // namespace
} // namespace fernlicht
