#include "runner/judge/known_failures.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"
#include "tests/runner/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string written(const TemporaryFolder& folder, const std::string& text) {
    std::ofstream(folder / "known.yaml", std::ios::trunc) << text;
    return folder / "known.yaml";
}

std::string entry(const std::string& id, const std::string& kind, const std::string& expires = "2026-12-31") {
    return "  - id: \"" + id + "\"\n    kind: " + kind + "\n    reason: a reason\n    expires: " + expires + "\n";
}

TEST(KnownFailures, RefusesInOneSentenceWithTheLine) {
    const TemporaryFolder folder;
    const std::vector<std::pair<std::string, std::string>> cases{
        {"", "is empty"},
        {"known: 3\n", "known.yaml:1:8: known"},
        {"knwon: []\n", "known.yaml:1:1"},
        {"known:\n" + entry("a/b/c/d", "fails") + "    why: not\n", "known.yaml:6:5"},
        {"known:\n" + entry("reach", "fails"), "known.yaml:2:9: known[0].id"},
        {"known:\n" + entry("a/b", "sometimes"), "known.yaml:3:11"},
        {"known:\n" + entry("a/b", "fails", "2026-02-30"), "known.yaml:5:14: known[0].expires: found '2026-02-30', expected a date"},
        {"known:\n" + entry("a/b", "fails", "soon"), "a date, e.g. 2026-12-31"},
        {"known:\n  - {id: a/b, kind: fails, expires: 2026-12-31}\n", "reason"},
        {"known:\n  - {id: a/b, kind: fails, reason: r}\n", "expires"},
        {"known:\n" + entry("a/b", "fails") + entry("a/b", "flaky"), "each id once; the first stands in line 2"}};
    for (const auto& [text, sentence] : cases)
        try {
            read_known_failures(written(folder, text));
            ADD_FAILURE() << text;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(sentence)) << text;
        }
}

TEST(KnownFailures, DatesAreThoseOfTheCalendar) {
    for (const char* date : {"2026-12-31", "2024-02-29", "2026-01-01"})
        EXPECT_TRUE(is_date(date)) << date;
    for (const char* date :
         {"2026-02-29", "2026-13-01", "2026-00-01", "2026-1-01", "26-01-01", "2026-01-0x", "2026/01/01", "", "2026-01-011"})
        EXPECT_FALSE(is_date(date)) << date;
}

TEST(KnownFailures, PatternsMatchWholeIds) {
    EXPECT_TRUE(matches("a/*/c", "a/b/c"));
    EXPECT_TRUE(matches("*", ""));
    EXPECT_TRUE(matches("a*", "abc"));
    EXPECT_TRUE(matches("*b*b", "abbab"));
    EXPECT_TRUE(matches("a?c", "abc"));
    EXPECT_FALSE(matches("a?c", "ac"));
    EXPECT_FALSE(matches("a/b", "a/bc"));
    EXPECT_FALSE(matches("a/b", "xa/b"));
    EXPECT_FALSE(matches("*b", "abc"));
    EXPECT_FALSE(matches("", "a"));
}

class Marked : public ::testing::Test {
  protected:
    Marked() {
        PlayedCell played{.drive = "straight",
                          .lamp_set = "halogen",
                          .technique = "photometric",
                          .verdicts = {{VerdictKind::fail, "too_short_m", "", ""},
                                       {VerdictKind::pass, "long_enough_m", "", ""},
                                       {VerdictKind::flaky, "repeats", "", ""},
                                       {VerdictKind::not_measured, "lost_m", "", ""}}};
        report.played = {played};
    }
    void apply(const std::string& entries, const std::string& today = "2026-06-30") {
        apply_known_failures(report, read_known_failures(written(folder, "known:\n" + entries)), today);
    }
    const Verdict& verdict(std::size_t i) const { return report.played[0].verdicts[i]; }

    TemporaryFolder folder;
    Report report;
};

TEST_F(Marked, WhatIsRedAsListedIsKnownUntilItsLastDay) {
    apply(entry("straight/halogen/photometric/too_short_m", "fails", "2026-06-30") + entry("straight/*/repeats", "flaky"));
    EXPECT_EQ(verdict(0).expectation, Expectation::known);
    EXPECT_EQ(verdict(0).known, "known to fail until 2026-06-30 (known.yaml:2: a reason)");
    EXPECT_EQ(verdict(2).expectation, Expectation::known);
    EXPECT_FALSE(is_red(verdict(0)) || is_red(verdict(2)));
    const VerdictCounts counts = count_verdicts(report);
    EXPECT_EQ(counts.known, 2U);
    EXPECT_EQ(counts.fail + counts.flaky, 0U);
    EXPECT_EQ(overall(report), VerdictKind::not_measured) << "the one that is not listed";
}

TEST_F(Marked, PastItsDayItIsRedAndSoIsTheEntry) {
    apply(entry("straight/halogen/photometric/too_short_m", "fails", "2026-06-29"));
    EXPECT_EQ(verdict(0).expectation, Expectation::expired);
    EXPECT_TRUE(is_red(verdict(0)));
    EXPECT_THAT(verdict(0).known, HasSubstr("was known to fail until 2026-06-29"));
    ASSERT_EQ(report.listed.size(), 1U);
    EXPECT_THAT(report.listed[0].text, HasSubstr("the entry held until 2026-06-29"));
}

TEST_F(Marked, AnUnexpectedPassIsRed) {
    report.played[0].verdicts.resize(2);
    apply(entry("straight/*/too_short_m", "fails") + entry("straight/*/long_enough_m", "fails"));
    EXPECT_EQ(verdict(1).expectation, Expectation::unexpected_pass);
    EXPECT_TRUE(is_red(verdict(1)));
    EXPECT_EQ(count_verdicts(report).unexpected_pass, 1U);
    EXPECT_EQ(count_verdicts(report).pass, 0U);
    EXPECT_EQ(overall(report), VerdictKind::fail);
}

TEST_F(Marked, AFlakeMayPassButNotFailAndAFailureMayNotFlake) {
    apply(entry("straight/*/long_enough_m", "flaky") + entry("straight/*/too_short_m", "flaky") + entry("straight/*/repeats", "fails") +
          entry("straight/*/lost_m", "fails"));
    for (const std::size_t i : {0U, 2U, 3U}) {
        EXPECT_TRUE(is_red(verdict(i))) << i;
        EXPECT_THAT(verdict(i).known, HasSubstr("which this is not"));
    }
    EXPECT_FALSE(is_red(verdict(1)));
}

TEST_F(Marked, AnEntryOfNoUseIsRedWhereItsDriveWasPlayedAndAWarningElsewhere) {
    apply(entry("straight/xenon/*", "fails") + entry("village/*", "fails"));
    ASSERT_EQ(report.listed.size(), 1U);
    EXPECT_THAT(report.listed[0].text, HasSubstr("names no verdict of this run"));
    ASSERT_EQ(report.warnings.size(), 1U);
    EXPECT_THAT(report.warnings[0], HasSubstr("village/*"));
}

// Through the program: a limit that no lamp keeps.
TEST(Known, GreenUntilItExpiresThenRed) {
    const TemporaryFolder folder;
    std::string drive = content_of(library_file("drives/worked-example.yaml"));
    const std::string probe = "probe_road-7m_lx";
    const std::string limit = probe + ", at_least: 0.3858, at_most: 0.3862";
    ASSERT_NE(drive.find(limit), std::string::npos);
    drive.replace(drive.find(limit), limit.size(), probe + ", at_least: 1000");
    for (std::size_t at = drive.find("../"); at != std::string::npos; at = drive.find("../", at + 1))
        drive.replace(at, 3, library_file(""));
    std::ofstream(folder / "drive.yaml") << drive;
    int number = 0;
    const auto run = [&](const std::string& arguments) {
        return run_program("run " + (folder / "drive.yaml") + " --quiet --no-accuracy --frames 0:3 --resolution 64x48 --out " +
                           (folder / ("out" + std::to_string(++number))) + " " + arguments);
    };
    ASSERT_EQ(run("").exit_code, 1);
    const std::string known = " --known " + written(folder, "known:\n" + entry("worked-example-1/*/" + probe, "fails", "2026-06-30"));
    const Outcome green = run(known + " --today 2026-06-30");
    EXPECT_EQ(green.exit_code, 0) << green.output;
    EXPECT_THAT(green.output, HasSubstr("known "));
    EXPECT_THAT(green.output, HasSubstr("1 passed, 1 known\n"));
    const std::string junit = content_of(folder / "out2/junit.xml");
    EXPECT_THAT(junit, HasSubstr("failures=\"0\" errors=\"0\" skipped=\"1\""));
    EXPECT_THAT(content_of(folder / "out2/report.html"), HasSubstr("Known failures"));
    EXPECT_EQ(json::parse(content_of(folder / "out2/report.json")).at("verdict"), "pass");
    const Outcome red = run(known + " --today 2026-07-01");
    EXPECT_EQ(red.exit_code, 1);
    EXPECT_THAT(red.output, HasSubstr("was known to fail until 2026-06-30"));
    written(folder,
            "known:\n" + entry("worked-example-1/*/" + probe, "fails") + entry("worked-example-1/*/probe_road-7m_twin_lx", "fails"));
    const Outcome passes = run(known + " --today 2026-06-30");
    EXPECT_EQ(passes.exit_code, 1);
    EXPECT_THAT(passes.output, HasSubstr("UNEXPECTED PASS"));
    EXPECT_THAT(content_of(folder / "out4/junit.xml"), HasSubstr("type=\"unexpected pass\""));
    for (const char* wrong : {" --today 2026-6-30", " --today 2026-06-31"})
        EXPECT_EQ(run(known + wrong).exit_code, 2) << wrong;
    EXPECT_EQ(run("--today 2026-06-30").exit_code, 2) << "nothing else asks for the day";
}

} // namespace
} // namespace fernlicht
