#include "runner/commands/run_files.h"
#include "runner/judge/baselines.h"

#include "runner/commands/accept_command.h"
#include "runner/files/durable_files.h"
#include "runner/judge/baseline_store.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "tests/runner/program.h"
#include "tests/runner/stored_run.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <tuple>
#include <utility>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using tests::StoredRun;

bool all_pass(const std::vector<Verdict>& verdicts) {
    return !verdicts.empty() && std::ranges::all_of(verdicts, [](const Verdict& verdict) { return verdict.kind == VerdictKind::pass; });
}

std::string texts(const std::vector<Verdict>& verdicts) {
    std::string all;
    for (const Verdict& verdict : verdicts)
        all += verdict.name + ": " + verdict.text + "\n";
    return all;
}

/// Every file below a folder with its content's hash.
std::map<std::string, std::string> state_of(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) {
            const std::string content = content_of(entry.path());
            files[fs::relative(entry.path(), folder).string()] = content_hash(content.data(), content.size());
        }
    return files;
}

class Baselines : public ::testing::Test {
  protected:
    TemporaryFolder temporary;
    const fs::path store = temporary.path() / "baselines";
    std::string id_of(const std::string& lamp_set) const {
        for (const StoredBaseline& entry : list_baselines(store))
            if (entry.key.lamp_set == lamp_set)
                return short_id(entry.id);
        return "none";
    }
    const StoredRun run{temporary.path() / "run"};
    StoredRun brighter{temporary.path() / "brighter", 1.5};
};

TEST_F(Baselines, TheSameRunAgrees) {
    const Accepted accepted = accept_run(run.folder, store);
    ASSERT_EQ(accepted.baselines.size(), 2U);
    for (const Baseline& baseline : accepted.baselines) {
        EXPECT_EQ(baseline.frames.size(), 2U);
        EXPECT_EQ(baseline.readings.size(), 2U) << "times are none";
    }
    const auto verdicts = run.judged(store);
    EXPECT_TRUE(all_pass(verdicts)) << texts(verdicts);
    ASSERT_EQ(verdicts.size(), 2U);
    EXPECT_THAT(verdicts[0].text, HasSubstr("2 readings agree"));
    EXPECT_THAT(verdicts[1].text, HasSubstr("4 channels of pictures agree"));
}

TEST_F(Baselines, NothingAcceptedIsRed) {
    const auto verdicts = run.judged(store);
    ASSERT_EQ(verdicts.size(), 1U);
    EXPECT_EQ(verdicts[0].kind, VerdictKind::fail);
    EXPECT_THAT(verdicts[0].text, HasSubstr("straight, halogen, photometric; software, llvmpipe (LLVM 15.0.6, 256 bits), avx2"));
    EXPECT_FALSE(fs::exists(store)) << "comparing must not make baselines";
}

TEST_F(Baselines, AnotherClassOfDeviceOrTechniqueHasNoBaseline) {
    accept_run(run.folder, store);
    const PlayedCell& played = run.report.played[0];
    EXPECT_FALSE(all_pass(judge_against_baselines(played, run.report.context, run.folder, store, "as-published")));
    RunContext context = run.report.context;
    context.cpu = "Another CPU (avx2)";
    EXPECT_TRUE(all_pass(judge_against_baselines(played, context, run.folder, store, "photometric")));
    context.cpu = "Another CPU (avx512)"; // draws as wide as one with AVX2
    EXPECT_TRUE(all_pass(judge_against_baselines(played, context, run.folder, store, "photometric")));
    context.backend = "osmesa"; // llvmpipe, too
    EXPECT_TRUE(all_pass(judge_against_baselines(played, context, run.folder, store, "photometric")));
    context.cpu = "Another CPU (sse4.1)";
    EXPECT_FALSE(all_pass(judge_against_baselines(played, context, run.folder, store, "photometric")));
    context = run.report.context;
    context.gl_renderer = "llvmpipe (LLVM 15.0.6, 128 bits)";
    EXPECT_FALSE(all_pass(judge_against_baselines(played, context, run.folder, store, "photometric")));
    context.gl_renderer = "Some GPU";
    EXPECT_FALSE(all_pass(judge_against_baselines(played, context, run.folder, store, "photometric")));
}

TEST_F(Baselines, AFrameTwoPercentOffIsRed) {
    accept_run(run.folder, store);
    run.write_frame(run.report.played[0].frames[1].exr, 10, 1.02);
    const auto verdicts = run.judged(store);
    ASSERT_EQ(verdicts.size(), 3U) << texts(verdicts);
    EXPECT_EQ(verdicts[0].kind, VerdictKind::pass) << "the readings still agree";
    EXPECT_EQ(std::tuple(verdicts[1].kind, verdicts[1].name), std::tuple(VerdictKind::fail, "baseline frame 10 driver"));
    EXPECT_THAT(verdicts[1].text, HasSubstr("illuminance.lx: maximum 1.48 at pixel 63, 0"));
    EXPECT_THAT(verdicts[2].text, HasSubstr("luminance.cdm2"));
}

TEST_F(Baselines, AReadingTwoPercentOffIsRed) {
    accept_run(run.folder, store);
    StoredRun other = run;
    other.report.played[0].readings[0].value = 61.2;
    const auto verdicts = other.judged(store);
    EXPECT_EQ(verdicts[0].kind, VerdictKind::fail);
    EXPECT_EQ(verdicts[0].name, "baseline reading reach_5lx_road_own_m");
    EXPECT_EQ(verdicts[0].text, "61.2 m, accepted 60 m, off by 1.2 m (2 %), allowed for rounding: 0.0601 m (" + id_of("halogen") + ")");
}

TEST_F(Baselines, WhatOnlyOneSideHasIsRed) {
    accept_run(run.folder, store);
    StoredRun other = run;
    other.report.played[0].readings[1].value = 90.0;
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("reach_1lx_road_own_m: 90 m, accepted not measured"));
    other = run;
    other.report.played[0].readings.erase(other.report.played[0].readings.begin());
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("not in this run, accepted 60 m"));
    other = run;
    other.report.played[0].readings.push_back({key_of("sensor_new_reach_5lx_m").value(), 1.0});
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("sensor_new_reach_5lx_m: 1 m, nothing accepted"));
    other = run;
    other.report.played[0].frames.pop_back();
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("10 driver: accepted, but not in this run"));
    other = run;
    other.report.played[0].frames[1].tick = 11;
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("11 driver: nothing accepted to compare with"));
    for (const auto& verdicts : {other.judged(store)})
        EXPECT_FALSE(all_pass(verdicts));
}

TEST_F(Baselines, ADamagedBaselineIsRed) {
    accept_run(run.folder, store);
    for (const auto& [damage, sentence] :
         {std::pair("frame", "is not the frame that was accepted"), std::pair("result", "is not the result that")}) {
        std::vector<fs::path> objects;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(store / "objects"))
            if (entry.is_regular_file() && content_of(entry.path()).starts_with("{") == (damage == std::string("result")))
                objects.push_back(entry.path());
        ASSERT_FALSE(objects.empty());
        for (const fs::path& object : objects)
            fs::resize_file(object, fs::file_size(object) - 1);
        const auto verdicts = run.judged(store);
        ASSERT_EQ(verdicts.size(), 1U);
        EXPECT_EQ(verdicts[0].kind, VerdictKind::fail);
        EXPECT_THAT(verdicts[0].text, HasSubstr(sentence));
        accept_run(run.folder, store);
        EXPECT_TRUE(all_pass(run.judged(store))) << "accepting again mends it";
    }
    for (const char* content : {"", "{", "[]", "{\"schema\": 1}", "{\"schema\": \"fernlicht baselines\", \"schema_version\": 7}"}) {
        std::ofstream(store / "index.json", std::ios::trunc) << content;
        EXPECT_FALSE(all_pass(run.judged(store))) << content;
        EXPECT_THROW(accept_run(run.folder, store), InputError) << content;
    }
}

TEST_F(Baselines, AStoreOfTheOldFormIsRefusedWithWhatToDo) {
    fs::create_directories(store);
    std::ofstream(store / "index.json") << R"({"schema": "fernlicht baselines", "schema_version": 1, "baselines": []})";
    const Outcome refused = run_program("accept '" + run.folder.string() + "' --baselines '" + store.string() + "'");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr("the old form"));
    EXPECT_THAT(refused.output, HasSubstr("a new folder, into which the runs are accepted again"));
}

TEST_F(Baselines, NothingChangesByComparingByAcceptingAgainAndByResultsThatAreRefused) {
    accept_run(run.folder, store);
    const auto before = state_of(store);
    EXPECT_FALSE(all_pass(brighter.judged(store)));
    EXPECT_EQ(state_of(store), before);
    accept_run(run.folder, store);
    EXPECT_EQ(state_of(store), before);
    EXPECT_THROW(accept_run(brighter.folder, store), InputError) << "only when told how";
    EXPECT_EQ(state_of(store), before);
}

TEST_F(Baselines, ReplacingTakesItsOwnKeysAndLeavesOthers) {
    accept_run(run.folder, store);
    brighter.report.played.pop_back(); // halogen alone
    write_report(brighter.report, brighter.folder);
    const Accepted accepted = accept_run(brighter.folder, store, Acceptance::replace);
    EXPECT_EQ(accepted.stored[0].removed, 1U);
    EXPECT_TRUE(all_pass(brighter.judged(store)));
    EXPECT_FALSE(all_pass(run.judged(store)));
    EXPECT_TRUE(all_pass(judge_against_baselines(run.report.played[1], run.report.context, run.folder, store, "photometric")));
    EXPECT_EQ(list_baselines(store).size(), 2U);
    EXPECT_EQ(state_of(store).size(), 1U + 2U + 4U) << "index, results and frames; those of the old halogen are gone";
}

TEST_F(Baselines, ANoteIsOfWhatIsNew) {
    const auto notes = [&] {
        std::map<std::string, std::string> all;
        for (const StoredBaseline& entry : list_baselines(store))
            all[entry.key.lamp_set] = entry.note;
        return all;
    };
    accept_run(run.folder, store, Acceptance::first, "the first");
    const std::map<std::string, std::string> first = notes();
    ASSERT_EQ(first.size(), 2U);
    StoredRun again(temporary.path() / "again");
    Reading& changed = again.report.played.front().readings.front();
    changed.value = Value(2.0 * changed.value.figure().value());
    write_report(again.report, again.folder);
    accept_run(again.folder, store, Acceptance::replace, "a brighter bulb");
    EXPECT_EQ(notes(), (std::map<std::string, std::string>{{again.report.played.front().lamp_set, "a brighter bulb"},
                                                           {again.report.played.back().lamp_set, "the first"}}));
}

TEST_F(Baselines, ReplacingAClassLeavesOtherDevices) {
    accept_run(run.folder, store);
    StoredRun elsewhere(temporary.path() / "elsewhere", 1.01);
    elsewhere.report.context.gl_renderer = "llvmpipe (LLVM 19.1.7, 256 bits)";
    write_report(elsewhere.report, elsewhere.folder);
    accept_run(elsewhere.folder, store);
    brighter.report.played.pop_back(); // halogen alone
    write_report(brighter.report, brighter.folder);
    const Accepted accepted = accept_run(brighter.folder, store, Acceptance::replace_class);
    EXPECT_EQ(accepted.stored[0].removed, 2U) << "the other lamp set's, too";
    EXPECT_EQ(list_baselines(store).size(), 3U);
    EXPECT_TRUE(all_pass(elsewhere.judged(store)));
    EXPECT_TRUE(all_pass(brighter.judged(store)));
    EXPECT_FALSE(all_pass(judge_against_baselines(run.report.played[1], run.report.context, run.folder, store, "photometric")));
}

TEST_F(Baselines, OfSeveralAcceptedAnyWholeOneWillDo) {
    accept_run(run.folder, store);
    accept_run(brighter.folder, store, Acceptance::add, "another driver");
    EXPECT_EQ(list_baselines(store).size(), 4U);
    EXPECT_TRUE(all_pass(run.judged(store)));
    const auto verdicts = brighter.judged(store);
    EXPECT_TRUE(all_pass(verdicts)) << texts(verdicts);
    EXPECT_THAT(verdicts[0].text, HasSubstr(", of 2 accepted)"));
    brighter.report.played[0].frames = run.report.played[0].frames; // readings of the one, frames of the other
    for (StoredFrame& frame : brighter.report.played[0].frames)
        frame.exr = (run.folder / frame.exr).string();
    EXPECT_FALSE(all_pass(brighter.judged(store)));
}

TEST_F(Baselines, TheNearestIsNamedWhereNoneWillDo) {
    accept_run(run.folder, store);
    const Accepted accepted = accept_run(brighter.folder, store, Acceptance::add, "another driver");
    StoredRun other = brighter;
    other.report.played[0].readings[0].value = 100.0;
    const auto verdicts = other.judged(store);
    ASSERT_EQ(verdicts.size(), 2U) << texts(verdicts);
    EXPECT_EQ(verdicts[0].kind, VerdictKind::fail);
    EXPECT_THAT(verdicts[0].text, HasSubstr("100 m, accepted 90 m"));
    EXPECT_THAT(verdicts[0].text, HasSubstr(short_id(accepted.stored[0].id)));
}

TEST_F(Baselines, TheSpreadOverRepeatsIsStored) {
    StoredRun repeated = run;
    PlayedCell& played = repeated.report.played[0];
    played.repeats = {12, {"play 2: reach_5lx_road_own_m"}, {{key_of("reach_5lx_road_own_m").value(), -1, 12, 60.01, 1e-4}}};
    write_report(repeated.report, repeated.folder);
    accept_run(repeated.folder, store);
    const Baseline halogen = load_baseline(store, list_baselines(store)[0]);
    ASSERT_EQ(halogen.readings.size(), 2U);
    EXPECT_EQ(std::tuple(halogen.readings[0].mean, halogen.readings[0].count, halogen.readings[0].variance), std::tuple(60.01, 12, 1e-4));
    EXPECT_EQ(halogen.readings[1].count, 0) << "not measured";
    played.repeats = {};
    played.readings[0].value = 60.1;
    const auto verdicts = repeated.judged(store); // 0.06 m for rounding and, with t = 4.9, 0.05 m by chance
    EXPECT_TRUE(all_pass(verdicts)) << texts(verdicts);
    EXPECT_THAT(verdicts[0].text, HasSubstr("11 repeats beyond the first"));
    played.readings[0].value = 60.14;
    EXPECT_FALSE(all_pass(repeated.judged(store)));
    EXPECT_EQ(load_baseline(store, list_baselines(store)[1]).readings[0].count, 1) << "the xenon was played once";
}

TEST_F(Baselines, OtherInputsAreAnotherKeyAndAreNamed) {
    accept_run(run.folder, store);
    StoredRun other = run;
    other.report.played[0].input_hashes[1].second = "another hash";
    const auto verdicts = other.judged(store);
    ASSERT_EQ(verdicts.size(), 1U);
    EXPECT_THAT(verdicts[0].text,
                HasSubstr("road changed since " + id_of("halogen") + ": all 2 readings agree; no baseline has these inputs"));
    EXPECT_THAT(verdicts[0].text, testing::EndsWith("if that is meant, `fernlicht accept` takes these results"));
    other.report.played[0].readings[0].value = 61.8;
    EXPECT_THAT(other.judged(store)[0].text,
                HasSubstr(": of 2 readings 1 differ, largest deviation: reach_5lx_road_own_m, 61.8 m, accepted 60 m, off by 1.8 m (3 %)"));
    other = run;
    other.report.played[0].lamp_set = "h7-new";
    other.report.played[0].readings[0].value = 61.8;
    EXPECT_THAT(other.judged(store)[0].text,
                HasSubstr("; of this drive halogen (" + id_of("halogen") + ") is accepted: of 2 readings 1 differ"));
    RunContext context = run.report.context;
    context.gl_renderer = "Some GPU";
    EXPECT_THAT(texts(judge_against_baselines(run.report.played[0], context, run.folder, store, "photometric")),
                HasSubstr(id_of("halogen") + " is of software, llvmpipe"));
}

// Results of other inputs that are nearer, of which fewer inputs differ, are those that are told.
TEST_F(Baselines, OfOtherInputsTheNearestAreNamed) {
    StoredRun first(temporary.path() / "first", 1.5);
    for (PlayedCell& played : first.report.played)
        played.input_hashes = {{"drive", "another drive"}, {"road", "another road"}};
    write_report(first.report, first.folder);
    accept_run(first.folder, store);
    accept_run(run.folder, store);
    StoredRun other = run;
    other.report.played[0].input_hashes[1].second = "a third road";
    EXPECT_THAT(texts(other.judged(store)), testing::ContainsRegex("road changed since [0-9a-f]+: all 2 readings agree"));
}

// Where as many inputs differ, those with the fewest readings that differ: of a whole drive and a part of it the one that was played.
TEST_F(Baselines, OfAsManyOtherInputsTheNearestReadingsAreNamed) {
    for (const double value_m : {61.0, 60.0, 62.0}) {
        StoredRun accepted(temporary.path() / std::to_string(value_m));
        accepted.report.played[0].readings[0].value = value_m;
        accepted.report.played[0].input_hashes = {{"drive", std::to_string(value_m)}, {"road", "this road"}};
        write_report(accepted.report, accepted.folder);
        accept_run(accepted.folder, store);
    }
    StoredRun other = run;
    other.report.played[0].input_hashes = {{"drive", "a fourth drive"}, {"road", "this road"}};
    EXPECT_THAT(texts(other.judged(store)),
                testing::ContainsRegex("^baseline[^:]*: drive .its keys, or --frames. changed since [0-9a-f]+: all 2 readings agree"));
}

// One other device class judges by the tolerance alone, and a verdict says so. Three others gave 60, 60.001 and 60.002 m: mean 60.001,
// standard deviation 0.001; Student's t with 2 degrees of freedom at 0.001 is 31.6: chance reaches 31.6 * 0.001 * sqrt(4/3) = 0.036 m, with
// rounding 0.097 m.
TEST_F(Baselines, AcrossDevicesTheSpreadOverOthersDecides) {
    for (int device = 0; device < 3; ++device) {
        StoredRun other(temporary.path() / std::to_string(device));
        other.report.context.gl_renderer = "GPU " + std::to_string(device);
        other.report.played[0].readings[0].value = 60.0 + 0.001 * device;
        write_report(other.report, other.folder);
        accept_run(other.folder, store);
        if (device == 0)
            for (const double off : {0.06, 0.061}) {
                StoredRun near = run;
                near.report.played[0].readings[0].value = 60.0 + off;
                const auto verdicts =
                    judge_against_baselines(near.report.played[0], near.report.context, near.folder, store, "photometric", true);
                EXPECT_EQ(all_pass(verdicts), off < 0.0601) << texts(verdicts);
                EXPECT_THAT(texts(verdicts),
                            HasSubstr("baseline device: nothing is accepted for software, llvmpipe (LLVM 15.0.6, 256 bits), "
                                      "avx2; judged by egl, GPU 0, avx2\n"));
            }
    }
    StoredRun here = run;
    const auto judged = [&](double reach_m, bool across) {
        here.report.played[0].readings[0].value = reach_m;
        return judge_against_baselines(here.report.played[0], here.report.context, here.folder, store, "photometric", across);
    };
    EXPECT_FALSE(all_pass(judged(60.0, false))) << "nothing is accepted here";
    const auto within = judged(60.09, true);
    EXPECT_TRUE(all_pass(within)) << texts(within);
    EXPECT_THAT(within[0].text, HasSubstr("over 3 other device classes"));
    EXPECT_THAT(within[2].text, HasSubstr("4 channels of pictures agree"));
    EXPECT_FALSE(all_pass(judged(60.11, true)));
    accept_run(run.folder, store);
    EXPECT_FALSE(all_pass(judged(60.09, true))) << "accepted here: 60 m, and that alone decides";
}

TEST_F(Baselines, AcceptedWithoutPicturesTheyAreNotCompared) {
    accept_run(run.folder, store, Acceptance::first, "", true);
    EXPECT_EQ(state_of(store).size(), 1U + 2U) << "index and results";
    run.write_frame(run.report.played[0].frames[1].exr, 10, 1.02);
    const auto verdicts = run.judged(store);
    ASSERT_EQ(verdicts.size(), 1U) << texts(verdicts);
    EXPECT_THAT(verdicts[0].text, HasSubstr("2 readings agree"));
    EXPECT_THAT(verdicts[0].text, HasSubstr(", accepted without pictures)"));
    StoredRun other = run;
    other.report.played[0].readings[0].value = 61.2;
    EXPECT_FALSE(all_pass(other.judged(store)));
    EXPECT_THROW(accept_run(run.folder, store), InputError) << "with pictures they are other results";
    StoredRun unmeasured(temporary.path() / "unmeasured");
    for (PlayedCell& played : unmeasured.report.played)
        played.readings.clear();
    write_report(unmeasured.report, unmeasured.folder);
    EXPECT_THROW(accept_run(unmeasured.folder, temporary.path() / "none", Acceptance::first, "", true), InputError);
}

// A reader holds the folder, so that nothing it is about to read is removed meanwhile.
TEST_F(Baselines, AReaderIsWaitedFor) {
    accept_run(run.folder, store);
    pid_t child = 0;
    {
        const FolderLock reading(store, FolderLock::For::reading);
        EXPECT_TRUE(all_pass(run.judged(store))) << "several may read";
        child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            // executed, so that it does not inherit the lock
            ::execl(FERNLICHT_BINARY, "fernlicht", "accept", brighter.folder.c_str(), "--baselines", store.c_str(), "--replace", nullptr);
            ::_exit(1);
        }
        ::usleep(500'000); // an acceptance takes a tenth of that
        EXPECT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << "it waits";
        EXPECT_TRUE(all_pass(run.judged(store)));
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(all_pass(brighter.judged(store)));
}

TEST_F(Baselines, ARunOfAnEarlierVersionIsRefusedWithWhatToDo) {
    std::string report = content_of(run.folder / "report.json");
    report.replace(report.find("\"schema_version\": 2"), 19, "\"schema_version\": 1");
    std::ofstream(run.folder / "report.json", std::ios::trunc) << report;
    const Outcome refused = run_program("accept '" + run.folder.string() + "' --baselines '" + store.string() + "'");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr("was written by another version of this program, expected a run of this version: play it again"));
}

// The second lamp set's last frame is missing: by then the first set is copied already.
TEST_F(Baselines, AnAcceptanceThatFailsHalfWayLeavesTheOldOnes) {
    accept_run(run.folder, store);
    const auto before = state_of(store);
    fs::remove(brighter.folder / brighter.report.played[1].frames[1].exr);
    EXPECT_THROW(accept_run(brighter.folder, store, Acceptance::replace), InputError);
    EXPECT_TRUE(all_pass(run.judged(store)));
    const auto index = content_of(store / "index.json");
    EXPECT_EQ(before.at("index.json"), content_hash(index.data(), index.size()));
}

// Killed at many moments, the store holds all of the old run or all of the new one: never a mixture, never half.
TEST_F(Baselines, AKilledAcceptanceLeavesOneOfTheTwoRunsWhole) {
    const auto start = std::chrono::steady_clock::now();
    accept_run(run.folder, store);
    const double whole_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    for (int round = 0; round < 24; ++round) {
        const bool to_brighter = round % 2 == 0;
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            accept_run(to_brighter ? brighter.folder : run.folder, store, Acceptance::replace);
            ::_exit(0);
        }
        ::usleep(static_cast<useconds_t>(whole_us * round / 16.0)); // from at once to long after the end
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        const bool holds_old = all_pass(run.judged(store)), holds_new = all_pass(brighter.judged(store));
        ASSERT_NE(holds_old, holds_new) << "round " << round;
        for (const StoredRun* whole : {&run, &std::as_const(brighter)})
            ASSERT_EQ(
                all_pass(judge_against_baselines(whole->report.played[1], whole->report.context, whole->folder, store, "photometric")),
                whole == &run ? holds_old : holds_new)
                << "round " << round;
    }
    accept_run(brighter.folder, store, Acceptance::replace);
    accept_run(run.folder, store, Acceptance::replace);
    EXPECT_TRUE(all_pass(run.judged(store)));
    EXPECT_EQ(state_of(store).size(), 1U + 2U + 2U) << "index, results, and the frames that both share: nothing is left behind";
}

TEST_F(Baselines, RefusesWhatIsNoCompleteRun) {
    EXPECT_THROW(accept_run(temporary.path() / "nowhere", store), InputError);
    StoredRun incomplete(temporary.path() / "incomplete");
    incomplete.report.complete = false;
    incomplete.report.interrupted = "by hand";
    write_report(incomplete.report, incomplete.folder);
    EXPECT_THROW(accept_run(incomplete.folder, store), InputError);
    StoredRun leading_out(temporary.path() / "leading out");
    leading_out.report.played[0].frames[0].exr = "../run/frames/halogen-0.exr";
    write_report(leading_out.report, leading_out.folder);
    EXPECT_THROW(accept_run(leading_out.folder, store), InputError);
    EXPECT_FALSE(fs::exists(store));
}

TEST_F(Baselines, TheCommandSaysWhatItTookAndFailsInOneSentence) {
    const Outcome taken = run_program("accept '" + run.folder.string() + "' --baselines '" + store.string() + "'");
    EXPECT_EQ(taken.exit_code, 0) << taken.output;
    EXPECT_EQ(taken.output, id_of("halogen") + "  straight/halogen/photometric: new\n" + id_of("xenon") +
                                "  straight/xenon/photometric: new\naccepted into " + store.string() +
                                ": 2 lamp sets with 4 frames and 4 readings\n");
    EXPECT_TRUE(all_pass(run.judged(store)));
    const Outcome refused = run_program("accept '" + (temporary / "nowhere") + "'");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr("nowhere: is no folder of a run, a study or a reference"));
    const Outcome unwritable = run_program("accept '" + run.folder.string() + "' --baselines /proc/baselines");
    EXPECT_EQ(unwritable.exit_code, 3) << unwritable.output;
    EXPECT_EQ(std::ranges::count(unwritable.output, '\n'), 1);
}

} // namespace
} // namespace fernlicht
