// A study of two cells against accepted readings, as ci/nightly plays it: what moves turns it red, and is named.
#include "tests/runner/program.h"
#include "tests/runner/run_readings.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class StudyAgainstBaselines : public ::testing::Test {
  protected:
    /// Our low beams on the straight; `halogen` is the lamp file of the first.
    std::string study(const std::string& name, const std::string& halogen) const {
        std::ofstream(temporary / (name + ".yaml"))
            << "fernlicht_study: 1\nname: two\ntitle: Two cells\nlamps:\n  halogen: {low: " << halogen
            << ", source: filament}\n  xenon: {low: " << library_file("lamps/xenon-low.ies") << ", source: arc}\ndrives: ["
            << library_file("drives/straight.yaml") << "]\ncompare:\n  - {new: xenon, against: halogen}\nresolution_px: [64, 48]\n";
        return temporary / (name + ".yaml");
    }
    Outcome play(const std::string& file, const std::string& out, const std::string& arguments) const {
        return run_program("study " + file + " --frames 0:1 --no-accuracy --quiet --out " + (temporary / out) + " " + arguments);
    }
    /// The cell's readings with one reading 3 % up, as a program with a mistake would have written it.
    void move_reading(const std::string& out, const std::string& name) const {
        const std::string run = temporary / (out + "/cells/straight_halogen"), file = run + "/readings.csv";
        const std::string value = tests::field_of(run, name, "value");
        std::string text = content_of(file);
        const std::size_t row = text.rfind("\r\n", text.find("," + name + ","));
        text.replace(text.find("," + value + ",", row) + 1, value.size(), std::to_string(1.03 * std::stod(value)));
        std::ofstream(file, std::ios::trunc) << text;
    }

    TemporaryFolder temporary;
    const std::string store = temporary / "baselines";
    const std::string own = study("own", library_file("lamps/halogen-low.ies"));
};

TEST_F(StudyAgainstBaselines, WhatMovesIsRedAndNamed) {
    ASSERT_EQ(play(own, "first", "").exit_code, 0);
    const Outcome accepted = run_program("accept " + (temporary / "first") + " --readings-only --baselines " + store);
    ASSERT_EQ(accepted.exit_code, 0) << accepted.output;
    EXPECT_THAT(accepted.output, HasSubstr("straight-1/halogen/photometric: new"));
    EXPECT_THAT(accepted.output, HasSubstr("accepted into " + store + ": 2 lamp sets with 0 frames"));
    const std::string against = "--baselines " + store;
    std::ofstream(temporary / "mended.yaml")
        << "known: [{id: '*/halogen/photometric/baseline', kind: fails, reason: r, expires: 2026-12-31}]";
    const Outcome same = play(own, "same", against), mended = play(own, "mended", against + " --known " + (temporary / "mended.yaml"));
    EXPECT_EQ(same.exit_code, 0) << same.output;
    EXPECT_THAT(mended.output, ContainsRegex("UNEXPECTED PASS straight_halogen: baseline: .*; passes, but is listed as failing"))
        << "red or green, its name is one";

    // The program's readings move.
    move_reading("first", "reach_5lx_road_own_m");
    ASSERT_EQ(run_program("accept " + (temporary / "first") + " --readings-only --baselines " + (temporary / "other")).exit_code, 0);
    const Outcome moved = play(own, "moved", "--baselines " + (temporary / "other"));
    EXPECT_EQ(moved.exit_code, 1);
    EXPECT_THAT(moved.output, HasSubstr("Two cells: fail\n"));
    EXPECT_THAT(
        moved.output,
        ContainsRegex("FAIL straight_halogen: baseline reading reach_5lx_road_own_m: [0-9.]+ m, accepted [0-9.]+ m, "
                      "off by [0-9.]+ m \\(2.91 %\\), allowed for rounding: 0.0[0-9]+ m \\([0-9a-f]+, accepted without pictures\\)"));
    EXPECT_EQ(std::string::npos, moved.output.find("FAIL straight_xenon"));
    EXPECT_THAT(content_of(temporary / "moved/junit.xml"), HasSubstr("baseline reading reach_5lx_road_own_m"));
    EXPECT_THAT(content_of(temporary / "moved/report.html"), HasSubstr("baseline reading reach_5lx_road_own_m"));
    for (const char* of : {"moved/junit.xml", "moved/cells/straight_halogen/junit.xml"}) {
        const std::string junit = content_of(temporary / of), repeat = junit.substr(junit.find("repeat with: "), 1000);
        EXPECT_THAT(repeat.substr(0, repeat.find('<')),
                    ::testing::AllOf(HasSubstr(" study "), HasSubstr(" --only straight_halogen"), ::testing::Not(HasSubstr("--out"))))
            << of;
    }

    // The same, listed as known; the xenon is listed wrongly.
    std::ofstream(temporary / "known.yaml") << "known:\n  - {id: straight-1/halogen/photometric/baseline reading reach_5lx_road_own_m, "
                                               "kind: fails, reason: known, expires: 2026-12-31}\n";
    const std::string listed = "--baselines " + (temporary / "other") + " --known " + (temporary / "known.yaml");
    const Outcome known = play(own, "known", listed + " --today 2026-12-31");
    EXPECT_EQ(known.exit_code, 0) << known.output;
    EXPECT_THAT(known.output, HasSubstr("known straight_halogen: baseline reading reach_5lx_road_own_m"));
    const std::string said = content_of(temporary / "known/study.md");
    EXPECT_THAT(said, ContainsRegex("\n## Within limits; 1 of 2 cells as in the baselines\n"));
    EXPECT_THAT(said, HasSubstr("known straight_halogen: baseline reading reach_5lx_road_own_m"));
    const Outcome passes = play(own, "passes", against + " --known " + (temporary / "known.yaml") + " --today 2026-12-31");
    EXPECT_EQ(passes.exit_code, 1) << "the entry names no verdict, since all readings agree in one";
    EXPECT_THAT(passes.output, ContainsRegex("FAIL known failure straight-1/halogen/.*: all is green there: take the entry out"));
    EXPECT_THAT(content_of(temporary / "passes/study.md"), HasSubstr("\n## The list of known failures is out of date\n"));

    // The lamp moves.
    ASSERT_EQ(
        run_program("lamp " + library_file("lamps/halogen-low.ies") + " --scale 1.03 --convert " + (temporary / "brighter.ies")).exit_code,
        0);
    const Outcome lamp = play(study("brighter", temporary / "brighter.ies"), "lamp", against);
    EXPECT_EQ(lamp.exit_code, 1);
    EXPECT_THAT(
        lamp.output,
        ContainsRegex("FAIL straight_halogen: baseline: lamp file \\(brighter.ies\\) changed since [0-9a-f]+: of [0-9]+ readings "
                      "[1-9][0-9]+ differ, largest deviation among the readings that decide by default: .*; no baseline has these inputs"));
    EXPECT_EQ(std::string::npos, lamp.output.find("FAIL straight_xenon"));
    const std::string accept = "accept " + (temporary / "lamp") + " " + against + " --readings-only";
    EXPECT_THAT(printed(accept), ContainsRegex("[0-9a-f]+ of other inputs stays: `fernlicht baselines remove [0-9a-f]+`"));
    EXPECT_EQ(printed(accept).find("of other inputs"), std::string::npos) << "it was accepted before";
}

TEST_F(StudyAgainstBaselines, RefusesFlagsWithoutEffect) {
    EXPECT_EQ(play(own, "a", "--across-devices").exit_code, 2);
    EXPECT_EQ(play(own, "b", "--today 2026-12-31").exit_code, 2);
    EXPECT_EQ(play(own, "c", "--known " + (temporary / "nowhere.yaml")).exit_code, 2);
    EXPECT_EQ(run_program("accept " + (temporary / "a")).exit_code, 2) << "no study";
    const Outcome misspelt = play(own, "d", "--baselines " + (temporary / "nowhere"));
    EXPECT_EQ(misspelt.exit_code, 2);
    EXPECT_THAT(misspelt.output, HasSubstr("nowhere: is no folder, expected one that `fernlicht accept` made"));
}

} // namespace
} // namespace fernlicht
