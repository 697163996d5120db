#include "runner/references.h"

#include "runner/accept_command.h"
#include "runner/picture_file.h"
#include "runner/reference_store.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "tests/runner/program.h"

#include <chrono>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A small run on disk: two lamp sets, two frames each, a few readings. `light` scales all of it.
struct StoredRun {
    explicit StoredRun(const fs::path& folder_, double light = 1.0) : folder(folder_) {
        fs::create_directories(folder / "frames");
        report.context.backend = "egl";
        report.context.gl_renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
        report.context.cpu = "Some CPU @ 2 GHz (avx2)";
        report.context.command = "fernlicht run straight.yaml";
        report.context.started_utc = "2026-01-31T22:15:00Z";
        for (const char* variant : {"halogen", "xenon"})
            report.played.push_back(played(variant, light));
        write_report(report, folder);
    }

    PlayedVariant played(const std::string& variant, double light) const {
        PlayedVariant result;
        result.drive = "straight";
        result.variant = variant;
        result.technique = "photometric";
        result.ticks_planned = result.ticks_done = 20;
        result.readings = {{"reach_5lx_road_own_m", 60.0 * light, "m", "", -1, ""},
                           {"reach_1lx_road_own_m", {}, "m", "", -1, "beyond"},
                           {"frame_time_median_ms", 12.5 + 100.0 * light, "ms", "", -1, ""}};
        for (const int tick : {0, 10}) {
            const std::string exr = "frames/" + variant + "-" + std::to_string(tick) + ".exr";
            write_frame(exr, tick, light);
            result.frames.push_back({tick, 0.1 * tick, "driver", "", exr});
        }
        return result;
    }

    void write_frame(const std::string& exr, int tick, double light) const {
        Frame frame;
        frame.illuminance_lx = Image<float>(64, 48);
        frame.luminance_cdm2 = Image<float>(64, 48);
        for (std::size_t i = 0; i < frame.illuminance_lx.size(); ++i) {
            frame.illuminance_lx.pixels()[i] = static_cast<float>(light * (1.0 + static_cast<double>(i % 64) + tick));
            frame.luminance_cdm2.pixels()[i] = static_cast<float>(light * 0.05 * static_cast<double>(i / 64));
        }
        View view;
        view.name = "driver";
        view.width_px = 64;
        view.height_px = 48;
        Moment moment;
        moment.tick = tick;
        write_exr(frame, moment, view, folder / exr);
    }

    std::vector<Verdict> judged(const fs::path& references) const {
        return judge_against_references(report.played[0], report.context, folder, references, "photometric");
    }

    fs::path folder;
    Report report;
};

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

class References : public ::testing::Test {
  protected:
    TemporaryFolder temporary;
    const fs::path store = temporary.path() / "references";
    const StoredRun run{temporary.path() / "run"};
};

TEST_F(References, TheSameRunAgrees) {
    const Accepted accepted = accept_run(run.folder, store);
    EXPECT_EQ(accepted.drives, 2U);
    EXPECT_EQ(accepted.frames, 4U);
    EXPECT_EQ(accepted.readings, 4U) << "two readings of each lamp set; times are none";
    const auto verdicts = run.judged(store);
    EXPECT_TRUE(all_pass(verdicts)) << texts(verdicts);
    ASSERT_EQ(verdicts.size(), 2U);
    EXPECT_THAT(verdicts[0].text, HasSubstr("2 readings agree"));
    EXPECT_THAT(verdicts[1].text, HasSubstr("4 pictures agree"));
    EXPECT_EQ(verdicts[0].rerun, "fernlicht run straight.yaml");
}

TEST_F(References, NothingAcceptedIsRed) {
    const auto verdicts = run.judged(store);
    ASSERT_EQ(verdicts.size(), 1U);
    EXPECT_EQ(verdicts[0].kind, VerdictKind::fail);
    EXPECT_THAT(verdicts[0].text, HasSubstr("straight, halogen, photometric; egl, llvmpipe (LLVM 15.0.6, 256 bits), avx2"));
    EXPECT_FALSE(fs::exists(store)) << "comparing must not make references";
}

TEST_F(References, AnotherClassOfDeviceOrTechniqueHasNoReference) {
    accept_run(run.folder, store);
    const PlayedVariant& played = run.report.played[0];
    EXPECT_FALSE(all_pass(judge_against_references(played, run.report.context, run.folder, store, "as-published")));
    RunContext context = run.report.context;
    context.cpu = "Another CPU (avx2)";
    EXPECT_TRUE(all_pass(judge_against_references(played, context, run.folder, store, "photometric")));
    context.cpu = "Another CPU (avx512)";
    EXPECT_FALSE(all_pass(judge_against_references(played, context, run.folder, store, "photometric")));
    context = run.report.context;
    context.backend = "osmesa";
    EXPECT_FALSE(all_pass(judge_against_references(played, context, run.folder, store, "photometric")));
}

TEST_F(References, AFrameTwoPercentOffIsRed) {
    accept_run(run.folder, store);
    run.write_frame(run.report.played[0].frames[1].exr, 10, 1.02);
    const auto verdicts = run.judged(store);
    ASSERT_EQ(verdicts.size(), 3U) << texts(verdicts);
    EXPECT_EQ(verdicts[0].kind, VerdictKind::pass) << "the readings still agree";
    EXPECT_EQ(verdicts[1].kind, VerdictKind::fail);
    EXPECT_EQ(verdicts[1].name, "reference frame 10 driver");
    EXPECT_THAT(verdicts[1].text, HasSubstr("illuminance.lx: maximum 1.48 at pixel 63, 0"));
    EXPECT_THAT(verdicts[2].text, HasSubstr("luminance.cdm2"));
}

TEST_F(References, AReadingTwoPercentOffIsRed) {
    accept_run(run.folder, store);
    StoredRun other = run;
    other.report.played[0].readings[0].value = 61.2;
    const auto verdicts = other.judged(store);
    EXPECT_EQ(verdicts[0].kind, VerdictKind::fail);
    EXPECT_EQ(verdicts[0].name, "reference reading reach_5lx_road_own_m");
    EXPECT_EQ(verdicts[0].text, "61.2 m, accepted 60 m, 2 % off, at most 0.1 %");
}

TEST_F(References, WhatOnlyOneSideHasIsRed) {
    accept_run(run.folder, store);
    StoredRun other = run;
    other.report.played[0].readings[1].value = 90.0;
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("reach_1lx_road_own_m: 90 m, accepted not measured"));
    other = run;
    other.report.played[0].readings.erase(other.report.played[0].readings.begin());
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("not in this run, accepted 60 m"));
    other = run;
    other.report.played[0].readings.push_back({"new_m", 1.0, "m", "", -1, ""});
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("new_m: 1 m, nothing accepted"));
    other = run;
    other.report.played[0].frames.pop_back();
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("10 driver: accepted, but not in this run"));
    other = run;
    other.report.played[0].frames[1].tick = 11;
    EXPECT_THAT(texts(other.judged(store)), HasSubstr("11 driver: nothing accepted to compare with"));
    for (const auto& verdicts : {other.judged(store)})
        EXPECT_FALSE(all_pass(verdicts));
}

TEST_F(References, ADamagedReferenceIsRed) {
    accept_run(run.folder, store);
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(store))
        if (entry.path().extension() == ".exr")
            fs::resize_file(entry.path(), 100);
    const auto verdicts = run.judged(store);
    ASSERT_EQ(verdicts.size(), 1U);
    EXPECT_EQ(verdicts[0].kind, VerdictKind::fail);
    EXPECT_THAT(verdicts[0].text, HasSubstr("is not the frame that was accepted"));
    accept_run(run.folder, store);
    EXPECT_TRUE(all_pass(run.judged(store))) << "accepting again mends it";
    for (const char* content : {"", "{", "[]", "{\"schema\": 1}", "{\"schema\": \"fernlicht references\", \"schema_version\": 7}"}) {
        std::ofstream(store / "index.json", std::ios::trunc) << content;
        EXPECT_FALSE(all_pass(run.judged(store))) << content;
        EXPECT_THROW(accept_run(run.folder, store), InputError) << content;
    }
}

TEST_F(References, ComparingChangesNothing) {
    accept_run(run.folder, store);
    const auto before = state_of(store);
    const StoredRun other(temporary.path() / "other", 1.5);
    EXPECT_FALSE(all_pass(other.judged(store)));
    EXPECT_EQ(state_of(store), before);
}

TEST_F(References, AcceptingTwiceIsAcceptingOnce) {
    accept_run(run.folder, store);
    const auto before = state_of(store);
    accept_run(run.folder, store);
    EXPECT_EQ(state_of(store), before);
}

TEST_F(References, ANewAcceptanceReplacesItsOwnKeysAndLeavesOthers) {
    accept_run(run.folder, store);
    StoredRun brighter(temporary.path() / "brighter", 1.5);
    brighter.report.played.pop_back(); // halogen alone
    write_report(brighter.report, brighter.folder);
    accept_run(brighter.folder, store);
    EXPECT_TRUE(all_pass(brighter.judged(store)));
    EXPECT_FALSE(all_pass(run.judged(store)));
    EXPECT_TRUE(all_pass(judge_against_references(run.report.played[1], run.report.context, run.folder, store, "photometric")));
    EXPECT_EQ(std::distance(fs::directory_iterator(store), fs::directory_iterator()), 3)
        << "index and two lamp sets; the old halogen is gone";
}

// The second lamp set's last frame is missing: by then the first set is copied already.
TEST_F(References, AnAcceptanceThatFailsHalfWayLeavesTheOldOnes) {
    accept_run(run.folder, store);
    const auto before = state_of(store);
    const StoredRun brighter(temporary.path() / "brighter", 1.5);
    fs::remove(brighter.folder / brighter.report.played[1].frames[1].exr);
    EXPECT_THROW(accept_run(brighter.folder, store), InputError);
    EXPECT_TRUE(all_pass(run.judged(store)));
    const auto index = content_of(store / "index.json");
    EXPECT_EQ(before.at("index.json"), content_hash(index.data(), index.size()));
}

// Killed at many moments, the store holds all of the old run or all of the new one: never a mixture, never half.
TEST_F(References, AKilledAcceptanceLeavesOneOfTheTwoRunsWhole) {
    const StoredRun brighter(temporary.path() / "brighter", 1.5);
    const auto start = std::chrono::steady_clock::now();
    accept_run(run.folder, store);
    const double whole_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    for (int round = 0; round < 24; ++round) {
        const bool to_brighter = round % 2 == 0;
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            accept_run(to_brighter ? brighter.folder : run.folder, store);
            ::_exit(0);
        }
        ::usleep(static_cast<useconds_t>(whole_us * round / 16.0)); // from at once to long after the end
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        const bool holds_old = all_pass(run.judged(store)), holds_new = all_pass(brighter.judged(store));
        ASSERT_NE(holds_old, holds_new) << "round " << round;
        for (const StoredRun* whole : {&run, &brighter})
            ASSERT_EQ(
                all_pass(judge_against_references(whole->report.played[1], whole->report.context, whole->folder, store, "photometric")),
                whole == &run ? holds_old : holds_new)
                << "round " << round;
    }
    accept_run(run.folder, store);
    EXPECT_TRUE(all_pass(run.judged(store)));
    for (const fs::directory_entry& entry : fs::directory_iterator(store))
        EXPECT_NE(entry.path().filename().string().front(), '.') << "left behind: " << entry.path();
}

TEST_F(References, RefusesWhatIsNoCompleteRun) {
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

TEST_F(References, TheCommandSaysWhatItTookAndFailsInOneSentence) {
    const Outcome taken = run_program("accept '" + run.folder.string() + "' --to '" + store.string() + "'");
    EXPECT_EQ(taken.exit_code, 0) << taken.output;
    EXPECT_EQ(taken.output, "accepted into " + store.string() + ": 2 lamp sets with 4 frames and 4 readings\n");
    EXPECT_TRUE(all_pass(run.judged(store)));
    const Outcome refused = run_program("accept '" + (temporary / "nowhere") + "'");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr("report.json"));
    const Outcome unwritable = run_program("accept '" + run.folder.string() + "' --to /proc/references");
    EXPECT_EQ(unwritable.exit_code, 3) << unwritable.output;
    EXPECT_EQ(std::ranges::count(unwritable.output, '\n'), 1);
}

TEST(ReadExr, GivesBackWhatWasWritten) {
    const TemporaryFolder temporary;
    const StoredRun run(temporary.path() / "run");
    const auto channels = read_exr(run.folder / run.report.played[0].frames[0].exr);
    ASSERT_EQ(channels.size(), 2U);
    EXPECT_EQ(channels[0].name, "illuminance.lx");
    EXPECT_EQ(channels[1].name, "luminance.cdm2");
    EXPECT_EQ(channels[0].values.width(), 64);
    EXPECT_EQ(channels[0].values.at(63, 47), 64.0F);
}

TEST(ReadExr, RefusesWhatIsNone) {
    const TemporaryFolder temporary;
    const StoredRun run(temporary.path() / "run");
    const fs::path exr = run.folder / run.report.played[0].frames[0].exr;
    EXPECT_THROW(read_exr(temporary / "missing.exr"), InputError);
    for (const std::uintmax_t size : {0U, 3U, 100U, 1000U}) {
        fs::copy_file(exr, temporary / "cut.exr", fs::copy_options::overwrite_existing);
        ASSERT_GT(fs::file_size(exr), size);
        fs::resize_file(temporary / "cut.exr", size);
        EXPECT_THROW(read_exr(temporary / "cut.exr"), InputError) << size;
    }
}

} // namespace
} // namespace fernlicht
