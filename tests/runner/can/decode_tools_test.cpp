// fernlicht can decode, encode and list, as a user runs them; beside cantools where python3 has it.
#include "tests/runner/program.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// Lamp: an indicator with labels, a speed, and bytes behind a multiplexor; Big: 64 bits and a double in CAN FD.
constexpr const char* database = R"(VERSION ""
BU_: Body Lamps
BO_ 256 Lamp: 8 Body
 SG_ Indicator : 0|2@1+ (1,0) [0|2] "" Lamps
 SG_ Speed : 15|16@0- (0.01,0) [-50|300] "km/h" Lamps
 SG_ Page M : 24|2@1+ (1,0) [0|0] "" Lamps
 SG_ Left m0 : 32|16@1- (0.1,0) [0|0] "deg" Lamps
 SG_ Right m1 : 32|16@1- (0.1,0) [0|0] "deg" Lamps
BO_ 2566844926 Big: 20 Body
 SG_ Counter : 0|64@1+ (1,0) [0|0] "" Lamps
 SG_ Ratio : 64|64@1- (1,0) [0|0] "" Lamps
VAL_ 256 Indicator 0 "off" 1 "left" 2 "right" ;
SIG_VALTYPE_ 2566844926 Ratio : 2;
BA_DEF_ BO_ "GenMsgCycleTime" INT 0 1000;
BA_ "GenMsgCycleTime" BO_ 256 20;
)";

// Speed 0x1388 = 5000 -> 50 km/h; Left 0xFFF6 = -10 -> -1 deg. Counter 2^64 - 1, Ratio 0.5 = 0x3FE0000000000000.
constexpr const char* good_log = "(1700000000.000001) can0 100#02138800F6FF0000\n"
                                 "(1700000000.000002) can0 100#01FFFF01\n"
                                 "(1700000000.000003) can1 18FEF1FE##1FFFFFFFFFFFFFFFF000000000000E03FDEADBEEF\n"
                                 "(1700000000.000004) can0 7FF#112233\n"
                                 "(1700000000.000005) can0 100#R8\n"
                                 "(1700000000.000006) can0 20000080#0000000000000000\n";

class CanCodecTools : public testing::Test {
  protected:
    void SetUp() override {
        std::ofstream(folder_ / "lamp.dbc") << database;
        std::ofstream(folder_ / "good.log") << good_log;
    }
    std::string dbc() const { return "--dbc '" + (folder_ / "lamp.dbc") + "'"; }
    std::string log() const { return "'" + (folder_ / "good.log") + "'"; }
    /// Standard output alone.
    std::string told(const std::string& arguments, const std::string& input = {}) const {
        std::ofstream(folder_ / "input", std::ios::binary) << input;
        const Outcome outcome =
            run_shell("( '" FERNLICHT_BINARY "' " + arguments + " < '" + (folder_ / "input") + "' > '" + (folder_ / "told") + "' )");
        EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.output;
        return content_of(folder_ / "told");
    }
    /// The one sentence of a refusal, without "fernlicht: ".
    std::string refusal(const std::string& arguments, const std::string& input = {}) const {
        std::ofstream(folder_ / "input", std::ios::binary) << input;
        const Outcome outcome = run_shell("( '" FERNLICHT_BINARY "' " + arguments + " < '" + (folder_ / "input") + "' > /dev/null )");
        EXPECT_EQ(outcome.exit_code, 2) << arguments << '\n' << outcome.output;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
        return outcome.output.substr(outcome.output.find(' ') + 1);
    }
    TemporaryFolder folder_;
};

TEST_F(CanCodecTools, DecodesForEyes) {
    EXPECT_EQ(told("can decode " + dbc() + " " + log()),
              "(1700000000.000001) can0 100#02138800F6FF0000 ::\n"
              "Lamp(\n    Indicator: right,\n    Speed: 50 km/h,\n    Page: 0,\n    Left: -1 deg\n)\n"
              "(1700000000.000002) can0 100#01FFFF01 ::\n"
              "Lamp(\n    Indicator: left,\n    Speed: -0.01 km/h,\n    Page: 1\n)\n"
              "(1700000000.000003) can1 18FEF1FE##1FFFFFFFFFFFFFFFF000000000000E03FDEADBEEF ::\n"
              "Big(\n    Counter: 18446744073709551615,\n    Ratio: 0.5\n)\n"
              "(1700000000.000004) can0 7FF#112233 :: Unknown frame id 2047 (0x7ff)\n"
              "(1700000000.000005) can0 100#R8\n"
              "(1700000000.000006) can0 20000080#0000000000000000\n");
    const std::string screen = "  can0  100   [4]  01 FF FF 01";
    EXPECT_EQ(told("can decode -s " + dbc(), screen + "\n"), screen + " :: Lamp(Indicator: left, Speed: -0.01 km/h, Page: 1)\n");
    EXPECT_THAT(told("can decode -s -c " + dbc(), screen + "\n"), HasSubstr("Lamp(Indicator: 1, Speed"));
}

TEST_F(CanCodecTools, ShowsOnlyWhatIsAskedFor) {
    EXPECT_EQ(told("can decode -s --only Lamp.Speed --only Ratio " + dbc() + " " + log()),
              "(1700000000.000001) can0 100#02138800F6FF0000 :: Lamp(Speed: 50 km/h)\n"
              "(1700000000.000002) can0 100#01FFFF01 :: Lamp(Speed: -0.01 km/h)\n"
              "(1700000000.000003) can1 18FEF1FE##1FFFFFFFFFFFFFFFF000000000000E03FDEADBEEF :: Big(Ratio: 0.5)\n");
    EXPECT_EQ(told("can decode -s --only Lamp/Left " + dbc() + " " + log()),
              "(1700000000.000001) can0 100#02138800F6FF0000 :: Lamp(Left: -1 deg)\n");
    EXPECT_EQ(
        told("can decode -s --only Big " + dbc() + " " + log()),
        "(1700000000.000003) can1 18FEF1FE##1FFFFFFFFFFFFFFFF000000000000E03FDEADBEEF :: Big(Counter: 18446744073709551615, Ratio: 0.5)\n");
    EXPECT_EQ(refusal("can decode --only Spede " + dbc()),
              "--only: found 'Spede', expected a message, a signal or MESSAGE.SIGNAL of the databases\n");
    const Outcome known = run_program("can decode -s --known " + dbc() + " " + log());
    EXPECT_THAT(known.output, HasSubstr("3 frames of 3 identifiers that no message describes left out"));
    EXPECT_THAT(known.output, testing::Not(HasSubstr("7FF")));
}

TEST_F(CanCodecTools, WritesATable) {
    EXPECT_EQ(told("can decode --csv --only Lamp " + dbc() + " " + log()),
              "time,channel,message,Lamp.Indicator,Lamp.Speed [km/h],Lamp.Page,Lamp.Left [deg],Lamp.Right [deg]\n"
              "1700000000.000001000,can0,Lamp,2,50,0,-1,\n1700000000.000002000,can0,Lamp,1,-0.01,1,,\n");
    std::ofstream(folder_ / "bare.txt") << "  can0  100   [8]  02 13 88 00 F6 FF 00 00\n";
    EXPECT_THAT(told("can decode --csv --only Speed " + dbc() + " '" + (folder_ / "bare.txt") + "'"), HasSubstr("\n,can0,Lamp,50"));
    EXPECT_EQ(refusal("can decode --csv --json " + dbc()), "--csv: found beside --json, expected one of the two\n");
}

TEST_F(CanCodecTools, JsonComesBackByteByByte) {
    const std::string json = told("can decode --json " + dbc() + " " + log());
    std::istringstream lines(json);
    std::string first;
    std::getline(lines, first);
    EXPECT_EQ(first, "{\"time\":1700000000.000001,\"channel\":\"can0\",\"id\":\"100\",\"data\":\"02138800F6FF0000\",\"message\":\"Lamp\","
                     "\"signals\":{\"Indicator\":2,\"Speed\":50,\"Page\":0,\"Left\":-1},\"labels\":{\"Indicator\":\"right\"},"
                     "\"units\":{\"Speed\":\"km/h\",\"Left\":\"deg\"}}");
    EXPECT_EQ(told("can encode " + dbc(), json), good_log);
    // What is changed on the way changes these bits alone: 51.5 km/h is 5150 = 0x141E.
    std::string changed = first;
    changed.replace(changed.find("\"Speed\":50"), 10, "\"Speed\":51.5");
    EXPECT_EQ(told("can encode " + dbc(), changed), "(1700000000.000001) can0 100#02141E00F6FF0000\n");
    std::string page = first; // the right lamp in place of the left
    page.replace(page.find("\"Page\":0,\"Left\":-1"), 18, "\"Right\":1.6,\"Indicator\":\"off\"");
    EXPECT_EQ(told("can encode " + dbc(), page), "(1700000000.000001) can0 100#0013880110000000\n");
    // From the values alone.
    EXPECT_EQ(told("can encode " + dbc(), R"({"message":"Big","signals":{"Counter":18446744073709551615,"Ratio":0.5}})"),
              "18FEF1FE##0FFFFFFFFFFFFFFFF000000000000E03F00000000\n");
    EXPECT_EQ(told("can encode " + dbc(), R"({"message":"Big","signals":{"Counter":9007199254740993}})"),
              "18FEF1FE##00100000000002000000000000000000000000000\n")
        << "2^53 + 1, which a double does not know";
}

TEST_F(CanCodecTools, RandomFramesComeBackByteByByte) {
    std::mt19937 random(3);
    std::string text;
    for (int i = 0; i < 2000; ++i) {
        text += "(1700000001.000000) can0 ";
        const bool big = random() % 2 == 0;
        text += big ? "18FEF1FE##0" : "100#";
        for (std::size_t n = big ? 20 : random() % 9; n > 0; --n) {
            const unsigned byte = random() % 8 == 0 ? 0xFF : random() % 256; // not a number now and then
            text += "0123456789ABCDEF"[byte / 16];
            text += "0123456789ABCDEF"[byte % 16];
        }
        text += '\n';
    }
    text += "(1700000001.000000) can0 18FEF1FE##00000000000000000010000000000F0FF00000000\n"; // a signalling one with something behind it
    EXPECT_EQ(told("can encode " + dbc(), told("can decode --json " + dbc(), text)), text);
}

TEST_F(CanCodecTools, EncodesWords) {
    EXPECT_EQ(told("can encode " + dbc() + " Lamp Indicator=left Speed=50 Right=-1"), "100#01138801F6FF0000\n");
    EXPECT_EQ(told("can encode " + dbc() + " Lamp"), "100#0000000000000000\n");
    EXPECT_EQ(told("can encode " + dbc() + " Lamp Speed=0x32 --channel can1 --stamp 12.5"),
              "(0000000012.500000) can1 100#0013880000000000\n");
    EXPECT_EQ(told("can encode " + dbc() + " Lamp Indicator=0 --data FFFFFFFF"), "100#FCFFFFFF\n");
    EXPECT_EQ(told("can encode " + dbc() + " Big Ratio=nan"), "18FEF1FE##00000000000000000000000000000F87F00000000\n");
    EXPECT_EQ(refusal("can encode " + dbc() + " Lmap"), (folder_ / "lamp.dbc") + ": found no message 'Lmap' among 2, expected Lamp\n");
    EXPECT_EQ(refusal("can encode " + dbc() + " Lamp Sped=3"), "Lamp: found no signal 'Sped' in this message, expected Speed\n");
    EXPECT_EQ(refusal("can encode " + dbc() + " Lamp Speed"), "found 'Speed', expected SIGNAL=VALUE\n");
    EXPECT_EQ(refusal("can encode " + dbc() + " Lamp Speed=1 Speed=2"), "found 'Speed' twice, expected each signal once\n");
    EXPECT_EQ(refusal("can encode " + dbc() + " Lamp Speed=400"),
              "Speed: found 400, expected -327.68 to 327.67, which is what its 16 bits hold\n");
    EXPECT_EQ(refusal("can encode " + dbc() + " Lamp Indicator=lft"),
              "Indicator: found 'lft', expected a number or a label, 'left' perhaps\n");
    EXPECT_EQ(refusal("can encode " + dbc() + " Lamp Left=1 Right=1"),
              "Lamp.Page: found no value that lets Left, Right be in one frame, expected signals that go together\n");
    EXPECT_EQ(refusal("can encode " + dbc() + " Lamp --data 1"),
              "--data: data: found '1', expected two hexadecimal digits for each of up to 64 bytes\n");
}

TEST_F(CanCodecTools, RefusesBadJsonWithItsLine) {
    const std::pair<const char*, const char*> cases[] = {
        {"{", "found what is no JSON, expected one object a line, as `fernlicht can decode --json` writes it"},
        {"[]", "found a list, expected an object with frame and signals"},
        {"7", "found 7, expected an object with frame and signals"},
        {R"({"signals":{"Speed":1}})", "message: found none, expected the message that the signals belong to"},
        {R"({"id":"100"})", "data: found none, expected bytes, or a message with signals"},
        {R"({"id":"800","data":""})", "id: found '800', expected 3 hexadecimal digits up to \"7FF\", or 8 for extended identifiers"},
        {R"({"id":"100","data":"1122334455667788AA"})", "data: found 9 bytes, expected at most 8, or \"fd\": true"},
        {R"({"id":"100","fd":true,"data":"1122334455667788AA"})",
         "data: found 9 bytes, expected a length of CAN FD: 0 to 8, 12, 16, 20, 24, 32, 48 or 64"},
        {R"({"id":"100","data":"1","fd":1})", "data: found '1', expected two hexadecimal digits for each of up to 64 bytes"},
        {R"({"id":"100","data":"","time":-1})", "time: found '-1', expected seconds from 0 up, with up to nine digits behind the point"},
        {R"({"message":"Lamp","signals":{"Speed":{}}})",
         "Speed: found an object or a list within, expected an object with frame and signals"},
        {R"({"message":"Lamp","signals":{"Speed":"fast"}})", "Speed: found 'fast', expected a number"},
        {R"({"message":"Lamp","id":"100","data":"00","signals":{"Speed":1}})",
         "Lamp.Speed: found a signal that needs 3 bytes, expected at most 1, the message's length"},
    };
    std::string input = "\n", expected; // counted from line 2
    std::size_t line = 1;
    for (const auto& [json, found] : cases) {
        input += std::string(json) + "\n";
        ++line;
        expected += "fernlicht: skipped: standard input:" + std::to_string(line) + (line == 2 ? ":2: " : ": ") + found + "\n";
    }
    EXPECT_EQ(refusal("can encode " + dbc(), input), expected.substr(20, expected.find('\n') - 19)) << "the first ends it";
    std::ofstream(folder_ / "input") << input << "{\"message\":\"Lamp\"}\n";
    const Outcome lenient = run_shell("( '" FERNLICHT_BINARY "' can encode --lenient " + dbc() + " < '" + (folder_ / "input") + "' )");
    EXPECT_EQ(lenient.exit_code, 0);
    EXPECT_EQ(lenient.output, expected + "100#0000000000000000\n");
}

TEST_F(CanCodecTools, AMaskFindsMessagesOfJ1939FromAnySource) {
    const std::string line = "(1700000000.000000) can0 18FEF17F##00000000000000000000000000000000000000000\n";
    EXPECT_THAT(told("can decode -s " + dbc(), line), HasSubstr("Unknown frame id"));
    EXPECT_THAT(told("can decode -s -m 0x00FFFF00 " + dbc(), line), HasSubstr(":: Big(Counter: 0, Ratio: 0)"));
    EXPECT_EQ(refusal("can decode -m 0xgg " + dbc()), "--frame-id-mask: found '0xgg', expected a number up to 0x1FFFFFFF\n");
}

TEST_F(CanCodecTools, Lists) {
    const std::string file = "'" + (folder_ / "lamp.dbc") + "'";
    EXPECT_EQ(told("can list " + file), R"(100  Lamp  8 bytes, every 20 ms, from Body
    Indicator  0|2@1+  0 to 2
        0 off
        1 left
        2 right
    Speed      15|16@0-  * 0.01 + 0  -50 to 300  km/h
    Page       24|2@1+  multiplexor
    Left       32|16@1-  * 0.1 + 0  deg  if Page = 0
    Right      32|16@1-  * 0.1 + 0  deg  if Page = 1
18FEF1FE  Big  20 bytes, CAN FD, from Body
    Counter  0|64@1+
    Ratio    64|64@1- double
2 messages with 7 signals
)");
    const auto json = nlohmann::json::parse(told("can list --json " + file + " Lamp"));
    EXPECT_EQ(json["id"], "100");
    EXPECT_EQ(json["cycle_s"], 0.02);
    EXPECT_EQ(json["signals"][3]["multiplexed_when"], nlohmann::json::parse("[[0,0]]"));
    EXPECT_EQ(json["signals"][0]["labels"]["2"], "right");
    EXPECT_EQ(refusal("can list " + file + " Bag"), (folder_ / "lamp.dbc") + ": found no message 'Bag' among 2, expected Big\n");
}

TEST_F(CanCodecTools, AgreesWithCantools) {
    if (run_shell("python3 -c 'import cantools'").exit_code != 0)
        GTEST_SKIP() << "python3 has no cantools";
    const std::filesystem::path shared = std::filesystem::path(FERNLICHT_SHARED_DATA) / "can/cantools__cantools/tests/files/dbc";
    std::string files = " '" + (folder_ / "lamp.dbc") + "'";
    for (const char* name :
         {"vehicle", "motohawk", "signed", "floating_point", "padding_bit_order", "multiplex_2", "issue_184_extended_mux_cascaded"})
        if (std::filesystem::exists(shared / (std::string(name) + ".dbc")))
            files += " '" + (shared / (std::string(name) + ".dbc")).string() + "'";
    const Outcome outcome =
        run_shell("python3 '" FERNLICHT_SOURCE_DIR "/tests/runner/can/compare_with_cantools.py' '" FERNLICHT_BINARY "'" + files);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("values decoded"));
}

} // namespace
} // namespace fernlicht
