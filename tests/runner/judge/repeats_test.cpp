#include "runner/judge/repeats.h"

#include "tests/runner/program.h"
#include "tests/runner/stored_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using tests::StoredRun;

class RepeatedPlays : public ::testing::Test {
  protected:
    /// The verdict on the first play with one more.
    Verdict verdict() {
        PlayedCell& first = run.report.played[0];
        RepeatFold fold(first, run.folder, played_json);
        equal = fold.add(again.report.played[0], again.folder);
        PlayedCell finished = first;
        fold.finish(finished, 2);
        repeats = finished.repeats;
        return finished.verdicts.back();
    }

    TemporaryFolder temporary;
    StoredRun run{temporary.path() / "run"};
    StoredRun again{temporary.path() / "again"};
    bool equal = false;
    Repeats repeats;
};

TEST_F(RepeatedPlays, EqualPlaysPass) {
    const Verdict found = verdict();
    EXPECT_TRUE(equal);
    EXPECT_EQ(found.kind, VerdictKind::pass);
    EXPECT_EQ(found.name, "repeats");
    EXPECT_EQ(found.text, "2 plays, equal to the byte: 3 readings, 2 stored frames and all else that is reported");
    EXPECT_EQ(repeats.count, 2);
    EXPECT_TRUE(repeats.spread.empty());
}

TEST_F(RepeatedPlays, ALastBitOfAReadingIsFlakyAndItsSpreadIsKept) {
    again.report.played[0].readings[0].value = std::nextafter(60.0, 61.0);
    const Verdict found = verdict();
    EXPECT_FALSE(equal);
    EXPECT_EQ(found.kind, VerdictKind::flaky);
    EXPECT_EQ(found.text, "of 2 plays not all are equal: play 2: reach_5lx_road_own_m: 60.00000000000001 m, at first 60 m");
    again.report.played[0].readings[0].value = 62.0;
    verdict();
    ASSERT_EQ(repeats.spread.size(), 1U);
    EXPECT_EQ(repeats.spread[0].count, 2);
    EXPECT_DOUBLE_EQ(repeats.spread[0].mean, 61.0);
    EXPECT_DOUBLE_EQ(repeats.spread[0].variance, 2.0) << "(1 + 1) / (2 - 1)";
}

TEST_F(RepeatedPlays, AByteOfAFrameIsFlaky) {
    const std::string exr = again.report.played[0].frames[1].exr;
    std::string bytes = content_of(again.folder / exr);
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(again.folder / exr, std::ios::binary) << bytes;
    EXPECT_THAT(verdict().text, HasSubstr("play 2: " + exr + " from byte " + std::to_string(bytes.size() / 2) + " on"));
    EXPECT_FALSE(equal);
    fs::remove(again.folder / exr);
    EXPECT_EQ(verdict().kind, VerdictKind::flaky);
}

TEST_F(RepeatedPlays, WhatIsNeitherReadingNorFrameCountsToo) {
    again.report.played[0].notes = {"another note"};
    EXPECT_THAT(verdict().text, HasSubstr("notes: [\"another note\"], at first []"));
    again.report.played[0].notes.clear();
    again.report.played[0].speed_mps = {{0.0, 1.0}};
    EXPECT_EQ(verdict().kind, VerdictKind::flaky);
    again.report.played[0].speed_mps.clear();
    run.report.played[0].verdicts = {{VerdictKind::pass, "frame_time_median_ms", "", ""}};
    again.report.played[0].verdicts = {{VerdictKind::fail, "frame_time_median_ms", "", ""}};
    EXPECT_THAT(verdict().text, HasSubstr("frame_time_median_ms: fail, at first pass"));
}

TEST_F(RepeatedPlays, TimesDoNotCount) {
    again.report.played[0].passes = {{"frame", {1.0, 2.0}}};
    again.report.played[0].throughput.wall_s = 3.0;
    again.report.played[0].verdicts.clear();
    EXPECT_EQ(verdict().kind, VerdictKind::pass);
}

TEST(FirstDifference, NamesThePlace) {
    EXPECT_EQ(first_difference(R"({"a": [1, {"b": 2.5}]})", R"({"a": [1, {"b": 2.5}]})"), "");
    EXPECT_EQ(first_difference(R"({"a": [1, {"b": 2.5}]})", R"({"a": [1, {"b": 3.5}]})"), "a[1].b: 3.5, at first 2.5");
    EXPECT_EQ(first_difference(R"({"a": [1]})", R"({"a": [1, 2]})"), "a: [1,2], at first [1]");
    EXPECT_EQ(first_difference(R"({"a": 1})", R"({"b": 1})"), ": {\"b\":1}, at first {\"a\":1}");
}

const std::string four_small = " --quiet --no-accuracy --frames 0:3 --resolution 64x48 --capture all ";

TEST(Repeat, EqualPlaysAreOneGreenVerdictAndTheirFramesAreKeptOnce) {
    const TemporaryFolder folder;
    const Outcome run = run_program("run " + library_file("drives/worked-example.yaml") + " " + library_file("drives/straight.yaml") +
                                    four_small + "--repeat 3 --out " + (folder / "out"));
    ASSERT_LE(run.exit_code, 1) << run.output;
    const json report = json::parse(content_of(folder / "out/report.json"));
    EXPECT_EQ(report.at("verdict_counts").at("flaky"), 0);
    for (const json& played : report.at("drives")) {
        EXPECT_EQ(played.at("repeats").at("count"), 3);
        EXPECT_TRUE(played.at("repeats").at("differ").empty());
        EXPECT_EQ(played.at("verdicts").back().at("name"), "repeats");
        EXPECT_EQ(played.at("verdicts").back().at("verdict"), "pass");
    }
    EXPECT_FALSE(fs::exists(folder / "out/repeats"));
}

// Nothing here flickers by itself, so the test does: it turns a byte of a stored picture when the next is being written, long before the
// repeat is drawn.
TEST(Repeat, APictureThatDiffersIsFlakyInEveryReport) {
    const TemporaryFolder folder;
    const std::string out = folder / "out", script = folder / "flip.sh";
    std::ofstream(script) << "'" FERNLICHT_BINARY "' run " << library_file("drives/worked-example.yaml") << four_small
                          << "--repeat 2 --out " << out << " & run=$!\nuntil [ $(find " << out
                          << "/frames -name '*.png' 2>/dev/null | wc -l) -ge 2 ]; do kill -0 $run || exit 77; done\n"
                          << "printf X | dd of=$(find " << out
                          << "/frames -name '*.png' | sort | head -1) bs=1 seek=60 conv=notrunc 2>/dev/null\n"
                          << "wait $run\n";
    const Outcome run = run_shell("sh " + script);
    ASSERT_EQ(run.exit_code, 1) << run.output;
    EXPECT_THAT(run.output, HasSubstr("FLAKY"));
    EXPECT_THAT(run.output, HasSubstr("from byte 60 on"));
    const json report = json::parse(content_of(out + "/report.json"));
    EXPECT_EQ(report.at("verdict"), "flaky");
    EXPECT_EQ(report.at("verdict_counts").at("flaky"), 1);
    EXPECT_THAT(content_of(out + "/junit.xml"), HasSubstr("type=\"flaky\""));
    EXPECT_THAT(content_of(out + "/junit.xml"), HasSubstr("failures=\"1\""));
    EXPECT_THAT(content_of(out + "/report.html"), HasSubstr("Flaky: repeats that differ"));
    EXPECT_TRUE(fs::exists(out + "/repeats/2/frames")) << "both pictures are there to be looked at";
}

} // namespace
} // namespace fernlicht
