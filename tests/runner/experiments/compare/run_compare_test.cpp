// Two runs' folders against each other, through the program.
#include "runner/experiments/compare/runs/run_comparison.h"
#include "tests/runner/program.h"
#include "tests/runner/run_readings.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Six moments of the straight, two of them stored, with two lamps; the first lamp twice.
class RunCompare : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        play("halogen", library_file("drives/straight.yaml"), "--lamp " + library_file("lamps/halogen-low.ies"));
        play("again", library_file("drives/straight.yaml"), "--lamp " + library_file("lamps/halogen-low.ies"));
        play("xenon", library_file("drives/straight.yaml"), "--lamp " + library_file("lamps/xenon-low.ies"));
    }
    static void TearDownTestSuite() {
        delete folder_;
        folder_ = nullptr;
    }
    static void play(const std::string& name, const std::string& drive, const std::string& more,
                     const std::string& size = "--resolution 96x72 --frames 0:5") {
        const Outcome run = run_program(fmt::format("run {} {} {} --no-accuracy --quiet --out {}", drive, more, size, at(name)));
        ASSERT_EQ(run.exit_code, 0) << run.output;
    }
    static std::string at(const std::string& name) { return *folder_ / name; }
    static Outcome compare(const std::string& a, const std::string& b, const std::string& more = "") {
        return run_program("compare " + at(a) + " " + at(b) + " " + more);
    }
    static json report_of(const std::string& run) { return json::parse(content_of(at(run) + "/report.json")); }
    static double row(const std::string& run, const std::string& name) { return tests::reading_of(at(run), name); }
    static json change_in(const json& drive, const std::string& reading) { return tests::entry(drive.at("changes"), "reading", reading); }
    /// The drive that was played, something in it put otherwise.
    static std::string edited(const std::string& run, const std::string& from, const std::string& to) {
        std::string drive = content_of(at(run) + "/straight-1.yaml");
        const std::size_t place = drive.find(from);
        if (place == std::string::npos) {
            ADD_FAILURE() << from;
            return {};
        }
        std::ofstream(at("edited.yaml")) << drive.replace(place, from.size(), to);
        return at("edited.yaml");
    }
    static TemporaryFolder* folder_;
};
TemporaryFolder* RunCompare::folder_ = nullptr;

std::string joined(const json& texts) {
    std::string all;
    for (const json& text : texts)
        all += text.get<std::string>() + "; ";
    return all;
}

TEST_F(RunCompare, EveryChangeIsThatOfTheReports) {
    const Outcome outcome = compare("halogen", "xenon", "--json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const json found = tests::checked(outcome.output, runs_members);
    EXPECT_EQ(found.at("kind"), "runs");
    const std::string before = "halogen", now = "xenon";
    const json drive = found.at("drives").at(0);
    EXPECT_EQ(drive.at("old_lamp_set"), "halogen-low");
    EXPECT_EQ(drive.at("new_lamp_set"), "xenon-low");
    EXPECT_GT(drive.at("changes").size(), 100U);
    for (const json& change : drive.at("changes")) {
        if (!change.at("change").is_number()) // not measured, or a bound
            continue;
        const std::string name = change.at("reading");
        ASSERT_EQ(change.at("old_value"), row(before, name)) << name;
        ASSERT_EQ(change.at("new_value"), row(now, name)) << name;
        EXPECT_EQ(change.at("change").get<double>(), row(now, name) - row(before, name)) << name;
    }
    // The rule of docs/studies.md, by the reports' own rows.
    const auto open = [](const std::string& run) {
        return row(run, "reach_1lx_road_own_grid_error_m") + row(run, "reach_1lx_road_own_twin_difference_m");
    };
    const json reach = change_in(drive, "reach_1lx_road_own_m");
    EXPECT_NEAR(reach.at("uncertainty").get<double>(), std::hypot(open(before), open(now)), 1e-12);
    EXPECT_EQ(reach.at("kind"), "real");                                            // 29.3 m and 33.3 m, 0.2 m by aim
    EXPECT_EQ(change_in(drive, "reach_1lx_target_own_m").at("kind"), "within aim"); // 1.1 m, 7.4 m by aim
    EXPECT_EQ(found.at("largest_changes").size(), 3U);
    EXPECT_THAT(joined(found.at("drives").at(0).at("left_out")), IsEmpty());
    ASSERT_EQ(drive.at("settings").size(), 2U) << "the files of two lamps";
    EXPECT_EQ(drive.at("settings").at(0).at("key"), "lamps.left.file");
    for (const json& time : drive.at("times"))
        EXPECT_EQ(time.at("kind"), "not known") << "too few frames";
    // The frames' figures are those of comparing the files themselves.
    const json picture = json::parse(compare("halogen/frames/straight-1-halogen-low/driver-000000.exr",
                                             "xenon/frames/straight-1-xenon-low/driver-000000.exr", "--vertical-fov 40 --json")
                                         .output);
    bool seen = false;
    for (const json& frame : drive.at("frames"))
        if (frame.at("view") == "driver" && frame.at("frame") == 0 && frame.at("new_file").get<std::string>().ends_with(".exr")) {
            EXPECT_EQ(frame.at("layers"), picture.at("layers"));
            seen = true;
        }
    EXPECT_TRUE(seen);
}

TEST_F(RunCompare, DetectionDistancesAreKnownToAStepAsInStudies) {
    const std::string drive = edited("halogen", "measure:\n", "measure:\n  visibility: {step_m: 2}\n");
    play("seen", drive, "");
    play("seen-xenon", drive, "--lamp " + library_file("lamps/xenon-low.ies"));
    const json found = json::parse(compare("seen", "seen-xenon", "--json").output);
    const json change = change_in(found.at("drives").at(0), "detection_card_own_m");
    EXPECT_NEAR(change.at("uncertainty").get<double>(), std::hypot(2.0, 2.0), 1e-12);
    EXPECT_NE(change.at("kind"), "not known");
}

TEST_F(RunCompare, TheSameRunTwiceDiffersInNothing) {
    const Outcome outcome = compare("halogen", "again", "--strictness identical --out " + at("same"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, AllOf(HasSubstr(" 0 changed for real"), HasSubstr("strictness identical: pass")));
    const json found = json::parse(content_of(at("same/compare.json")));
    EXPECT_THAT(found.at("largest_changes"), IsEmpty());
    for (const json& change : found.at("drives").at(0).at("changes"))
        EXPECT_EQ(change.at("kind"), change.at("change").is_null() ? "not known" : "no difference") << change;
    for (const json& frame : found.at("drives").at(0).at("frames")) {
        EXPECT_EQ(frame.at("equal"), true);
        EXPECT_THAT(frame.at("pictures"), IsEmpty()) << "nothing to see in what is the same";
    }
    EXPECT_THAT(content_of(at("same/report.html")), HasSubstr("No pixel of any stored frame differs"));
}

// Three plays that scatter by 2 m: Student's t of two degrees of freedom, two-sided, 5 %, is 4.3027 (any table of it).
TEST_F(RunCompare, RepeatsOfARunWidenWhatIsLeftOpen) {
    std::filesystem::copy(at("xenon"), at("scattered"), std::filesystem::copy_options::recursive);
    json report = report_of("xenon");
    report.at("drives").at(0).at("repeats") = {
        {"count", 3},
        {"differ", {"readings"}},
        {"spread", {{{"name", "reach_1lx_road_own_m"}, {"frame", nullptr}, {"count", 3}, {"mean", 33.0}, {"variance", 4.0}}}}};
    std::ofstream(at("scattered/report.json")) << report;
    const json whole = json::parse(compare("halogen", "xenon", "--json").output),
               found = json::parse(compare("halogen", "scattered", "--json").output);
    const json before = change_in(whole.at("drives").at(0), "reach_1lx_road_own_m"),
               now = change_in(found.at("drives").at(0), "reach_1lx_road_own_m");
    EXPECT_NEAR(now.at("uncertainty").get<double>(), std::hypot(before.at("uncertainty").get<double>(), 4.3027 * 2.0), 1e-3);
    EXPECT_EQ(before.at("kind"), "real");
    EXPECT_EQ(now.at("kind"), "no difference"); // 3.9 m
    EXPECT_EQ(change_in(found.at("drives").at(0), "area_1lx_road_all_m2"), change_in(whole.at("drives").at(0), "area_1lx_road_all_m2"));
}

TEST_F(RunCompare, DrawsAsManyMomentsAsAskedFor) {
    const auto drawn = [&](const std::string& pictures) {
        const std::string out = at("drawn-" + pictures);
        EXPECT_EQ(compare("halogen", "xenon", "--pictures " + pictures + " --out " + out).exit_code, 0);
        std::set<int> moments;
        const json found = json::parse(content_of(out + "/compare.json"));
        for (const json& frame : found.at("drives").at(0).at("frames"))
            if (frame.at("view") == "driver" && !frame.at("pictures").empty())
                moments.insert(frame.at("frame").get<int>());
        return moments.size();
    };
    EXPECT_EQ(drawn("0"), 0U);
    EXPECT_EQ(drawn("1"), 1U);
}

TEST_F(RunCompare, StrictnessHoldsForEveryFrame) {
    const Outcome outcome = compare("halogen", "xenon", "--strictness same-light");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.output, AllOf(HasSubstr("FAIL driver"), HasSubstr("strictness same-light: FAIL")));
    EXPECT_THAT(outcome.output, ContainsRegex("    illuminance.lx: .*: [0-9.e+-]+ of [0-9.e+-]+ .*too much, farthest at [0-9]+, [0-9]+"));
}

TEST_F(RunCompare, WhatDoesNotBelongTogetherIsLeftOutAndNamed) {
    const std::string lamp = "--lamp " + library_file("lamps/halogen-low.ies");
    play("small", library_file("drives/straight.yaml"), lamp, "--resolution 64x48 --frames 0:3");
    json drive = json::parse(compare("halogen", "small", "--json").output).at("drives").at(0);
    EXPECT_THAT(joined(drive.at("left_out")),
                AllOf(HasSubstr("pictures of the view driver: another resolution, 96 x 72 and 64 x 48 pixels"),
                      HasSubstr("A played 6 moments and B 4")));
    EXPECT_THAT(drive.at("changes"), IsEmpty()) << "medians of other moments";
    EXPECT_FALSE(drive.at("frames").empty());
    for (const json& frame : drive.at("frames"))
        EXPECT_EQ(frame.at("view"), "map");
    // A class of strictness that not all was held to is not kept.
    const Outcome judged = compare("halogen", "small", "--strictness same-picture");
    EXPECT_EQ(judged.exit_code, 1);
    EXPECT_THAT(judged.output, HasSubstr("not held to the strictness: straight-1_halogen-low: pictures of the view driver"));

    std::filesystem::rename(edited("halogen", "l_max_cdm2: 100", "l_max_cdm2: 50"), at("straight-1.yaml"));
    play("darker", edited(".", "target_height_m: 0.25", "target_height_m: 0.5"), "", "--frames 0:5");
    drive = json::parse(compare("halogen", "darker", "--json").output).at("drives").at(0);
    EXPECT_THAT(joined(drive.at("left_out")),
                AllOf(HasSubstr("PNGs: shown by another tone mapper"), HasSubstr("measured otherwise (measure.extent.target_height_m)")));
    EXPECT_EQ(drive.at("settings").at(0).at("key"), "tone_mapper.l_max_cdm2");
    EXPECT_THAT(drive.at("changes"), IsEmpty());
    for (const json& frame : drive.at("frames"))
        EXPECT_THAT(frame.at("new_file").get<std::string>(), HasSubstr(".exr"));
}

// 64 x 48 over 60 degrees: 24 / tan(30 degrees) pi / 180 = 0.7255 pixels per degree; 320 x 240 over 0.2: 120 / tan(0.1) pi / 180 = 1200.
TEST_F(RunCompare, ViewsTooCoarseOrTooFineForFlipAreComparedInAllElse) {
    std::string drive = content_of(library_file("drives/straight.yaml"));
    for (std::size_t at = 0; (at = drive.find(": ../", at)) != std::string::npos;)
        drive.replace(at + 2, 3, library_file(""));
    drive.replace(drive.find("dressing: dressed"), 17, "dressing: plain"); // on which nothing casts
    const std::string old_view = "driver: {pitch_deg: -1, resolution_px: [1024, 768]}";
    ASSERT_THAT(drive, HasSubstr(old_view));
    drive.replace(drive.find(old_view), old_view.size(),
                  "driver: {resolution_px: [64, 48], vertical_fov_deg: 60}\n"
                  "  tele: {resolution_px: [320, 240], vertical_fov_deg: 0.2}");
    std::ofstream(at("extreme.yaml")) << drive;
    play("cast", at("extreme.yaml"), "--shadows map", "--frames 0:1");
    play("plain", at("extreme.yaml"), "--shadows none", "--frames 0:1");
    const Outcome outcome = compare("cast", "plain", "--json --strictness same-picture --out " + at("extreme"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output; // a class that asks for no FLIP is kept without
    const json found = json::parse(outcome.output).at("drives").at(0);
    const std::map<std::string, std::string> expected{{"driver", "0.7255 pixels per degree, and FLIP is taken at 1 to 1000"},
                                                      {"tele", "1200 pixels per degree, and FLIP is taken at 1 to 1000"}};
    std::size_t missing = 0, measured = 0;
    for (const json& frame : found.at("frames"))
        for (const json& layer : frame.at("layers"))
            for (const json& figure : layer.at("values")) {
                measured += figure.at("name") == "ssim" && figure.at("value").is_number() ? 1U : 0U;
                if (figure.at("name") == "flip_mean") {
                    EXPECT_EQ(figure.at("not_measured"), expected.at(frame.at("view")));
                    ++missing;
                }
            }
    EXPECT_EQ(missing, 4U) << "two views, PNG and luminance";
    EXPECT_GT(measured, missing);
    for (const auto& [view, why] : expected)
        EXPECT_THAT(joined(found.at("left_out")), HasSubstr("FLIP of the view " + view + ": " + why));
    EXPECT_THAT(content_of(at("extreme/report.html")), HasSubstr("FLIP of the view tele"));
    std::ofstream(at("flip.yaml")) << "name: seen\ndisplay:\n  mean_flip: {at_most: 0.5}\n";
    const Outcome judged = compare("cast", "plain", "--strictness " + at("flip.yaml"));
    EXPECT_EQ(judged.exit_code, 1);
    EXPECT_THAT(judged.output, HasSubstr("1200 pixels per degree"));
    // Who says how large a pixel looks has FLIP.
    EXPECT_THAT(compare("cast", "plain", "--ppd 60").output, Not(HasSubstr("FLIP of the view")));
}

TEST_F(RunCompare, RunsOfOlderVersionsMayHaveAnSThatTheirToneMapperDoesNotUse) {
    play("linear", edited("halogen", "{kind: rational, s: 20, ", "{kind: linear, "), "", "--frames 0:1");
    std::filesystem::rename(edited("linear", "{kind: linear, ", "{kind: linear, s: 1, "), at("linear/straight-1.yaml"));
    const Outcome run = compare("linear", "linear");
    EXPECT_EQ(run.exit_code, 0) << run.output;
}

TEST_F(RunCompare, TechniquesThatComputeOtherThingsAreComparedInWhatBothHave) {
    const Outcome run = run_program("run " + library_file("drives/straight.yaml") + " --lamp " + library_file("lamps/halogen-low.ies") +
                                    " --technique full --resolution 96x72 --frames 0:5 --no-accuracy --quiet --out " + at("full"));
    ASSERT_LE(run.exit_code, 1) << run.output; // what full does not compute is not measured
    const json drive = json::parse(compare("halogen", "full", "--json").output).at("drives").at(0);
    EXPECT_EQ(drive.at("new_technique"), "full");
    EXPECT_THAT(joined(drive.at("left_out")), HasSubstr("the channel luminance.cdm2, which one run's EXRs alone have"));
    bool lux = false;
    for (const json& frame : drive.at("frames"))
        for (const json& layer : frame.at("layers"))
            lux = lux || layer.at("name") == "illuminance.lx";
    EXPECT_TRUE(lux);
}

TEST_F(RunCompare, WrongInputIsOneSentenceAndTwo) {
    play("faster", edited("halogen", "speed_mps: ", "speed_mps: 1"), "", "--frames 0:5");
    std::filesystem::create_directories(at("empty"));
    std::filesystem::create_directories(at("unfinished"));
    std::ofstream(at("unfinished/INCOMPLETE")) << "";
    const auto refused = [&](const std::string& a, const std::string& b, const std::string& more, const std::string& words) {
        const Outcome outcome = compare(a, b, more);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
        EXPECT_THAT(outcome.output, HasSubstr(words));
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    };
    refused("halogen", "faster", "", "another speed in B");
    play("both", library_file("drives/straight.yaml"), "");
    refused("halogen", "both", "", "straight-1 has the lamp sets halogen-low in A and halogen, xenon in B, expected a run of drives");
    refused("halogen", "empty", "", "has no report.json");
    std::filesystem::create_directories(at("study/cells/straight_new"));
    refused("halogen", "study", "", "is a study's folder, expected one of its cells");
    refused("halogen", "unfinished", "", "a run that did not end");
    refused("halogen", "halogen/frames/straight-1-halogen-low/driver-000000.png", "", "is a picture, expected a folder as A is");
    refused("halogen/frames/straight-1-halogen-low/driver-000000.png", "halogen", "", "is a folder, expected a picture as A is");
    refused("halogen", "xenon", "--vertical-fov 40", "the drives say what their views see");
    refused("halogen", "xenon", "--pictures some", "all, or a number of moments");
    EXPECT_EQ(run_program("compare " + at("halogen") + " " + library_file("lamps/halogen-low.ies")).exit_code, 2);
}

TEST_F(RunCompare, ThePageHasEveryRowAndItsLinksLeadSomewhere) {
    ASSERT_EQ(compare("halogen", "xenon", "--out " + at("out")).exit_code, 0);
    const json found = json::parse(content_of(at("out/compare.json")));
    const std::string page = content_of(at("out/report.html"));
    for (const json& id : found.at("largest_changes"))
        EXPECT_THAT(page, HasSubstr(", row " + id.get<std::string>() + "<"));
    for (const json& change : found.at("drives").at(0).at("changes"))
        ASSERT_THAT(page, HasSubstr("<tr id=\"" + change.at("id").get<std::string>() + "\""));
    std::size_t drawn = 0;
    for (const json& frame : found.at("drives").at(0).at("frames"))
        for (const json& file : frame.at("pictures")) {
            EXPECT_GT(std::filesystem::file_size(at("out/" + file.get<std::string>())), 500U) << file;
            ++drawn;
        }
    EXPECT_GT(drawn, 20U);
    for (const json& figure : found.at("drives").at(0).at("figures"))
        for (const char* form : {"svg", "png"})
            EXPECT_GT(std::filesystem::file_size(at("out/" + figure.at(form).get<std::string>())), 500U) << figure;
    EXPECT_THAT(content_of(at("out/compare.csv")), HasSubstr("reach_1lx_road_own_m,m,"));
    EXPECT_THAT(content_of(at("out/frames.csv")), HasSubstr("illuminance.lx,rmse,lx,"));
    EXPECT_FALSE(std::filesystem::exists(at("out/INCOMPLETE")));
    const std::regex link("<a href=\"\\./([^\"]*)\">");
    std::size_t links = 0;
    for (auto found_at = std::sregex_iterator(page.begin(), page.end(), link); found_at != std::sregex_iterator(); ++found_at, ++links)
        EXPECT_TRUE(std::filesystem::exists(at("out/" + (*found_at)[1].str()))) << (*found_at)[1];
    EXPECT_EQ(links, 8U) << "compare.json and .csv; of two moments difference, isolux lines and FLIP, beside each two driver's views";
}

} // namespace
} // namespace fernlicht
