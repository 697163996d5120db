// `fernlicht live` from a recording at its own pace: what a machine without CAN in its kernel can show. On a bus: tests/can/cases.sh.
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

constexpr const char* drive = FERNLICHT_SOURCE_DIR "/tests/can/live.yaml";

/// Speed and yaw rate every 20 ms, light and switch every 7 ms, for so many seconds.
void write_bus_log(const std::string& file, double seconds) {
    std::ofstream log(file);
    for (int ms = 0; ms < 1000.0 * seconds; ++ms) {
        const double t = 1e-3 * ms;
        if (ms % 20 == 0) {
            const auto speed = static_cast<unsigned>(100.0 * (50.0 + 10.0 * std::sin(t)));
            const auto yaw = static_cast<std::uint16_t>(std::lround(800.0 * std::sin(0.9 * t)));
            log << fmt::format("({:.6f}) vcan0 101#{:02X}{:02X}{:02X}{:02X}00000000\n", 1000.0 + t, speed % 256, speed / 256, yaw % 256,
                               yaw / 256);
        }
        if (ms % 7 == 3)
            log << fmt::format("({:.6f}) vcan0 100#{:08X}{:02X}000000\n", 1000.0 + t, 3000 * ms, ms / 200 % 2);
    }
}

class Live : public testing::Test {
  protected:
    void SetUp() override { write_bus_log(folder / "bus.log", 4.0); }

    Outcome live(const std::string& flags) { return run_program(fmt::format("live {} {}", drive, flags)); }
    std::string content(const std::string& file) { return content_of(folder / file); }

    TemporaryFolder folder;
};

TEST_F(Live, IsTheSameDriveAsItsRecordingPlayedByRun) {
    const Outcome live_run = live(fmt::format("--can-log {} --duration 2 --out {}", folder / "bus.log", folder / "live"));
    ASSERT_EQ(live_run.exit_code, 0) << live_run.output;
    const std::size_t at = live_run.output.find("replay     fernlicht ");
    ASSERT_NE(at, std::string::npos) << live_run.output;
    const std::string replay = live_run.output.substr(at + 21, live_run.output.find('\n', at) - at - 21);
    const Outcome again = run_program(fmt::format("{} --no-accuracy --quiet --capture all --out {}", replay, folder / "again"));
    ASSERT_LE(again.exit_code, 1) << again.output;
    for (const char* const file : {"signals-live-bend-light.csv", "can-live-bend-light.log"}) {
        EXPECT_FALSE(content(std::string("live/") + file).empty()) << file;
        EXPECT_EQ(content(std::string("live/") + file), content(std::string("again/") + file)) << file;
    }
    int pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "live/frames/live-bend-light")) {
        EXPECT_EQ(content_of(entry.path()), content("again/frames/live-bend-light/" + entry.path().filename().string())) << entry.path();
        ++pictures;
    }
    EXPECT_GT(pictures, 0);
    // Lamps did move, and the switch did switch: equal files are no empty ones.
    const std::string sent = content("live/can-live-bend-light.log");
    EXPECT_THAT(sent, testing::AllOf(HasSubstr("201#000000"), HasSubstr("201#000064"), HasSubstr("202##0")));
    EXPECT_GT(std::ranges::count(sent, '\n'), 135);
}

TEST_F(Live, TakesItsTimeAndWithoutWaitingCommandsTheSame) {
    const auto began = std::chrono::steady_clock::now();
    const Outcome paced = live(fmt::format("--can-log {} --duration 1 --no-draw --out {}", folder / "bus.log", folder / "paced"));
    EXPECT_GE(std::chrono::steady_clock::now() - began, std::chrono::seconds(1) - std::chrono::milliseconds(20))
        << "the last tick begins a period before the end";
    const Outcome fast = live(fmt::format("--can-log {} --duration 1 --no-wait --out {}", folder / "bus.log", folder / "fast"));
    ASSERT_EQ(paced.exit_code, 0) << paced.output;
    ASSERT_EQ(fast.exit_code, 0) << fast.output;
    for (const char* const file : {"signals-live-bend-light.csv", "can-live-bend-light.log", "can-in-live-bend-light.log"})
        EXPECT_EQ(content(std::string("paced/") + file), content(std::string("fast/") + file)) << file;
    const Json live = Json::parse(content("paced/live.json"));
    EXPECT_EQ(live["ticks"], 50);
    EXPECT_EQ(live["ticks_planned"], 50);
    EXPECT_EQ(live["frames_used"], live["recorded"]);
    EXPECT_EQ(live["frames_late"], 0);
    EXPECT_EQ(live["outputs_due"], 70) << "every 20 ms and every 50 ms, from 0 s on";
    EXPECT_GE(live["lateness_s"]["p50"], 0.0);
    EXPECT_TRUE(live["socket"].is_null());
    const Json report = Json::parse(content("paced/report.json"));
    EXPECT_EQ(report["live"], live);
    EXPECT_THAT(tests::complaints(report, "run/report"), testing::IsEmpty());
    EXPECT_THAT(content("paced/report.html"), testing::AllOf(HasSubstr("How late ticks began"), HasSubstr("Lateness over the drive")));
}

TEST_F(Live, InterruptedItLeavesItsReport) {
    const Outcome outcome =
        run_shell(fmt::format("'" FERNLICHT_BINARY "' live {} --can-log {} --duration 60 --no-draw --out {} & pid=$!; while [ ! -e {} ]; "
                              "do sleep 0.05; done; sleep 0.5; kill -INT $pid; wait $pid",
                              drive, folder / "bus.log", folder / "cut", folder / "cut/can-live-bend-light.log"));
    EXPECT_EQ(outcome.exit_code, 130) << outcome.output;
    const Json report = Json::parse(content("cut/report.json"));
    EXPECT_EQ(report["complete"], false);
    EXPECT_EQ(report["interrupted"], "interrupted by the user");
    EXPECT_GT(report["live"]["ticks"], 5);
    EXPECT_LT(report["live"]["ticks"], 2000);
    EXPECT_TRUE(std::filesystem::exists(folder / "cut/signals-live-bend-light.csv"));
    EXPECT_TRUE(std::filesystem::exists(folder / "cut/INCOMPLETE"));
}

TEST_F(Live, APolicyThatFailsEndsTheDriveWithItsReport) {
    std::string text = content_of(drive);
    const std::string source = FERNLICHT_SOURCE_DIR;
    for (std::size_t at = 0; (at = text.find("../../scenarios", at)) != std::string::npos; at += source.size())
        text.replace(at, 5, source);
    text.replace(text.find("live.dbc"), 8, source + "/tests/can/live.dbc");
    text.replace(text.find("stale: hold, missing: default, default: 5"), 41, "stale: fail, missing: default, default: 5");
    std::ofstream(folder / "failing.yaml") << text;
    write_bus_log(folder / "short.log", 0.5);
    const Outcome outcome = run_program(fmt::format("live {} --can-log {} --duration 2 --no-wait --out {}", folder / "failing.yaml",
                                                    folder / "short.log", folder / "failed"));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("stale"));
    EXPECT_THAT(outcome.output, HasSubstr(folder / "failed/report.html"));
    const Json report = Json::parse(content("failed/report.json"));
    EXPECT_EQ(report["complete"], false);
    EXPECT_GT(report["live"]["ticks"], 20);
    EXPECT_LT(report["live"]["ticks"], 40);
}

TEST_F(Live, WarnsOfLampFilesAsRunDoes) {
    std::string text = content_of(drive);
    const std::string source = FERNLICHT_SOURCE_DIR;
    for (std::size_t at = 0; (at = text.find("../../scenarios", at)) != std::string::npos; at += source.size())
        text.replace(at, 5, source);
    text.replace(text.find("live.dbc"), 8, source + "/tests/can/live.dbc");
    text.replace(text.find("xenon-low.ies"), 13, "xenon-high.ies");
    std::ofstream(folder / "high.yaml") << text;
    const Outcome outcome = run_program(
        fmt::format("live {} --can-log {} --duration 0.5 --no-wait --out {}", folder / "high.yaml", folder / "bus.log", folder / "high"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output,
                HasSubstr("fernlicht: lamp file xenon-high.ies (bend-light: left; bend-light: right), function: it is a high beam"));
    EXPECT_THAT(content("high/report.html"), HasSubstr("on the mount of a low beam"));
}

TEST_F(Live, RefusesInOneSentence) {
    const auto refused = [&](const std::string& flags, int code, const std::string& text) {
        const Outcome outcome = run_program("live " + flags);
        EXPECT_EQ(outcome.exit_code, code) << flags << ": " << outcome.output;
        EXPECT_THAT(outcome.output, HasSubstr(text)) << flags;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    };
    const std::string d = drive, log = " --can-log " + (folder / "bus.log"), out = " --out " + (folder / "none");
    refused(d + out, 2, "--can");
    refused(d + " --can vcan0" + log + out, 2, "one of both");
    refused(d + " --can vcan0 --no-wait" + out, 2, "cannot be hurried");
    refused(d + " --can vcan0 --can-start 5.0" + out, 2, "--can-start");
    refused(d + log + " --can-start yesterday" + out, 2, "yesterday");
    refused(d + log + " --lamp-set halogen --no-draw" + out, 2, "bend-light");
    refused(library_file("drives/straight.yaml") + log + " --no-draw" + out, 2, "`can`");
    refused(d + " --can-log " + (folder / "no.log") + " --no-draw" + out, 2, "no.log");
    std::ofstream(folder / "empty.log") << "# nothing\n";
    refused(d + " --can-log " + (folder / "empty.log") + " --no-draw" + out, 2, "without frames");
    EXPECT_FALSE(std::filesystem::exists(folder / "none"));
    if (const int socket = ::socket(AF_CAN, SOCK_RAW, 1); socket < 0) // else ci/test-can has its cases
        refused(d + " --can vcan0" + out, 3, "this kernel has no CAN");
    else
        ::close(socket);
}

TEST_F(Live, ARecordingNeverReplacesAFile) {
    const std::string before = content("bus.log");
    const auto refused_record = [&](const std::string& record) {
        const Outcome outcome =
            live(fmt::format("--can-log {} --duration 1 --no-wait --record {} --out {}", folder / "bus.log", record, folder / "o"));
        EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
        EXPECT_FALSE(std::filesystem::exists(folder / "o")) << record;
        return outcome.output;
    };
    EXPECT_THAT(refused_record(folder / "bus.log"), HasSubstr("bus.log is there already, expected a new file"));
    EXPECT_EQ(content("bus.log"), before);
    std::filesystem::create_directory(folder / "d");
    EXPECT_THAT(refused_record(folder / "d"), HasSubstr("is there already"));
    EXPECT_THAT(refused_record(folder / "absent/new.log"), HasSubstr("there is no folder"));
}

} // namespace
} // namespace fernlicht
