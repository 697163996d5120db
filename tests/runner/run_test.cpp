// Whole runs through the program: real files in, a report out.
#include "tests/runner/program.h"
#include "tests/runner/run_readings.h"

#include <cmath>
#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using tests::field_of;
using tests::reading_of;

json report_of(const std::string& folder) { return json::parse(content_of(folder + "/report.json")); }

/// Plays a drive of the library with these flags into a folder; its report. Limits may be exceeded where `max_code` is 1.
json played(const std::string& drive, const std::string& flags, const std::string& out, int max_code = 1) {
    const Outcome run = run_program("run " + library_file("drives/" + drive + ".yaml") + " " + flags + " --out " + out);
    if (run.exit_code < 0 || run.exit_code > max_code)
        throw std::runtime_error(run.output);
    return report_of(out);
}

/// The report without what may differ between two runs: machine, date, durations.
json timeless(json report) {
    report.erase("context");
    report.erase("times");
    return report;
}

std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[std::filesystem::relative(entry.path(), folder).generic_string()] = content_of(entry.path());
    return files;
}

/// The same files with the same bytes; names the first that differs (whole pictures are no message).
testing::AssertionResult same_files(const std::filesystem::path& a, const std::filesystem::path& b) {
    const auto left = files_below(a), right = files_below(b);
    if (left.size() != right.size() || left.empty())
        return testing::AssertionFailure() << left.size() << " files against " << right.size();
    for (const auto& [name, content] : left)
        if (!right.contains(name) || right.at(name) != content)
            return testing::AssertionFailure() << name << " differs";
    return testing::AssertionSuccess();
}

constexpr const char* few_moments = " --quiet --frames 0:4 --resolution 96x72 --capture all ";

TEST(Run, TheWorkedExampleGives0386LuxOnBothPaths) {
    const TemporaryFolder folder;
    played("worked-example", "--quiet", folder / "out", 0);
    const double by_hand = 206.25 * 0.65 / std::pow(std::hypot(7.0, 0.65), 3); // 0.3859 lx
    EXPECT_NEAR(reading_of(folder / "out", "probe_road-7m_twin_lx"), by_hand, 1e-9);
    EXPECT_NEAR(reading_of(folder / "out", "probe_road-7m_lx"), by_hand, 2e-6);
}

/// The light goes on past the grid's end: one answer in every file.
TEST(Run, WhatLiesBeyondTheGridIsABoundEverywhere) {
    const TemporaryFolder folder;
    const json report = played("straight", "--lamp " + library_file("lamps/xenon-high.ies") + few_moments, folder / "out", 0);
    const json bound{{"at_least", 200.0}};
    EXPECT_EQ(field_of(folder / "out", "reach_1lx_target_own_m", "bound"), "at_least");
    EXPECT_EQ(reading_of(folder / "out", "reach_1lx_target_own_m"), 200.0);
    for (const json& summary : report.at("drives").at(0).at("summary"))
        if (summary.at("surface") == "target" && summary.at("lane") == "own" && summary.at("threshold_lx") == 1.0) {
            EXPECT_EQ(summary.at("reach_m").at("median"), bound);
            EXPECT_TRUE(summary.at("reach_m").at("mean").is_null());
        }
    EXPECT_THAT(content_of(folder / "out/readings.csv"), testing::ContainsRegex(",at_least,200,m,[^\n]*,reach_1lx_target_own_m,"));
    EXPECT_THAT(content_of(folder / "out/report.html"), testing::HasSubstr("&gt; 200.0"));
}

TEST(Run, AnIihsDriveMeasuresItsSensorsAsTheExtentDoes) {
    const TemporaryFolder folder;
    std::string drive = content_of(library_file("drives/iihs-straight.yaml"));
    const auto replace = [&](const std::string& from, const std::string& to) {
        for (std::size_t at = 0; (at = drive.find(from, at)) != std::string::npos; at += to.size())
            drive.replace(at, from.size(), to);
    };
    replace("../", library_file(""));
    replace("resolution_px: [1024, 768]", "resolution_px: [32, 24]");
    replace("extent: {thresholds_lx: [1, 3, 5, 10]}", "extent: false");
    replace("capture: {per_second: 0.5}", "capture: {per_second: 0}");
    std::ofstream(folder / "drive.yaml") << drive << "limits:\n  - {reading: sensor_right-edge_reach_5lx_m, at_least: 50}\n"
                                         << "  - {reading: glare_lane-centre_facing_max_lx, at_most: 1.4}\n";
    printed("run " + (folder / "drive.yaml") + " --quiet --no-accuracy --out " + (folder / "out"), 1); // xenon: more than 1.4 lx
    const std::string junit = content_of(folder / "out/junit.xml"), repeat = junit.substr(junit.find("repeat with: "), 1000);
    EXPECT_THAT(repeat.substr(0, repeat.find('<')),
                testing::AllOf(testing::HasSubstr("run " + (folder / "drive.yaml")), testing::Not(testing::HasSubstr("--out"))));
    const json report = report_of(folder / "out");
    // README's table has 61.5 m and 70.2 m for the own lane's right edge, by the rendered extent.
    EXPECT_NEAR(reading_of(folder / "out", "sensor_right-edge_reach_5lx_m", "halogen"), 61.5, 0.2);
    EXPECT_NEAR(reading_of(folder / "out", "sensor_right-edge_reach_5lx_m", "xenon"), 70.2, 0.2);
    EXPECT_GT(reading_of(folder / "out", "glare_lane-centre_facing_max_lx", "xenon"), 1.4);
    EXPECT_LT(reading_of(folder / "out", "glare_lane-centre_facing_max_lx", "halogen"), 1.4);
    EXPECT_EQ(report.at("drives")[0].at("seeing").size(), 3U);
    EXPECT_NE(content_of(folder / "out/report.html").find("Seeing and glare"), std::string::npos);
    EXPECT_NE(content_of(folder / "out/readings.csv").find("glare_lane-centre_de_boer_min"), std::string::npos);
}

TEST(Run, TwiceTheSameBytes) {
    const TemporaryFolder folder;
    const std::string drive = library_file("drives/straight.yaml");
    for (const std::string& out : {folder / "a", folder / "b"}) {
        const Outcome run =
            run_program("run " + drive + few_moments + "--out " + out, out.ends_with('b') ? "LP_NUM_THREADS=1" : "LP_NUM_THREADS=2");
        ASSERT_LE(run.exit_code, 1) << run.output;
    }
    EXPECT_TRUE(timeless(report_of(folder / "a")) == timeless(report_of(folder / "b")));
    for (const std::string csv : {"/readings.csv", "/moments-straight-1-halogen.csv", "/moments-straight-1-xenon.csv"})
        EXPECT_TRUE(content_of(folder / "a" + csv) == content_of(folder / "b" + csv)) << csv;
    EXPECT_TRUE(same_files(folder / "a/frames", folder / "b/frames"));
}

TEST(Run, TheResolvedDriveGivesTheSameBytes) {
    const TemporaryFolder folder;
    played("straight", few_moments, folder / "a");
    std::string resolved;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "a"))
        if (entry.path().extension() == ".yaml")
            resolved = entry.path().string();
    ASSERT_FALSE(resolved.empty());
    const Outcome second = run_program("run " + resolved + " --quiet --frames 0:4 --out " + (folder / "b"));
    ASSERT_LE(second.exit_code, 1) << second.output;
    EXPECT_TRUE(same_files(folder / "a/frames", folder / "b/frames"));
    EXPECT_TRUE(content_of(folder / "a/readings.csv") == content_of(folder / "b/readings.csv"));
}

TEST(Run, EglAndOsMesaAgree) {
    const TemporaryFolder folder;
    for (const std::string backend : {"egl", "osmesa"}) {
        const Outcome run = run_program("run " + library_file("drives/straight.yaml") + few_moments + "--backend " + backend + " --out " +
                                        (folder / backend));
        if (run.exit_code == 3)
            GTEST_SKIP() << run.output;
        ASSERT_LE(run.exit_code, 1) << run.output;
    }
    // One Mesa: equal to the byte.
    EXPECT_TRUE(same_files(folder / "egl/frames", folder / "osmesa/frames"));
}

TEST(Run, AnotherLampGivesAnotherReach) {
    const TemporaryFolder folder;
    const std::string even = library_file("lamps/even-0.33lx.csv");
    played("straight", few_moments + ("--lamp left=" + even) + " --lamp right=" + even, folder / "out");
    // 206.25 cd twice reach 1 lx on a facing target at sqrt(412.5) = 20.3 m from the lamps, a little less from the bumper ahead of them.
    EXPECT_NEAR(reading_of(folder / "out", "reach_1lx_target_own_m"), 20.3, 0.5);
}

/// Two signals at once are one wish: sent to a process and to its group, as a terminal or a wrapper does.
TEST(Run, AnInterruptedRunLeavesAValidReportThatSaysSo) {
    for (const int signals : {1, 2}) {
        const TemporaryFolder folder;
        const Outcome run =
            run_interrupted("run " + library_file("drives/straight.yaml") + " --resolution 64x48 --log-json --out " + (folder / "out"),
                            " moments", signals);
        EXPECT_EQ(run.exit_code, 1) << run.output;
        EXPECT_FALSE(report_of(folder / "out").at("complete").get<bool>());
        EXPECT_TRUE(std::filesystem::exists(folder / "out/report.html"));
        EXPECT_TRUE(std::filesystem::exists(folder / "out/INCOMPLETE"));
    }
}

TEST(Run, BadInputIsOneSentenceAndExitCodeTwo) {
    const TemporaryFolder folder;
    const std::string drive = library_file("drives/straight.yaml");
    for (const std::string& arguments : std::vector<std::string>{
             "run /nonexistent.yaml", "run " + drive + " --lamp /nonexistent.ies", "run " + drive + " --road /dev/null",
             "run " + drive + " --technique magic", "run " + drive + " --shadows maps", "run " + drive + " --backend vulkan",
             "run " + drive + " --resolution 0x0", "run " + drive + " --resolution 99999x99999", "run " + drive + " --frames 5:2",
             "run " + drive + " --frames 100000:100001", "run " + drive + " --frames x", "run", "run " + drive + " --no-such-flag",
             "run " + drive + " " + drive, "nonsense"}) {
        const std::string said = printed(arguments + " --out " + (folder / "out"), 2);
        EXPECT_FALSE(std::filesystem::exists(folder / "out")) << arguments;
        EXPECT_LT(said.size(), 800U) << said;
    }
}

TEST(Run, FramesSayWhatTheyMustBe) {
    for (const char* frames : {"-3:2", "5:2", "x"}) {
        const std::string said = printed("run " + library_file("drives/straight.yaml") + " --frames=" + frames, 2);
        EXPECT_NE(said.find("expected FIRST:LAST with FIRST 0 or more and FIRST <= LAST"), std::string::npos) << said;
    }
}

/// Not the drive, which may say nothing of shadows.
TEST(Run, AWrongShadowMethodIsThatOfTheFlag) {
    const TemporaryFolder folder;
    const std::string drive = library_file("drives/straight.yaml");
    for (const auto& [method, says] : {std::pair("foo", "--shadows: found 'foo', expected one of auto, none"),
                                       std::pair("volume", "(nearest: 'volumes')"), std::pair("''", "--shadows: found ''")}) {
        EXPECT_THAT(printed("run " + drive + " --shadows " + method + " --out " + (folder / "out"), 2),
                    testing::AllOf(testing::HasSubstr(says), testing::Not(testing::HasSubstr("straight.yaml"))));
        EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    }
}

/// Naive techniques have a map, published ones no shadows: neither hears of the method, and the report says so first.
TEST(Run, AShadowMethodThatTheTechniqueDoesNotUseIsAWarning) {
    const TemporaryFolder folder;
    const auto warnings = [&](const std::string& name, const std::string& flags) {
        const std::string out = folder / name;
        const Outcome run =
            run_program("run " + library_file("drives/straight.yaml") +
                        " --quiet --frames 3:4 --resolution 64x48 --no-accuracy --backend software " + flags + " --out " + out);
        EXPECT_LE(run.exit_code, 1) << run.output;
        const json report = report_of(out);
        std::string all;
        for (const json& warning : report.at("warnings"))
            if (warning.get<std::string>().find("shadows by") != std::string::npos) {
                all += warning.get<std::string>() + '\n';
                EXPECT_THAT(run.output, testing::HasSubstr("fernlicht: " + warning.get<std::string>() + '\n'));
            }
        return all;
    };
    EXPECT_EQ(
        warnings("naive", "--technique photometric-naive --shadows volumes"),
        "straight-1: shadows by 'volumes' were asked for, and technique photometric-naive does not use it: its shadows are those of a "
        "map for each lamp\n");
    EXPECT_THAT(warnings("full", "--technique full --shadows auto"),
                testing::HasSubstr("shadows by 'auto' were asked for, and technique full does not use it: it renders no shadows of lamps"));
    EXPECT_THAT(content_of(folder / "full/report.html"), testing::HasSubstr("it renders no shadows of lamps"));
    EXPECT_EQ(warnings("map", "--technique photometric-naive --shadows map"), "");
    EXPECT_EQ(warnings("none", "--technique full --shadows none"), "");
    EXPECT_EQ(warnings("ours", "--technique photometric-unpruned --shadows volumes"), "");
}

TEST(Run, NothingIsOverwritten) {
    const TemporaryFolder folder;
    const std::string command = "run " + library_file("drives/worked-example.yaml") + " --quiet --out " + (folder / "out");
    ASSERT_EQ(run_program(command).exit_code, 0);
    const auto before = files_below(folder / "out");
    printed(command, 2);
    EXPECT_TRUE(files_below(folder / "out") == before);
}

/// Where a folder is a file system of its own with these options; skipped where nobody may mount.
TEST(Run, AFullDiskAndAReadOnlyFolderAreOneSentence) {
    const TemporaryFolder folder;
    const std::string path = folder.path().string(), script = path + ".sh";
    const auto says = [&](const std::string& options, const std::string& run, int code, const std::vector<const char*>& words) {
        std::ofstream(script) << "mount -t tmpfs -o " << options << " tmpfs " << path << " || exit 77\n'" FERNLICHT_BINARY "' run "
                              << library_file("drives/") << run << "\ncode=$?\nls -A " << path << "\nexit $code\n";
        const Outcome outcome = run_shell("unshare --mount sh " + script);
        std::filesystem::remove(script);
        if (outcome.exit_code == 77 || outcome.output.find("unshare") != std::string::npos)
            return false;
        EXPECT_EQ(outcome.exit_code, code) << outcome.output;
        for (const char* word : words)
            EXPECT_THAT(outcome.output, testing::HasSubstr(word));
        return true;
    };
    const bool may_mount = says("size=1500k", "straight.yaml --quiet --capture all --frames 0:40 --resolution 256x192 --out " + path, 3,
                                {"No space left on device", "INCOMPLETE", "frames"});
    if (!may_mount || !says("ro", "worked-example.yaml --quiet --out " + (folder / "out"), 2, {"Read-only file system"}))
        GTEST_SKIP() << "no right to mount here";
}

TEST(ProgramCommandLine, AWordThatIsNoCommandIsNamed) {
    const std::string unknown = printed("diference a.png b.png", 2);
    EXPECT_THAT(unknown, testing::StartsWith(
                             "fernlicht: 'diference' is no command, expected one of new, check, open, run, live, film, study, bench, "));
    EXPECT_THAT(unknown, testing::EndsWith("history, migrate, docs\n")) << "man and completions are hidden";
    EXPECT_EQ(printed("stdy", 2), "fernlicht: 'stdy' is no command, expected study\n");
    EXPECT_EQ(run_shell("'" FERNLICHT_BINARY "' techniques > /dev/full").exit_code, 3) << "a full disk";
    EXPECT_EQ(run_program("").exit_code, 2);
    EXPECT_EQ(run_program("--version").exit_code, 0);
    EXPECT_EQ(run_program("run --help").exit_code, 0);
}

TEST(Doctor, FindsAWayToDraw) {
    const std::string doctor = printed("doctor");
    for (const char* word : {"egl", "osmesa", "sanity", "GPU clock", "kernel CAN", "disk", "GLM", "OpenImageIO"})
        EXPECT_NE(doctor.find(word), std::string::npos) << word << '\n' << doctor;
}

TEST(Doctor, FailsWhereNothingCanDraw) {
    const Outcome doctor = run_program("doctor", "LIBGL_DRIVERS_PATH=/nonexistent GALLIUM_DRIVER=nonsense");
    if (doctor.exit_code == 0)
        GTEST_SKIP() << "this Mesa draws all the same";
    EXPECT_EQ(doctor.exit_code, 3) << doctor.output;
    EXPECT_NE(doctor.output.find("nothing here can render"), std::string::npos) << doctor.output;
}

} // namespace
} // namespace fernlicht
