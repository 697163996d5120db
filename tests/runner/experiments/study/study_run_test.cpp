// Whole studies through the program.
#include "runner/experiments/study/study_document.h"
#include "runner/experiments/study/study_run.h"
#include "runner/files/durable_files.h"
#include "runner/files/object_store.h"
#include "runner/history/database.h"
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

constexpr const char* moments = " --frames 0:5 --quiet --no-accuracy ";

std::string write_study_file(const TemporaryFolder& folder, const std::string& second_lamp, const std::string& more = "") {
    std::string file = folder / "study.yaml";
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

/// With every reading in memory.
StudyResult filled(StudyResult result) {
    for (CellResult& cell : result.cells) {
        static_cast<ReadingsOfCell&>(cell) = all_readings(result, cell);
        cell.has_all_readings = true;
    }
    result.changes.clear();
    result.changes_elsewhere = 0;
    result.largest.clear();
    result.verdicts.clear();
    compare_cells(result);
    return result;
}

json without_times(json study) {
    study.erase("context");
    return study;
}

std::string without_command(const std::string& report) {
    json whole = json::parse(report);
    whole.at("context").erase("command");
    return whole.dump();
}

struct StudyProgram : testing::Test {
    TemporaryFolder folder;
    const std::string store = " --store " + (folder / "store"), quick = moments + store + " ";
    std::filesystem::path entry_of(const std::string& key) const {
        return folder / ("store/cells/" + key.substr(0, 2) + "/" + key.substr(2) + ".json");
    }
    std::string xenon = "{low: " + library_file("lamps/xenon-low.ies") + ", source: arc}";
};

TEST_F(StudyProgram, TellsReadingsThatItDoesNotKeepInMemory) {
    const std::string file = write_study_file(folder, xenon, "limits: [{reading: area_5lx_road_own_m2, at_least: 1}]\n");
    ASSERT_EQ(run_program("study " + file + quick + "--out " + (folder / "out")).exit_code, 0);
    StudyOptions options{.folder = folder / "again", .store = folder / "store"};
    options.run.ticks = {0, 5};
    options.run.accuracy = false;
    options.judge_cell = [](const Report&, const std::filesystem::path&) {};
    options.write = [](const StudyResult& found) {
        ASSERT_EQ(found.cells.size(), 2U);
        ASSERT_EQ(found.cells.front().failed, "");
        EXPECT_THAT(found.cells.front().readings.size(), testing::AllOf(testing::Gt(3U), testing::Lt(found.keys.size() / 5)));
        const StudyResult whole = filled(found);
        EXPECT_EQ(whole.changes.size(), found.changes.size() + found.changes_elsewhere);
        EXPECT_LT(found.changes.size(), whole.changes.size() / 5);
        EXPECT_EQ(json_text(as_json(found, study_members)), json_text(as_json(whole, study_members)));
    };
    collect_study(read_study(file), options);
}

TEST_F(StudyProgram, PlaysComparesAndTracesEveryFigureToARow) {
    const std::string file = write_study_file(folder, xenon);
    const Outcome run =
        run_program("study " + file + quick + "--out " + (folder / "out") + " --figures paper --trace " + (folder / "out/trace.json"));
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
    for (const char* const name : {"ranking_new-old", "reach_5lx_target_own_m_straight"}) {
        const std::string paper = folder / (std::string("out/paper/") + name);
        EXPECT_THAT(content_of(paper + ".pdf"), testing::StartsWith("%PDF-"));
        EXPECT_THAT(content_of(paper + ".svg"), testing::AllOf(HasSubstr("<svg"), Not(HasSubstr("<text"))))
            << "letters are glyphs of its own";
        EXPECT_GT(std::filesystem::file_size(paper + ".csv"), 100U);
        EXPECT_THAT(content_of(folder / "out/paper/figures.tex"), HasSubstr(std::string("mm]{") + name + ".pdf}"));
    }
    EXPECT_THAT(content_of(folder / "out/paper/figures.tex"), HasSubstr("Source: moments of the cells straight\\_old, straight\\_new"));
    EXPECT_THAT(content_of(folder / "out/paper/tables.tex"),
                AllOf(HasSubstr("\\caption{Old, new and change"), HasSubstr("\\label{tab:decision}")));
    EXPECT_THAT(content_of(folder / "out/paper/figures.tex"), HasSubstr("\\begin{figure*}"));
    for (const auto& [name, captions] : {std::pair("figures.tex", "Source: "), std::pair("tables.tex", "\\caption{")}) {
        std::istringstream lines(content_of(folder / (std::string("out/paper/") + name)));
        for (std::string line; std::getline(lines, line);)
            if (line.find(captions) != std::string::npos) {
                EXPECT_THAT(line, HasSubstr("of each drive were played"));
            }
    }
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
    const std::string begins = "study " + file + " --frames 0:5 --no-accuracy --jobs 1", arguments = begins + store + " --out ";
    ASSERT_EQ(run_program(begins + " --store " + (folder / "other-store") + " --out " + (folder / "whole")).exit_code, 0);
    const Outcome stopped = run_interrupted(arguments + (folder / "out"), "1 of 2 cells done");
    EXPECT_EQ(stopped.exit_code, 1) << stopped.output;
    EXPECT_THAT(stopped.output, HasSubstr("incomplete: interrupted by the user"));
    EXPECT_THAT(content_of(folder / "out/report.html"), HasSubstr("The study did not end"));
    const Outcome anew = run_program(arguments + (folder / "out"));
    EXPECT_EQ(anew.exit_code, 2);
    EXPECT_THAT(anew.output, HasSubstr("holds a study that did not end, expected --resume to go on with it, or a new or an empty folder"));
    const Outcome other = run_program("study " + file + " --frames 0:4 --no-accuracy --resume" + store + " --out " + (folder / "out"));
    EXPECT_EQ(other.exit_code, 2) << "other moments are another study";
    EXPECT_THAT(other.output, HasSubstr("was begun otherwise (setting changed: moments 0:5 -> 0:4)"));
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

/// One cell has no results: it is missing and named, all of the other is there.
TEST_F(StudyProgram, ACellThatFailsLosesNothingOfTheOthers) {
    const std::string file = write_study_file(folder, xenon), arguments = "study " + file + quick + "--out " + (folder / "out");
    ASSERT_EQ(run_program(arguments).exit_code, 0);
    const json whole = json::parse(content_of(folder / "out/study.json"));
    std::filesystem::remove(entry_of(whole.at("cells").at(1).at("key")));
    const Outcome run = run_program(arguments + " --resume --collect");
    EXPECT_EQ(run.exit_code, 1) << run.output;
    EXPECT_THAT(run.output, HasSubstr("NOT PLAYED straight_new: it is not in the store"));
    const json study = tests::checked(content_of(folder / "out/study.json"), study_members);
    EXPECT_EQ(study.at("verdict"), "not_measured");
    EXPECT_EQ(study.at("complete"), false);
    ASSERT_EQ(study.at("cells").size(), 2U);
    EXPECT_EQ(study.at("cells").at(0), whole.at("cells").at(0)) << "what was played stays, to the last digit";
    EXPECT_THAT(study.at("cells").at(1).at("readings"), IsEmpty());
    EXPECT_THAT(study.at("changes"), IsEmpty());
    EXPECT_EQ(study.at("lamps"), whole.at("lamps")) << "the lamps' tables are compared all the same";
    EXPECT_THAT(content_of(folder / "out/report.html"), HasSubstr("not played: "));
    EXPECT_THAT(content_of(folder / "out/junit.xml"), HasSubstr("straight_new"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/figures/lux_straight_old.svg"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/INCOMPLETE"));
    EXPECT_EQ(run_program(arguments + " --resume").exit_code, 0);
    EXPECT_EQ(without_times(json::parse(content_of(folder / "out/study.json"))), without_times(whole)) << "played again";
}

TEST_F(StudyProgram, WhatIsInTheStoreIsNotPlayedAgain) {
    const std::string file = write_study_file(folder, xenon), arguments = "study " + file + quick;
    const auto studied = [&](const std::string& out) {
        EXPECT_EQ(run_program(arguments + "--out " + (folder / out)).exit_code, 0);
        return json::parse(content_of(folder / (out + "/study.json")));
    };
    const auto reused = [](const json& study) {
        std::vector<bool> all;
        for (const json& cell : study.at("context").at("cells"))
            all.push_back(cell.at("reused"));
        return all;
    };
    EXPECT_EQ(printed(arguments + "--explain").substr(0, 12), "straight_old");
    const json first = studied("first"), second = studied("second");
    EXPECT_EQ(reused(first), std::vector<bool>({false, false}));
    EXPECT_EQ(reused(second), std::vector<bool>({true, true}));
    EXPECT_EQ(without_times(first), without_times(second));
    for (const char* const cell : {"straight_old", "straight_new"})
        EXPECT_EQ(
            run_shell("diff -r -I 'code>\\|\"command\"' " + (folder / "first/cells/") + cell + " " + (folder / "second/cells/") + cell)
                .output,
            "");
    // A flipped bit in what is kept: found, and played again.
    const auto flip_bit = [&] {
        const std::filesystem::path object =
            object_path(folder / "store", json::parse(content_of(entry_of(first.at("cells").at(0).at("key")))).at("object"));
        std::string bytes = content_of(object);
        bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
        std::ofstream(object, std::ios::binary) << bytes;
    };
    flip_bit();
    EXPECT_THAT(printed(arguments + "--plan"), HasSubstr(R"({"cells":["straight_old"],)"));
    EXPECT_EQ(run_program(arguments + "--play --only straight_old").exit_code, 0);
    printed(arguments + "--collect --out " + (folder / "mended"), 0);
    flip_bit();
    EXPECT_THAT(printed(arguments + "--explain"),
                HasSubstr("straight_old                             its results are missing or damaged\n"));
    EXPECT_THAT(printed(arguments + "--collect --out " + (folder / "collected"), 1), HasSubstr("its results in the store are damaged"));
    EXPECT_THAT(printed(arguments + "--explain"), testing::AllOf(HasSubstr("1 of 2 cells would be played"), HasSubstr("were damaged")))
        << "it is out of the store";
    const json third = studied("third");
    EXPECT_EQ(reused(third), std::vector<bool>({false, true}));
    EXPECT_EQ(without_times(first), without_times(third));
    // One lamp changed: only its cell, and why.
    std::filesystem::copy_file(library_file("lamps/xenon-low.ies"), folder / "new.ies");
    write_study_file(folder, "{low: new.ies, source: arc}");
    EXPECT_THAT(printed(arguments + "--explain"), HasSubstr("0 of 2 cells would be played")) << "the same light by another name";
    std::string lamp = content_of(folder / "new.ies");
    lamp.replace(lamp.rfind('2'), 1, "3");
    std::ofstream(folder / "new.ies") << lamp;
    EXPECT_EQ(printed(arguments + "--explain"),
              "straight_new                             lamp new.ies is new; lamp xenon-low.ies is gone\n1 of 2 cells would be "
              "played; store " +
                  (folder / "store") + "\n");
    EXPECT_EQ(reused(studied("fourth")), std::vector<bool>({true, false}));
}

TEST_F(StudyProgram, VerdictsAreThoseOfNowOverCellsOfThen) {
    const std::string drive = folder / "own.yaml", study = folder / "study.yaml";
    std::ofstream(study) << "fernlicht_study: 1\nname: own\nlamps:\n  old: {low: " << library_file("lamps/halogen-low.ies")
                         << "}\ndrives: [own.yaml]\n";
    const auto limited = [&](const std::string& title, double metres, const std::string& out) {
        std::ofstream(drive) << "fernlicht: 1\nname: own\ntitle: " << title << "\nroad: " << library_file("roads/straight.xodr")
                             << "\nspeed_kmh: 72\nduration_s: 1\nlamp_sets:\n  a: {file: " << library_file("lamps/halogen-low.ies")
                             << "}\nlimits:\n  - {reading: reach_1lx_road_own_m, at_least: " << metres << "}\n";
        return run_program("study " + study + quick + "--out " + (folder / out)).exit_code;
    };
    EXPECT_EQ(limited("First title", 5.0, "kept"), 0);
    EXPECT_EQ(limited("Second title", 5000.0, "exceeded"), 1);
    const json exceeded = json::parse(content_of(folder / "exceeded/study.json"));
    EXPECT_EQ(exceeded.at("context").at("cells").at(0).at("reused"), true);
    EXPECT_EQ(exceeded.at("verdict"), "fail");
    const json report = json::parse(content_of(folder / "exceeded/cells/own_old/report.json"));
    EXPECT_EQ(report.at("verdict"), "fail");
    EXPECT_EQ(report.at("drives").at(0).at("verdicts").at(0).at("name"), "reach_1lx_road_own_m");
    const std::string page = content_of(folder / "exceeded/cells/own_old/report.html");
    EXPECT_THAT(page, HasSubstr("<h1>Second title</h1>"));
    EXPECT_THAT(page, HasSubstr("Limits exceeded"));
    EXPECT_THAT(page, Not(HasSubstr("First title")));
    EXPECT_THAT(content_of(folder / "exceeded/cells/own_old/own.yaml"), HasSubstr("at_least: 5000"));
    EXPECT_THAT(content_of(folder / "kept/cells/own_old/report.html"), HasSubstr("Within limits"));
}

TEST_F(StudyProgram, CellsThatHangOrTakeTooMuchAreRedRows) {
    const std::string arguments = "study " + write_study_file(folder, xenon) + quick + "--out ";
    const auto why = [&](const std::string& limit, const std::string& out) {
        EXPECT_EQ(run_program(arguments + (folder / out) + limit).exit_code, 1);
        const json study = tests::checked(content_of(folder / (out + "/study.json")), study_members);
        EXPECT_THAT(study.at("context").at("cells").at(0).at("command").get<std::string>(), HasSubstr("--only straight_old"));
        std::string failed = study.at("cells").at(0).at("failed");
        const bool has_log = std::filesystem::exists(folder / (out + "/logs/straight_old.log"));
        EXPECT_THAT(failed, HasSubstr(has_log ? "(log: logs/straight_old.log)" : "(it printed nothing)"));
        return failed;
    };
    EXPECT_THAT(why(" --cell-minutes 0.01", "slow"), HasSubstr("s; its limit is 0.6 s"));
    EXPECT_THAT(printed(arguments.substr(0, arguments.find("--out")) + "--explain"), HasSubstr("s; its limit is 0.6 s"));
    EXPECT_THAT(why(" --cell-memory-mib 40", "large"), HasSubstr("MiB of the 40 MiB that it may take"));
    EXPECT_EQ(run_program(arguments + (folder / "whole")).exit_code, 0) << "nothing of it stays";
}

/// As any cluster does it: commands by themselves, in any order, then one that gathers.
TEST_F(StudyProgram, PlannedCommandsAndACollectionGiveTheSameStudy) {
    const std::string file = write_study_file(folder, xenon), arguments = "study " + file + quick;
    ASSERT_EQ(run_program("study " + file + moments + "--store " + (folder / "other") + " --out " + (folder / "whole")).exit_code, 0);
    std::istringstream lines(printed(arguments + "--plan"));
    std::vector<json> plan;
    for (std::string line; std::getline(lines, line);)
        plan.push_back(json::parse(line));
    ASSERT_EQ(plan.size(), 2U);
    EXPECT_EQ(plan[1].at("cells"), json({"straight_new"}));
    for (std::size_t i = 2; i-- > 0;)
        EXPECT_EQ(run_shell("cd / && " + plan[i].at("command").get<std::string>()).exit_code, 0);
    EXPECT_EQ(printed(arguments + "--plan"), "") << "nothing is lacking";
    ASSERT_EQ(run_program(arguments + "--collect --out " + (folder / "out")).exit_code, 0);
    EXPECT_EQ(without_times(json::parse(content_of(folder / "out/study.json"))),
              without_times(json::parse(content_of(folder / "whole/study.json"))));
    EXPECT_THAT(printed("study " + file + " --frames 0:4 --no-accuracy --collect --out " + (folder / "fewer") + store, 1),
                HasSubstr("it is not in the store as it is asked for now: setting changed: moments 0:5 -> 0:4"));
    const std::string fewer = printed("study " + file + " --frames 0:4 --no-accuracy --plan --per 2" + store);
    EXPECT_EQ(json::parse(fewer).at("cells").size(), 2U);
}

TEST_F(StudyProgram, TimesAreOfCellsByThemselves) {
    const std::string file = write_study_file(folder, xenon),
                      arguments = "study " + file + " --frames 0:5 --quiet --no-accuracy --only '*old' --out ";
    ASSERT_EQ(run_program(arguments + (folder / "timed") + " --timed").exit_code, 0);
    ASSERT_EQ(run_program(arguments + (folder / "beside") + store).exit_code, 0);
    const auto frame_s = [&](const std::string& out) {
        return json::parse(content_of(folder / (out + "/study.json"))).at("context").at("cells").at(0);
    };
    EXPECT_EQ(json::parse(content_of(folder / "beside/cells/straight_old/report.json")).at("times").at(0).at("not_measured"),
              "cells beside it");
    EXPECT_TRUE(frame_s("beside").at("frame_s").is_null());
    EXPECT_THAT(content_of(folder / "beside/cells/straight_old/report.html"), HasSubstr("Times are not measured: cells beside it."));
    EXPECT_THAT(content_of(folder / "timed/cells/straight_old/times.csv"), HasSubstr("frame, median"));
    EXPECT_THAT(printed("study " + file + " --frames 0:1 --quiet --no-accuracy --only '*old' --timed --out " + (folder / "short")),
                HasSubstr("too few moments to time a frame were played in 1 of them"));
    EXPECT_EQ(without_times(json::parse(content_of(folder / "timed/study.json"))),
              without_times(json::parse(content_of(folder / "beside/study.json"))));
    const Outcome limited =
        run_program("study " + write_study_file(folder, xenon, "limits:\n  - {reading: frame_time_median_ms, at_most: 1000}\n") + quick);
    EXPECT_EQ(limited.exit_code, 2);
    EXPECT_THAT(limited.output, HasSubstr("--timed, which plays cells by themselves"));
}

/// Cells out of the store have times too, where the study asks for the history of some. The lamp is edited, and the night before is made
/// to have been another program's: the lamp of then is played with the program of now, and moved the reading by itself.
TEST_F(StudyProgram, TheHistoryHasTimesAndTellsLampAndProgramApart) {
    const std::string lamp = folder / "new.ies", history = " --history " + (folder / "nights.db");
    std::filesystem::copy_file(library_file("lamps/xenon-low.ies"), lamp);
    const std::string file = write_study_file(folder, "{low: " + lamp + ", source: arc}", "timed_cells: ['*_new']\n");
    const auto night = [&](const char* name) {
        const Outcome run = run_program("study " + file + quick + history + " --out " + (folder / name));
        EXPECT_EQ(run.exit_code, 0) << run.output;
        return json::parse(content_of(folder / (std::string(name) + "/study.json")));
    };
    night("first");
    const json second = night("second");
    for (const json& cell : second.at("context").at("cells")) {
        EXPECT_EQ(cell.at("reused"), true);
        EXPECT_EQ(cell.at("frame_s").is_number(), cell.at("cell") == "straight_new") << cell;
    }
    Database(folder / "nights.db", Database::For::writing)
        .run("UPDATE inputs SET hash = 'another' WHERE kind = 'program' AND name = 'metrics'");
    std::string text = content_of(lamp);
    text.replace(text.find("1 -1 1 "), 7, "1 -1 1.1 "); // the factor of all candela
    std::ofstream(lamp) << text;
    night("third");
    const std::string page = content_of(folder / "third/report.html");
    EXPECT_THAT(page, testing::AllOf(HasSubstr("told apart by new on straight-1, night, aim -1 %, 13.2 V, played with that night"),
                                     HasSubstr("the inputs alone moved them")));
    EXPECT_THAT(content_of(folder / "third/study.md"),
                testing::AllOf(testing::StartsWith("# Two cells\n\n## No limits were set\n"), HasSubstr("\n## What changed since "),
                               HasSubstr("\n- "), HasSubstr("told apart by new on straight-1")));
    EXPECT_THAT(content_of(folder / "third/study.tex"), testing::ContainsRegex("\n% - [^\n]*told apart by new on straight-1"));
    const std::string red = "study " + file + quick + " --fail-on-change --out " + (folder / "red");
    EXPECT_EQ(run_program(red + history).exit_code, 1);
    EXPECT_THAT(content_of(folder / "red/study.md"), testing::StartsWith("# Two cells\n\n## Changed since the accepted night\n"));
    EXPECT_THAT(content_of(folder / "red/junit.xml"), testing::ContainsRegex("name=\"history\">[^<]*<failure message=\"[0-9]+ change"));
    // A report that cannot be written makes no night: its readings may be a part.
    std::filesystem::remove(folder / "red/study.md");
    std::filesystem::create_directories(folder / "red/study.md/taken");
    const auto nights = [&] { return printed("history export --history " + (folder / "once.db")); };
    EXPECT_EQ(run_program(red + " --resume --history " + (folder / "once.db")).exit_code, 3);
    EXPECT_EQ(std::ranges::count(nights(), '\n'), 1) << "the heads";
    std::filesystem::remove_all(folder / "red/study.md");
    EXPECT_EQ(run_program(red + " --resume --history " + (folder / "once.db")).exit_code, 0);
    EXPECT_GT(std::ranges::count(nights(), '\n'), 1000);
}

TEST_F(StudyProgram, AFinishedStudyIsReportedAgainFromItsCells) {
    const std::string out = " --out " + (folder / "out");
    ASSERT_EQ(run_program("study " + write_study_file(folder, xenon) + quick + out).exit_code, 0);
    const std::string page = content_of(folder / "out/report.html");
    EXPECT_THAT(page, HasSubstr("No limits were set"));
    EXPECT_THAT(page, HasSubstr("Only moments 0:5 of each drive were played: 6 of 100"));
    EXPECT_THAT(content_of(folder / "out/cells/straight_old/report.html"), HasSubstr("6 of 100 moments, as --frames asks"));
    const std::string first = content_of(folder / "out/study.csv"),
                      cell = without_command(content_of(folder / "out/cells/straight_old/report.json"));
    const Outcome again = run_program("study " + (folder / "study.yaml") + quick + out + " --resume");
    EXPECT_EQ(again.exit_code, 0) << again.output;
    EXPECT_EQ(content_of(folder / "out/study.csv"), first);
    // Judged anew: a deciding reading that no drive measures, over the same cells.
    const std::string unmeasured = write_study_file(folder, xenon, "decide: [reach_7lx_target_own_m]\n");
    const Outcome red = run_program("study " + unmeasured + quick + out + " --resume");
    EXPECT_EQ(red.exit_code, 1);
    EXPECT_THAT(red.output, testing::AllOf(HasSubstr("NOT MEASURED deciding reading reach_7lx_target_own_m: there is no reading of this "
                                                     "name; the nearest name is reach_"),
                                           HasSubstr("no deciding reading is in two cells that are compared")));
    EXPECT_EQ(without_command(content_of(folder / "out/cells/straight_old/report.json")), cell) << "played again";
    const Outcome other = run_program("study " + unmeasured + " --frames 0:4 --quiet --no-accuracy --resume" + store + out);
    EXPECT_EQ(other.exit_code, 2) << "other moments are another study";
    EXPECT_FALSE(std::filesystem::exists(folder / "out/INCOMPLETE")) << "nothing was begun";
}

/// Two that go on in one folder would play everything twice and take each other's cells away.
TEST_F(StudyProgram, OneProcessAtATimeGoesOnInAFolder) {
    const std::string arguments = "study " + write_study_file(folder, xenon) + quick + "--out " + (folder / "out");
    EXPECT_EQ(run_program(arguments).exit_code, 0);
    write_file(folder / "out/INCOMPLETE", "");
    {
        const auto other = FolderLock::at_once(folder / "out/INCOMPLETE");
        EXPECT_THAT(printed(arguments + " --resume", 2), HasSubstr("--out: is being written by another process"));
    }
    EXPECT_EQ(run_program(arguments + " --resume").exit_code, 0);
    EXPECT_THAT(printed(arguments + " --resume --only straight_old", 2), HasSubstr("was begun with 2 cells, and 1 are asked for now"));
}

TEST_F(StudyProgram, SaysWhatToAskForWhereNoDriveMeasuresWhatDecides) {
    const std::string said = printed("study " + write_study_file(folder, xenon, "decide: [detection_card_own_m]\n") +
                                         " --frames 0:0 --no-accuracy" + store + " --out " + (folder / "out"),
                                     1);
    EXPECT_THAT(said, HasSubstr("as no drive measures visibility: ask for `visibility` in `measure:`"));
}

TEST_F(StudyProgram, RefusesBeforeAnythingIsDrawn) {
    for (const char* more : {"decide: [reach_3lx_tarket_own_m]\n", "limits: [{reading: reach_3lx_tarket_own_m, at_least: 1}]\n"})
        for (const char* how : {" --list", " --explain", ""})
            EXPECT_THAT(
                printed("study " + write_study_file(folder, xenon, more) + how + store, 2),
                HasSubstr("found 'reach_3lx_tarket_own_m', which is no reading's name, expected one that `fernlicht readings` lists, "
                          "such as reach_3lx_target_own_m"));
    EXPECT_THAT(printed("study " + write_study_file(folder, xenon, "axes: {weather.wetness: [0, 7]}\n") + " --list", 2),
                HasSubstr("wetness"));
    const std::string file = write_study_file(folder, xenon, "techniques: [fotometric]\n");
    const Outcome run = run_program("study " + file + quick + "--out " + (folder / "out"));
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    EXPECT_EQ(run_program("study " + file + " --resume").exit_code, 2);
    const auto refused = [&](const std::string& flags, const char* sentence) {
        EXPECT_THAT(printed("study " + write_study_file(folder, xenon) + quick + flags, 2), HasSubstr(sentence));
        EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    };
    const std::string out = " --out " + (folder / "out");
    write_file(folder / "no.db", "no history at all, but long enough to be looked at by SQLite, which wants a hundred bytes of header ...");
    refused(out + " --history " + (folder / "no.db"), "no.db: is damaged or no database");
    refused(out + " --history " + folder.path().string(), "is a folder, expected a history, or the name of a new file");
    EXPECT_THAT(printed("study " + file + out + " --store " + (folder / "no.db"), 2), HasSubstr("--store: is not a folder"));
    refused("--play --expect moon=00000000000000000000000000000000", "--expect: found cell 'moon', which the study does not have");
    refused("--plan --cell-minutes 1", "--cell-minutes: found beside --list, --explain, --plan, --play or --collect, which start no");
    refused("--play --expect straight_old", "--expect: found 'straight_old', expected CELL=KEY, as --plan prints it");
    refused(out + " --plan", "--out: found beside --list, --explain, --plan or --play, which write no report");
    EXPECT_THAT(printed("study " + write_study_file(folder, xenon) + moments + out + " --store " + (folder / "out/store"), 2),
                HasSubstr("where the report is to lie, too"));
    refused(" --plan --history " + (folder / "h.db"), "--history: found beside --list, --explain, --plan or --play, which make no night");
    refused(out + " --gpus gpu:1", "--gpus: found without --executor slurm, expected both together");
    refused(out + " --per 2", "--per: found without --plan or --executor slurm");
    EXPECT_THAT(printed("study " + write_study_file(folder, xenon, "timed_cells: [moon]\n") + quick + out, 2),
                HasSubstr("found 'moon', which fits no cell, expected a name or a pattern of cells"));
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
