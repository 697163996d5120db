// Whole studies through the program.
#include "runner/experiments/study/study_document.h"
#include "runner/write/formats.h"
#include "tests/runner/opened_page.h"
#include "tests/runner/run_readings.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* quick = " --frames 0:5 --quiet --no-accuracy ";

std::string write_study_file(const TemporaryFolder& folder, const std::string& second_lamp, const std::string& more = "") {
    const std::string file = folder / "study.yaml";
    std::ofstream(file) << "fernlicht_study: 1\nname: two\ntitle: Two cells\nlamps:\n  old: {low: " << library_file("lamps/halogen-low.ies")
                        << "}\n  new: " << second_lamp << "\ndrives: [" << library_file("drives/straight.yaml")
                        << "]\npictured_moments: 2\nresolution_px: [96, 72]\n"
                        << more;
    return file;
}

/// The page as a browser sees it.
void open_page(const TemporaryFolder& folder) {
    const OpenedPage opened = opened_page(folder, "out", "image.naturalWidth === 96");
    EXPECT_EQ(opened.said, "true true 20% true true 2") << "one moment within the first six, two lamps";
    for (const std::string& link : opened.links)
        EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + link))) << link;
    EXPECT_GT(opened.links.size(), 10U);
}

json without_times(json study) {
    study.erase("context");
    return study;
}

struct StudyProgram : testing::Test {
    TemporaryFolder folder;
    std::string xenon = "{low: " + library_file("lamps/xenon-low.ies") + ", source: arc}";
};

TEST_F(StudyProgram, PlaysComparesAndTracesEveryFigureToARow) {
    const std::string file = write_study_file(folder, xenon);
    const Outcome run = run_program("study " + file + quick + "--out " + (folder / "out") + " --trace " + (folder / "out/trace.json"));
    ASSERT_EQ(run.exit_code, 0) << run.output;
    const json events = json::parse(content_of(folder / "out/trace.json")).at("traceEvents");
    EXPECT_EQ(std::ranges::count_if(events, [](const json& event) { return event.at("name") == "cell"; }), 2);
    const json study = tests::checked(content_of(folder / "out/study.json"), study_members);
    EXPECT_EQ(study.at("verdict"), "pass");
    ASSERT_EQ(study.at("cells").size(), 2U);
    const std::string page = content_of(folder / "out/report.html");
    std::size_t deciding = 0;
    for (const json& change : study.at("changes")) {
        // The row's values are those of the cells' own reports.
        for (const auto& [cell, value] : {std::pair("old_cell", "old_value"), std::pair("new_cell", "new_value")}) {
            if (change.at("decides") == false)
                break;
            const std::string played = folder / ("out/cells/" + change.at(cell).get<std::string>());
            const std::string found = tests::field_of(played, change.at("reading").get<std::string>(), "value");
            const json& told = change.at(value).is_object() ? change.at(value).front() : change.at(value); // a bound
            EXPECT_EQ(found.empty() ? json(nullptr) : json(std::stod(found)), told) << change;
        }
        if (change.at("decides") == true) {
            ++deciding;
            EXPECT_THAT(page, HasSubstr("<tr id=\"" + change.at("id").get<std::string>() + "\""));
        }
    }
    EXPECT_EQ(deciding, 7U);
    ASSERT_EQ(study.at("largest_changes").size(), 3U);
    for (const json& id : study.at("largest_changes"))
        EXPECT_THAT(page, HasSubstr("<a href=\"#" + id.get<std::string>() + "\">"));
    for (const json& figure : study.at("figures"))
        for (const char* form : {"svg", "png"})
            EXPECT_GT(std::filesystem::file_size(folder / ("out/" + figure.at(form).get<std::string>())), 500U) << figure;
    EXPECT_THAT(content_of(folder / "out/study.tex"), HasSubstr("\\toprule"));
    EXPECT_THAT(content_of(folder / "out/study.md"),
                testing::AllOf(testing::StartsWith("# Two cells\n\n## No limits were set\n\n"), HasSubstr("| new / old | straight-1 |")));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/INCOMPLETE"));
    if (run_shell("command -v chromium").exit_code != 0)
        GTEST_SKIP() << "no Chromium on this machine: the page is not opened";
    open_page(folder);
}

TEST_F(StudyProgram, TheSameLampUnderAnotherNameDiffersInNothing) {
    const std::string file = write_study_file(folder, "{low: " + library_file("lamps/halogen-low.ies") + "}");
    // Against baselines of which none was accepted: red, and all the rest is there.
    std::filesystem::create_directory(folder / "none");
    const Outcome run = run_program("study " + file + quick + "--baselines " + (folder / "none") + " --out " + (folder / "out"));
    ASSERT_EQ(run.exit_code, 1) << run.output;
    const json study = tests::checked(content_of(folder / "out/study.json"), study_members);
    EXPECT_EQ(study.at("verdict"), "fail");
    EXPECT_THAT(study.at("largest_changes"), IsEmpty());
    EXPECT_EQ(study.at("lamps").at(0).at("difference").at("differs"), false);
    std::size_t known = 0;
    for (const json& change : study.at("changes")) {
        EXPECT_TRUE(change.at("kind") == "no difference" || change.at("kind") == "not known") << change;
        known += change.at("kind") == "no difference" ? 1U : 0U;
    }
    EXPECT_GT(known, 50U);
    EXPECT_THAT(run.output, HasSubstr("new against old: the same light; no difference beyond the digits of the tables."));
}

TEST_F(StudyProgram, GoesOnWhereItWasStoppedAndGivesTheSameBytes) {
    const std::string file = write_study_file(folder, xenon);
    const std::string arguments = "study " + file + " --frames 0:5 --no-accuracy --out ";
    ASSERT_EQ(run_program(arguments + (folder / "whole")).exit_code, 0);
    const Outcome stopped = run_interrupted(arguments + (folder / "out"), "cell 2 of 2");
    EXPECT_EQ(stopped.exit_code, 1) << stopped.output;
    EXPECT_THAT(stopped.output, HasSubstr("incomplete: interrupted by the user"));
    EXPECT_THAT(content_of(folder / "out/report.html"), HasSubstr("The study did not end"));
    const Outcome anew = run_program(arguments + (folder / "out"));
    EXPECT_EQ(anew.exit_code, 2);
    EXPECT_THAT(anew.output, HasSubstr("holds a study that did not end, expected --resume to go on with it, or a new or an empty folder"));
    const Outcome other = run_program("study " + file + " --frames 0:4 --no-accuracy --resume --out " + (folder / "out"));
    EXPECT_EQ(other.exit_code, 2) << "other moments are another study";
    EXPECT_THAT(other.output, HasSubstr("found a cell that was played with other files or settings"));
    const Outcome resumed = run_program(arguments + (folder / "out") + " --resume");
    EXPECT_EQ(resumed.exit_code, 0) << resumed.output;
    const json study = tests::checked(content_of(folder / "out/study.json"), study_members);
    EXPECT_EQ(study.at("context").at("cells").at(0).at("reused"), true);
    EXPECT_EQ(without_times(study), without_times(json::parse(content_of(folder / "whole/study.json"))));
    EXPECT_EQ(content_of(folder / "out/study.csv"), content_of(folder / "whole/study.csv"));
    for (const OutputFormat& format : output_formats()) {
        const std::string paper = std::string("study") + format.extension;
        EXPECT_TRUE(!format.for_papers || content_of(folder / ("out/" + paper)) == content_of(folder / ("whole/" + paper))) << paper;
    }
}

/// One cell's report is damaged when a study that did not end goes on: that cell is missing and named, all of the other is there.
TEST_F(StudyProgram, ACellThatFailsLosesNothingOfTheOthers) {
    const std::string file = write_study_file(folder, xenon), arguments = "study " + file + quick + "--out " + (folder / "out");
    ASSERT_EQ(run_program(arguments).exit_code, 0);
    const json whole = json::parse(content_of(folder / "out/study.json"));
    std::ofstream(folder / "out/INCOMPLETE") << "as after a power failure\n";
    std::ofstream(folder / "out/cells/straight_new/report.json") << "{\"schema\": ";
    const Outcome run = run_program(arguments + " --resume");
    EXPECT_EQ(run.exit_code, 1) << run.output;
    EXPECT_THAT(run.output, HasSubstr("NOT PLAYED straight_new: "));
    const json study = tests::checked(content_of(folder / "out/study.json"), study_members);
    EXPECT_EQ(study.at("verdict"), "not_measured");
    EXPECT_EQ(study.at("complete"), false);
    ASSERT_EQ(study.at("cells").size(), 2U);
    EXPECT_EQ(study.at("cells").at(0), whole.at("cells").at(0)) << "what was played stays, to the last digit";
    EXPECT_THAT(study.at("cells").at(1).at("failed").get<std::string>(), HasSubstr("report.json"));
    EXPECT_THAT(study.at("cells").at(1).at("readings"), IsEmpty());
    EXPECT_THAT(study.at("changes"), IsEmpty());
    EXPECT_EQ(study.at("lamps"), whole.at("lamps")) << "the lamps' tables are compared all the same";
    EXPECT_THAT(content_of(folder / "out/report.html"), HasSubstr("not played: "));
    EXPECT_THAT(content_of(folder / "out/junit.xml"), HasSubstr("straight_new"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/figures/lux_straight_old.svg"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/INCOMPLETE"));
}

TEST_F(StudyProgram, AFinishedStudyIsReportedAgainFromItsCells) {
    const std::string out = " --out " + (folder / "out");
    ASSERT_EQ(run_program("study " + write_study_file(folder, xenon) + quick + out).exit_code, 0);
    const std::string page = content_of(folder / "out/report.html");
    EXPECT_THAT(page, HasSubstr("No limits were set"));
    EXPECT_THAT(page, HasSubstr("6 of 100 moments of each drive were played (--frames 0:5)"));
    EXPECT_THAT(content_of(folder / "out/cells/straight_old/report.html"), HasSubstr("6 of 100 moments were to be played"));
    const std::string first = content_of(folder / "out/study.csv"), cell = content_of(folder / "out/cells/straight_old/report.json");
    const Outcome again = run_program("study " + (folder / "study.yaml") + quick + out + " --resume");
    EXPECT_EQ(again.exit_code, 0) << again.output;
    EXPECT_EQ(content_of(folder / "out/study.csv"), first);
    // Judged anew: a deciding reading that is misspelt, over the same cells.
    const std::string misspelt = write_study_file(folder, xenon, "decide: [reach_1lx_tarket_own_m]\n");
    const Outcome red = run_program("study " + misspelt + quick + out + " --resume");
    EXPECT_EQ(red.exit_code, 1);
    EXPECT_THAT(red.output, HasSubstr("NOT MEASURED deciding reading reach_1lx_tarket_own_m: there is no reading of this name; the "
                                      "nearest name is reach_1lx_target_own_m"));
    EXPECT_EQ(content_of(folder / "out/cells/straight_old/report.json"), cell) << "played again";
    const Outcome other = run_program("study " + misspelt + " --frames 0:4 --quiet --no-accuracy --resume" + out);
    EXPECT_EQ(other.exit_code, 2) << "other moments are another study";
    EXPECT_FALSE(std::filesystem::exists(folder / "out/INCOMPLETE")) << "nothing was begun";
}

TEST_F(StudyProgram, RefusesBeforeAnythingIsDrawn) {
    const std::string file = write_study_file(folder, xenon, "techniques: [fotometric]\n");
    const Outcome run = run_program("study " + file + quick + "--out " + (folder / "out"));
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    EXPECT_EQ(run_program("study " + file + " --resume").exit_code, 2);
    const Outcome beyond = run_program("study " + write_study_file(folder, xenon) + " --frames 100000:100001 --out " + (folder / "out"));
    EXPECT_EQ(beyond.exit_code, 2) << beyond.output;
    EXPECT_THAT(beyond.output, HasSubstr("expected moments of a drive, the longest of which has 0 to 99"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    const Outcome none = run_program("study " + library_file("studies/standard.yaml") + " --only moon --out " + (folder / "out"));
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.output, HasSubstr("found 'moon', which fits no cell"));
    const auto listed = [](const std::string& only) {
        return run_program("study " + library_file("studies/standard.yaml") + " --list --only " + only);
    };
    EXPECT_EQ(std::ranges::count(listed("'straight*'").output, '\n'), 2);
    EXPECT_EQ(listed("moon").exit_code, 2);
}

} // namespace
} // namespace fernlicht
