// fernlicht can decode, as a user runs them; beside cantools where python3 has it.
#include "tests/runner/program.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
    EXPECT_EQ(told("can decode -s --only 'Lamp.Sp*,Ratio' " + dbc() + " " + log()),
              "(1700000000.000001) can0 100#02138800F6FF0000 :: Lamp(Speed: 50 km/h)\n"
              "(1700000000.000002) can0 100#01FFFF01 :: Lamp(Speed: -0.01 km/h)\n"
              "(1700000000.000003) can1 18FEF1FE##1FFFFFFFFFFFFFFFF000000000000E03FDEADBEEF :: Big(Ratio: 0.5)\n");
    EXPECT_EQ(told("can decode -s --only Lamp/Left " + dbc() + " " + log()),
              "(1700000000.000001) can0 100#02138800F6FF0000 :: Lamp(Left: -1 deg)\n");
    EXPECT_EQ(
        told("can decode -s --only Big " + dbc() + " " + log()),
        "(1700000000.000003) can1 18FEF1FE##1FFFFFFFFFFFFFFFF000000000000E03FDEADBEEF :: Big(Counter: 18446744073709551615, Ratio: 0.5)\n");
    EXPECT_EQ(refusal("can decode --only Spede " + dbc()),
              "--only: found 'Spede', expected a message, a signal or MESSAGE.SIGNAL of the databases, * and ? allowed\n");
    const Outcome known = run_program("can decode -s --skip-unknown " + dbc() + " " + log());
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

TEST_F(CanCodecTools, WritesJson) {
    const std::string json = told("can decode --json " + dbc() + " " + log());
    std::istringstream lines(json);
    std::string first;
    std::getline(lines, first);
    EXPECT_EQ(first, "{\"time\":1700000000.000001,\"channel\":\"can0\",\"id\":\"100\",\"data\":\"02138800F6FF0000\",\"message\":\"Lamp\","
                     "\"signals\":{\"Indicator\":2,\"Speed\":50,\"Page\":0,\"Left\":-1},\"labels\":{\"Indicator\":\"right\"},"
                     "\"units\":{\"Speed\":\"km/h\",\"Left\":\"deg\"}}");
    EXPECT_THAT(json, HasSubstr("\"id\":\"7FF\",\"data\":\"112233\"}")) << "of no message nothing else";
    std::ofstream(folder_ / "bare.dbc") << "BO_ 2047 Bare: 3 Body\n";
    EXPECT_THAT(told("can decode --json --dbc '" + (folder_ / "bare.dbc") + "' " + log()),
                HasSubstr("\"message\":\"Bare\",\"signals\":{}}"));
}

TEST_F(CanCodecTools, TellsWhatIsOddAboutADatabase) {
    std::ofstream(folder_ / "odd.dbc") << "BO_ 2048 A: 2 X\n";
    const Outcome outcome = run_program("can decode --notes --dbc '" + (folder_ / "odd.dbc") + "' " + log());
    EXPECT_THAT(outcome.output, HasSubstr("odd.dbc: line 1: A has an identifier of more than 11 bits without bit 31; taken as extended\n"));
}

TEST_F(CanCodecTools, AMaskFindsMessagesOfJ1939FromAnySource) {
    const std::string line = "(1700000000.000000) can0 18FEF17F##00000000000000000000000000000000000000000\n";
    EXPECT_THAT(told("can decode -s " + dbc(), line), HasSubstr("Unknown frame id"));
    EXPECT_THAT(told("can decode -s -m 0x00FFFF00 " + dbc(), line), HasSubstr(":: Big(Counter: 0, Ratio: 0)"));
    EXPECT_EQ(refusal("can decode -m 0xgg " + dbc()), "--frame-id-mask: found '0xgg', expected a number up to 0x1FFFFFFF\n");
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
