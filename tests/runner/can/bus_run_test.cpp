// Drives by a bus through the program: the shipped recording, faults in it, what is sent, what the report says, what is refused.
#include "runner/commands/run_files.h"
#include "scenarios/values/files.h"
#include "tests/runner/program.h"
#include "tests/runner/run_readings.h"
#include "tests/runner/sample_report.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::HasSubstr, testing::IsEmpty, testing::Not;
using Json = nlohmann::json;

constexpr const char* few = " --quiet --no-accuracy --resolution 96x72 --frames 95:104 --capture all ";

std::string shipped_drive() { return library_file("drives/s-bend-can.yaml"); }

/// Lines of the recording, changed or left out by `change` (seconds since its start, line).
std::string recording_with(const std::function<bool(double, std::string&)>& change) {
    std::istringstream lines(content_of(library_file("can/s-bend.log")));
    std::string text;
    for (std::string line; std::getline(lines, line);)
        if (change(std::stod(line.substr(1, 17)) - 1000.0, line))
            text += line + '\n';
    return text;
}

std::string content_below(const std::filesystem::path& folder, const std::string& suffix) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().string().ends_with(suffix))
            files.push_back(entry.path());
    std::ranges::sort(files);
    std::string text;
    for (const std::filesystem::path& file : files)
        text += file.filename().string() + content_of(file);
    return text;
}

class BusRun : public testing::Test {
  protected:
    std::string run(const std::string& flags, int exit_code = 0) {
        std::string out = folder / fmt::format("out{}", ++runs);
        said = run_program("run " + shipped_drive() + few + flags + " --out " + out);
        EXPECT_EQ(said.exit_code, exit_code) << said.output;
        return out;
    }
    std::string refused(const std::string& arguments) {
        const Outcome outcome = run_program(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
        return outcome.output;
    }

    TemporaryFolder folder;
    Outcome said;
    int runs = 0;
};

TEST_F(BusRun, TheShippedRecordingIsWhatTheToolMakesOfTheScript) {
    const std::string made = folder / "again.log";
    EXPECT_EQ(run_program("can record " + shipped_drive() + " --lamp-set bend-light --can-start 1000 --out " + made).exit_code, 0);
    EXPECT_TRUE(content_of(made) == content_of(library_file("can/s-bend.log")));
    EXPECT_LT(content_of(made).size(), 1'000'000U);
}

TEST_F(BusRun, TwiceTheSameBytesAndTheScriptsPicturesWhereSignalsSayTheSame) {
    const std::string first = run(""), again = run("");
    EXPECT_TRUE(content_below(first, ".exr") == content_below(again, ".exr"));
    EXPECT_TRUE(content_below(first, ".png") == content_below(again, ".png"));
    const std::string sent = content_below(first, ".log");
    EXPECT_TRUE(sent == content_below(again, ".log"));
    EXPECT_THAT(sent, HasSubstr("(0000001000.000000) can0 210#0000000000000000\n"));
    EXPECT_TRUE(content_of(first + "/signals-s-bend-can-1-bend-light.csv") == content_of(again + "/signals-s-bend-can-1-bend-light.csv"));

    // The drive with the doubles of the recording, by which yaw rates are the script's to the last bit.
    std::string exact = content_of(shipped_drive());
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"signal: Turning.YawRate", "signal: Exact.YawRate"},
                                   {"signal: Turning.RoadWheelAngle", "signal: Exact.RoadWheelAngle"},
                                   {"signal: Travel.Speed", "signal: Exact.Speed"}})
        exact.replace(exact.find(from), from.size(), to);
    for (std::size_t at; (at = exact.find(": ../")) != std::string::npos;)
        exact.replace(at, 5, ": " + library_file(""));
    std::ofstream(folder / "exact.yaml") << exact;
    const auto play = [&](const std::string& flags) {
        std::string out = folder / fmt::format("exact{}", ++runs);
        const Outcome outcome = run_program("run " + (folder / "exact.yaml") + few + flags + " --out " + out);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
        return out;
    };
    const std::string by_bus = play(""), by_script = play(" --can-log none");
    const std::string pictures = content_below(by_bus, ".exr");
    EXPECT_GT(pictures.size(), 1000U);
    EXPECT_TRUE(pictures == content_below(by_script, ".exr"));
    EXPECT_TRUE(content_below(by_bus, ".png") == content_below(by_script, ".png"));
    // Same lamp commands too, as long as the speed is constant; without a recording they are stamped from 0.
    std::istringstream a(content_of(by_bus + "/can-s-bend-can-1-bend-light.log")),
        b(content_of(by_script + "/can-s-bend-can-1-bend-light.log"));
    std::size_t lines = 0;
    for (std::string one, other; std::getline(a, one) && std::getline(b, other) && std::stod(other.substr(1)) < 20.0; ++lines) {
        ASSERT_EQ(std::stod(one.substr(1)), std::stod(other.substr(1)) + 1000.0);
        ASSERT_EQ(one.substr(one.find(") ")), other.substr(other.find(") "))) << "line " << lines + 1;
    }
    EXPECT_GT(lines, 900U);
}

TEST_F(BusRun, FaultsAreShownWithTheirPolicies) {
    std::ofstream(folder / "faulty.log") << recording_with([](double s, std::string& line) {
        const std::string id = line.substr(25, 4);
        if (id == "120#" && s > 9.0 && s < 9.7)
            return false; // yaw rate and wheels are silent
        if (id == "110#" && s > 10.0 && s < 10.2)
            line.replace(29, 4, "FFFF"); // 655 km/h
        return true;
    });
    const std::string out = run("--can-log " + (folder / "faulty.log"));
    const Json report = Json::parse(content_of(out + "/report.json"));
    EXPECT_THAT(tests::complaints(report, "run/report"), IsEmpty());
    const Json& signals = report["drives"][1]["signals"];
    EXPECT_EQ(signals["log"], "faulty.log");
    EXPECT_EQ(signals["start_s"], 1000.0);
    const Json &speed = signals["inputs"][0], &yaw = signals["inputs"][1];
    EXPECT_EQ(speed["name"], "ego.speed_mps");
    // 10.02 to 10.18 s: nine ticks of 20 ms.
    EXPECT_EQ(speed["ticks"]["out_of_range"], 9);
    EXPECT_EQ(speed["policy_acted"]["out_of_range"], 9);
    EXPECT_EQ(speed["states"][1], Json::parse(R"({"from_s": 10.02, "state": "out_of_range"})"));
    EXPECT_EQ(speed["states"][2], Json::parse(R"({"from_s": 10.2, "state": "fresh"})"));
    const std::string moments = out + "/moments-s-bend-can-1-bend-light.csv";
    EXPECT_EQ(tests::moments_of(moments, "ego.speed_mps [km/h]"), std::vector<std::string>(10, "64.4")) << "held";
    EXPECT_EQ(tests::moments_of(moments, "ego.speed_mps [km/h].received")[6], "655.35");
    // The last frame at 9.00 s; in the bend the second source goes on at once, which is a contradiction until after three cycles of 20 ms
    // the first is stale, from the tick of 9.08 s until 9.70 s.
    EXPECT_EQ(yaw["states"][1], Json::parse(R"({"from_s": 9.02, "state": "contradictory"})"));
    EXPECT_EQ(yaw["states"][2], Json::parse(R"({"from_s": 9.08, "state": "stale"})"));
    EXPECT_EQ(yaw["states"][3], Json::parse(R"({"from_s": 9.7, "state": "fresh"})"));
    EXPECT_EQ(yaw["ticks"]["stale"], 31);
    EXPECT_EQ(yaw["policy_acted"]["stale"], 31);
    EXPECT_EQ(yaw["age_max_s"], 0.68);
    const std::vector<std::string> yaw_rate = tests::moments_of(moments, "ego.yaw_rate_rad_s [" + yaw["unit"].get<std::string>() + "]");
    EXPECT_EQ(yaw_rate[0], "") << "9.5 s: lost";
    EXPECT_NE(yaw_rate[3], "") << "9.8 s";
    EXPECT_EQ(yaw["policies"]["stale"], "lost");
    const std::string page = content_of(out + "/report.html");
    EXPECT_THAT(page, HasSubstr(">Signals</h3>"));
    EXPECT_THAT(page, HasSubstr("out of range 0.643 %"));
    const std::string csv = content_of(out + "/signals-s-bend-can-1-bend-light.csv");
    EXPECT_THAT(csv, HasSubstr(",ego.yaw_rate_rad_s.state,ego.yaw_rate_rad_s.age_s"));
    EXPECT_THAT(csv, HasSubstr(",stale,0.5"));
}

TEST_F(BusRun, ASignalThatNoFrameHeldIsWarnedOf) {
    std::ofstream(folder / "without.log") << recording_with([](double, std::string& line) { return line.substr(25, 4) != "120#"; });
    const std::string out = run("--can-log " + (folder / "without.log"));
    const Json report = Json::parse(content_of(out + "/report.json"));
    EXPECT_THAT(report["warnings"].dump(),
                HasSubstr("no frame held Turning.YawRate, which ego.yaw_rate_rad_s comes from, at any tick; policy: "));
    EXPECT_THAT(content_of(out + "/report.html"), HasSubstr("no frame held Turning.YawRate"));
}

TEST_F(BusRun, WithoutABusThereIsNoSection) {
    Report report = tests::sample_report(2);
    EXPECT_THAT(report_html(report, {}), Not(HasSubstr(">Signals</h3>")));
    EXPECT_FALSE(Json::parse(report_json(report))["drives"][0].contains("signals"));
}

TEST_F(BusRun, APolicyToFailEndsTheRunWithASentence) {
    std::ofstream(folder / "late.log") << recording_with(
        [](double s, std::string& line) { return line.substr(25, 4) != "110#" || s > 5.0; });
    const std::string sentence =
        refused("run " + shipped_drive() + few + "--can-log " + (folder / "late.log") + " --out " + (folder / "o"));
    EXPECT_THAT(sentence, HasSubstr("s-bend-can.yaml:"));
    EXPECT_THAT(
        sentence,
        HasSubstr("can.inputs.ego.speed_mps: ego.speed_mps of Travel.Speed is missing: no frame until 0.080 s (recording late.log), "
                  "expected a fresh value, because its policy is to fail"));
    EXPECT_FALSE(std::filesystem::exists(folder / "o"));
}

TEST_F(BusRun, WhatIsWrongIsOneSentence) {
    std::ofstream(folder / "empty.log") << "# nothing\n";
    std::ofstream(folder / "torn.log") << "(1000.000000) can0 110#28190000\n(1000.020000) can0 110#2\n";
    const std::string drive = "run " + shipped_drive() + " --out " + (folder / "o") + " ";
    EXPECT_THAT(refused(drive + "--can-log " + (folder / "empty.log")), HasSubstr("found a recording without frames"));
    EXPECT_THAT(refused(drive + "--can-log " + (folder / "torn.log")), HasSubstr("torn.log:2"));
    EXPECT_THAT(refused(drive + "--can-log " + (folder / "absent.log")), HasSubstr("absent.log"));
    EXPECT_THAT(refused(drive + "--can-start 5000"),
                HasSubstr("found stamps from -4000.000000 s to -3972.020000 s of the drive, expected frames "
                          "of its 28 s"));
    EXPECT_THAT(refused(drive + "--can-start soon"), HasSubstr("--can-start"));
    EXPECT_THAT(refused(drive + "--can-channel can7"), HasSubstr("s-bend.log: found no frame of channel 'can7', but can0 ("));
    std::ofstream(folder / "unstamped.log") << "  can0  110   [4]  28 19 00 00\n";
    EXPECT_THAT(refused(drive + "--can-log " + (folder / "unstamped.log")),
                HasSubstr("unstamped.log:1: found a frame without a stamp, expected stamps to play by"));
    std::ofstream(folder / "foreign.log") << "(1000.000000) can0 7F0#28190000\n(1001.000000) can1 7F1#\n";
    EXPECT_THAT(refused(drive + "--can-log " + (folder / "foreign.log")),
                HasSubstr("found no frame with an identifier that can.inputs read, but can0 (1 frame), can1 (1 frame)"));
    std::ofstream(folder / "short.log") << "(1000.000000) can0 110#\n(1001.000000) can0 110#\n";
    EXPECT_THAT(refused(drive + "--can-log " + (folder / "short.log")),
                HasSubstr("found 2 frames that can.inputs read, all too short for their signals"));
    EXPECT_THAT(refused("run " + library_file("drives/s-bend.yaml") + " --can-log " + (folder / "torn.log") + " --out " + (folder / "o")),
                HasSubstr("found a drive without `can`"));
    EXPECT_THAT(refused("can record " + library_file("drives/s-bend.yaml")), HasSubstr("without `can`"));
    EXPECT_THAT(refused("can record " + shipped_drive() + " --lamp-set bend"), HasSubstr("one of straight-ahead, bend-light"));
}

} // namespace
} // namespace fernlicht
