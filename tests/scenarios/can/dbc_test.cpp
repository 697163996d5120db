// DBC files statement by statement, what is odd about them, and what is refused.
#include "tests/scenarios/can/dbc_trial.h"

#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <random>

namespace fernlicht {
namespace {

using testing::ElementsAre, testing::HasSubstr;

constexpr const char* whole_file = R"(VERSION "1.2"

NS_ :
	NS_DESC_
	CM_
	BA_DEF_
	VAL_
	SG_MUL_VAL_

BS_: 500 : 1,2

BU_: Body
	Cockpit Lamps
VAL_TABLE_ OnOff 1 "on" 0 "off" ;

BO_ 291 Switches: 4 Cockpit
 SG_ LowBeam : 0|1@1+ (1,0) [0|1] ""  Lamps,Body
 SG_ Indicator : 1|2@1+ (1,0) [0|2] "" Lamps
 SG_ Wheel : 15|16@0- (0.0625,-1) [-780|+780.5] "deg"  Vector__XXX // the wheel, not a wheel

BO_ 2566844926 Speeds: 8 Vector__XXX
 SG_ Speed : 0|32@1- (1,0) [0|0] "km/h" Lamps
 SG_ Page M : 32|4@1+ (1,0) [0|0] "" Lamps
 SG_ Near m1 : 40|8@1+ (1,0) [0|0] "" Lamps
 SG_ Sub m2M : 40|4@1+ (1,0) [0|0] "" Lamps
 SG_ Deep m0 : 48|8@1+ (1,0) [0|0] "" Lamps

BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX
 SG_ Alone : 0|8@1+ (1,0) [0|0] "" Vector__XXX

BO_TX_BU_ 291 : Cockpit,Body;

EV_ Fog: 0 [0|1] "" 0 2 DUMMY_NODE_VECTOR0 Vector__XXX;
ENVVAR_DATA_ Fog: 4;
SGTYPE_ Eight: 8@1+ (1,0) [0|255] "" 0, OnOff;

CM_ "the bus";
CM_ BU_ Lamps "both
lamps; \"left\" and right";
CM_ BO_ 291 "what the driver switches";
CM_ SG_ 291 Wheel "at the wheel
not at the road";
CM_ EV_ Fog "fog";
BA_DEF_ "BusType" STRING ;
BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;
BA_DEF_ BO_ "GenMsgSendType" ENUM "Cyclic","OnEvent";
BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN","reserved","J1939PG","a","b","c","d","e","f","g","h","i","j","StandardCAN_FD","ExtendedCAN_FD";
BA_DEF_ BO_ "CANFD_BRS" ENUM "0","1";
BA_DEF_ BO_ "SystemMessageLongSymbol" STRING ;
BA_DEF_ SG_ "SystemSignalLongSymbol" STRING ;
BA_DEF_ SG_ "GenSigStartValue" FLOAT 0 1E10;
BA_DEF_REL_ BU_SG_REL_ "Timeout" INT 0 65535;
BA_DEF_DEF_ "BusType" "CAN FD";
BA_DEF_DEF_ "GenMsgCycleTime" 0;
BA_DEF_DEF_ "GenMsgSendType" "OnEvent";
BA_DEF_DEF_ "VFrameFormat" "StandardCAN";
BA_DEF_DEF_ "CANFD_BRS" "1";
BA_DEF_DEF_ "GenSigStartValue" 0;
BA_DEF_DEF_REL_ "Timeout" 0;
BA_ "BusType" "CAN";
BA_ "GenMsgCycleTime" BO_ 291 20;
BA_ "GenMsgSendType" BO_ 291 0;
BA_ "VFrameFormat" BO_ 2566844926 15;
BA_ "SystemMessageLongSymbol" BO_ 2566844926 "SpeedsOfAllTheWheelsAndOfTheWholeCar";
BA_ "SystemSignalLongSymbol" SG_ 2566844926 Page "PageThatChoosesWhatIsInTheUpperBytes";
BA_ "GenSigStartValue" SG_ 291 Wheel -3;
BA_REL_ "Timeout" BU_SG_REL_ Lamps SG_ 291 LowBeam 100;
VAL_ 291 LowBeam 1 "on" 0 "off" ;
VAL_ 291 Indicator 2 "right" 1 "left" 0 "none" ;
VAL_ Fog 1 "on" ;
SIG_GROUP_ 291 Both 1 : LowBeam Indicator;
SIG_VALTYPE_ 2566844926 Speed : 1;
SG_MUL_VAL_ 2566844926 Near Page 1-1, 4-6;
SG_MUL_VAL_ 2566844926 Sub Page 2-2;
SG_MUL_VAL_ 2566844926 Deep Sub 0-3;
)";

class Dbc : public DbcTrial {};

TEST_F(Dbc, EachStatementMeansWhatItSays) {
    const CanDatabase read = this->read(whole_file);
    ASSERT_EQ(read.messages.size(), 2U);
    const CanMessage& switches = read.messages[0];
    EXPECT_EQ(switches.id, 0x123U);
    EXPECT_FALSE(switches.extended || switches.fd);
    EXPECT_FALSE(switches.bit_rate_switch) << "only CAN FD has one, whatever the default";
    EXPECT_EQ(switches.length, 4);
    EXPECT_EQ(switches.cycle_s, 0.02);
    ASSERT_EQ(switches.signals.size(), 3U);
    CanSignal wheel{.name = "Wheel", .start_bit = 15, .length = 16};
    wheel.big_endian = wheel.is_signed = true;
    wheel.factor = 0.0625;
    wheel.offset = -1;
    wheel.minimum = -780;
    wheel.maximum = 780.5;
    wheel.unit = "deg";
    wheel.start_value = -3;
    EXPECT_EQ(switches.signals[2], wheel);
    EXPECT_EQ(switches.signals[1].labels, (std::map<std::int64_t, std::string>{{0, "none"}, {1, "left"}, {2, "right"}}));
    const CanMessage& speeds = read.messages[1];
    EXPECT_EQ(speeds.id, 0x18FEF1FEU);
    EXPECT_TRUE(speeds.extended && speeds.fd && speeds.bit_rate_switch);
    EXPECT_FALSE(speeds.cycle_s);
    EXPECT_EQ(speeds.name, "SpeedsOfAllTheWheelsAndOfTheWholeCar");
    EXPECT_EQ(speeds.signals[0].kind, CanValueKind::float32);
    const std::string page = "PageThatChoosesWhatIsInTheUpperBytes";
    EXPECT_EQ(speeds.signals[1].name, page);
    EXPECT_TRUE(speeds.signals[1].multiplexor);
    EXPECT_EQ(speeds.signals[2].multiplexed_by, page) << "its long name, too";
    EXPECT_EQ(speeds.signals[2].multiplexed_when, (std::vector<std::pair<std::uint64_t, std::uint64_t>>{{1, 1}, {4, 6}}));
    EXPECT_TRUE(speeds.signals[3].multiplexor);
    EXPECT_EQ(speeds.signals[4].multiplexed_by, "Sub");
    EXPECT_THAT(read.notes, ElementsAre("line 28: VECTOR__INDEPENDENT_SIG_MSG holds 1 signals that no message sends; left out"));
}

TEST_F(Dbc, LookUps) {
    const CanDatabase read = this->read(whole_file);
    EXPECT_EQ(read.message(0x123, false), &read.messages[0]);
    EXPECT_EQ(read.message(0x123, true), nullptr);
    EXPECT_EQ(read.message("Switches"), &read.messages[0]);
    EXPECT_EQ(read.message("switches"), nullptr);
    EXPECT_EQ(read.messages[0].signal("Wheel"), &read.messages[0].signals[2]);
    EXPECT_EQ(read.messages[0].signal("wheel"), nullptr);
}

TEST_F(Dbc, LineEndsAndEncodingsDoNotMatter) {
    const CanDatabase unix_file = read(whole_file);
    for (const char* end : {"\r\n", "\r"}) {
        std::string text;
        for (const char* c = whole_file; *c != 0; ++c)
            text += *c == '\n' ? std::string(end) : std::string(1, *c);
        EXPECT_EQ(read(text).messages, unix_file.messages) << (end[1] == 0 ? "CR" : "CR LF");
    }
    EXPECT_EQ(read(std::string("\xEF\xBB\xBF") + whole_file).messages, unix_file.messages);
    EXPECT_THAT(read(std::string("\xEF\xBB\xBF") + whole_file).notes, testing::SizeIs(1)) << "a mark alone says nothing of note";
    const std::string head = "BU_:\nBO_ 1 A: 8 X\n SG_ T : 0|8@1+ (1,0) [0|0] \"";
    const CanDatabase utf8 = read(head + "\xC2\xB0"
                                         "C\" X\n"),
                      windows = read(head + "\xB0"
                                            "C\" X\n");
    EXPECT_EQ(utf8.messages, windows.messages);
    EXPECT_EQ(utf8.messages[0].signals[0].unit, "°C");
    EXPECT_THAT(utf8.notes, ElementsAre("line 3: characters beyond ASCII are taken as UTF-8"));
    EXPECT_THAT(windows.notes, ElementsAre("line 3: characters beyond ASCII are taken as Windows-1252, because they are not UTF-8"));
    EXPECT_THAT(refusal(std::string("\xFF\xFE") + "V"), HasSubstr("trial.dbc:1: found UTF-16, expected UTF-8 or Windows-1252"));
}

// What tools write although the format does not know it.
TEST_F(Dbc, HabitsOfTools) {
    EXPECT_EQ(message(" SG_ A:0|8@1+(1,0)[0|0]\"\"X").signals.at(0).name, "A") << "no blanks";
    EXPECT_EQ(message(" SG_ A  m1  :  0 | 8 @ 1 +  ( 1 , 0 )  [ 0 | 0 ]  \"\"  X , Y\n SG_ B M : 8|8@1+ (1,0) [0|0] \"\" X").signals.size(),
              2U);
    EXPECT_EQ(message(" SG_ A : 0|8@1+ (1.,.5) [-1.#IND|1e2] \"\" X").signals.at(0).offset, 0.5);
    EXPECT_EQ(message(" SG_ 4WD-Lock : 0|8@1+ (1,0) [0|0] \"\" X").signals.at(0).name, "4WD-Lock");
    const CanDatabase no_semicolons =
        read("BU_:\nBO_ 1 A: 8 X\n SG_ T : 0|8@1+ (1,0) [0|0] \"\" X\n\nVAL_ 1 T 0 \"zero\"\nCM_ SG_ 1 T \"text\"\nBO_ 2 B: 8 X\n");
    EXPECT_EQ(no_semicolons.messages.size(), 2U);
    EXPECT_EQ(no_semicolons.messages[0].signals[0].labels.at(0), "zero");
    EXPECT_EQ(read("BU_:\n  BO_ 1 A: 8 X\n\n  BO_ 2 B: 8 X\n").messages.size(), 2U) << "indented";
    EXPECT_EQ(read("BO_ 1 A: 8").messages.at(0).name, "A") << "no nodes, no sender";
    EXPECT_EQ(read("VERSION \"\"").messages.size(), 0U);
}

TEST_F(Dbc, WhatIsOddIsTakenAndNoted) {
    const auto note = [&](const std::string& text) { return all_notes(read(text)); };
    const std::string head = "BU_:\nBO_ 1 A: 2 X\n";
    EXPECT_EQ(note(head + " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ T : 7|12@0+ (1,0) [0|0] \"\" X\n"), "line 4: A.T overlaps S\n");
    EXPECT_EQ(note(head + " SG_ S : 12|8@1+ (1,0) [0|0] \"\" X\n"),
              "line 3: A.S needs 3 bytes, its message has 2; only longer frames hold it\n");
    EXPECT_EQ(note(head + " SG_ S : 0|8@1+ (1,0) [5|-5] \"\" X\n"), "line 3: A.S has limits from 5 to -5; taken as none\n");
    EXPECT_EQ(note("BO_ 2048 A: 2 X\n"), "line 1: A has an identifier of more than 11 bits without bit 31; taken as extended\n");
    EXPECT_EQ(note("BO_ 1073741825 A: 2 X\n"), "line 1: A has identifier 0x40000001, of more than 29 bits; left out\n");
    EXPECT_EQ(note("BO_ 1 A: 2 X\nBO_ 2 A: 2 X\n"), "line 2: a second message A (the first is in line 1); by name the first is found\n");
    EXPECT_EQ(note(head + "BA_ \"GenSigStartValue\" SG_ 1 S 1;\nVAL_ 2 S 1 \"x\" ;\n"),
              "line 4: VAL_ of message 2, which is not there\nline 3: BA_ of S, which message A has not\n");
    EXPECT_EQ(note(head + " SG_ S m1 : 0|8@1+ (1,0) [0|0] \"\" X\n"), "line 3: A.S (m1) is left out: its message has no multiplexor (M)\n");
    EXPECT_EQ(note(head +
                   " SG_ M1 M : 0|1@1+ (1,0) [0|0] \"\" X\n SG_ M2 M : 1|1@1+ (1,0) [0|0] \"\" X\n SG_ S m1 : 8|8@1+ (1,0) [0|0] \"\" X\n"),
              "line 5: A.S (m1) is left out: its message has several multiplexors (M) and no SG_MUL_VAL_ says which it follows\n");
    EXPECT_EQ(note("BO_ 1 A: 10 X\n"), "line 1: A has 10 bytes, which CAN FD fills up to the next length that it knows\n");
    EXPECT_EQ(note(head + " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\nBA_ \"GenSigStartValue\" SG_ 1 S 256;\n"),
              "line 4: GenSigStartValue '256' of S is not a raw value that its 8 bits hold; left out\n");
    EXPECT_EQ(note("BO_ 1 A: 2 X\nBA_ \"GenMsgCycleTime\" BO_ 1 -5;\n"),
              "line 2: GenMsgCycleTime '-5' of A is not a time in milliseconds; it counts as not cyclic\n");
    EXPECT_EQ(note(head + " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\nVAL_ 1 S 1.5 \"x\" 2 \"a\" 2 \"b\" ;\n"),
              "line 4: '1.5' is not a whole number that S could have; its text 'x' is left out\nline 4: 2 of S is both 'a' and 'b'; the "
              "first is taken\n");
}

TEST_F(Dbc, MultiplexorsKeepSignalsApart) {
    EXPECT_EQ(all_notes(read("BO_ 1 A: 8 X\n SG_ M1 M : 0|2@1+ (1,0) [0|0] \"\" X\n SG_ S m1 : 8|8@1+ (1,0) [0|0] \"\" X\n"
                             " SG_ T m2 : 8|8@1+ (1,0) [0|0] \"\" X\n")),
              "");
    EXPECT_EQ(all_notes(read("BO_ 1 A: 8 X\n SG_ M1 M : 0|2@1+ (1,0) [0|0] \"\" X\n SG_ S m1 : 8|8@1+ (1,0) [0|0] \"\" X\n"
                             " SG_ T m2 : 8|8@1+ (1,0) [0|0] \"\" X\nSG_MUL_VAL_ 1 T M1 0-3;\n")),
              "line 4: A.T overlaps S\n");
    const auto notes = [&](const std::string& s, const std::string& t) {
        return all_notes(read("BO_ 1 A: 8 X\n SG_ M0 M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ S m1 : 8|8@1+ (1,0) [0|0] \"\" X\n"
                              " SG_ T m2 : 8|8@1+ (1,0) [0|0] \"\" X\nSG_MUL_VAL_ 1 S M0 " +
                              s + ";\nSG_MUL_VAL_ 1 T M0 " + t + ";\n"));
    };
    EXPECT_EQ(notes("0-100, 3-4", "50-60"), "line 4: A.T overlaps S\n");
    EXPECT_EQ(notes("3-4, 7-7, 0-1", "8-9, 2-2, 5-6"), "");
    EXPECT_EQ(notes("3-4, 7-7, 0-1", "8-9, 2-2, 5-7"), "line 4: A.T overlaps S\n");
}

/// Levels of multiplexors, each switched by the one above, all over the same bits; then signals that nothing keeps apart.
TEST_F(Dbc, DeepAndWideMessagesAreReadInTheirTime) {
    constexpr int levels = 500;
    std::string text = "BO_ 1 A: 8 X\n SG_ S0 M : 0|8@1+ (1,0) [0|0] \"\" X\n", switches;
    for (int i = 1; i < levels; ++i) {
        text += fmt::format(" SG_ S{} m1M : 8|8@1+ (1,0) [0|0] \"\" X\n", i);
        switches += fmt::format("SG_MUL_VAL_ 1 S{} S{} 1-1;\n", i, i - 1);
    }
    EXPECT_EQ(all_notes(read(text + switches)), "line 4: A.S2 overlaps S1, and 124250 more pairs of this message do\n"); // 499 * 498 / 2
    text = "BO_ 1 A: 8 X\n";
    for (int i = 0; i < 100'000; ++i)
        text += fmt::format(" SG_ S{} : 0|8@1+ (1,0) [0|0] \"\" X\n", i);
    EXPECT_EQ(all_notes(read(text)), "line 3: A.S1 overlaps S0, and at least 999999 more pairs of this message do\n");
}

/// A second each, and once minutes: the way up from each of many levels, and pairs of signals with many ranges each.
TEST_F(Dbc, LongWaysUpAndManyRangesAreReadInTheirTime) {
    constexpr int levels = 20'000;
    std::string text = "BO_ 1 A: 8 X\n SG_ S0 M : 0|8@1+ (1,0) [0|0] \"\" X\n", switches;
    for (int i = 1; i < levels; ++i) {
        text += fmt::format(" SG_ S{} m1M : 8|8@1+ (1,0) [0|0] \"\" X\n", i);
        switches += fmt::format("SG_MUL_VAL_ 1 S{} S{} 1-1;\nVAL_ 1 S{} 1 \"on\" ;\n", i, i - 1, i);
    }
    const auto since = std::chrono::steady_clock::now();
    EXPECT_THAT(all_notes(read(text + switches)), testing::HasSubstr("line 4: A.S2 overlaps S1, and at least "));
    text = "BO_ 1 A: 8 X\n SG_ M0 M : 0|8@1+ (1,0) [0|0] \"\" X\n";
    switches.clear();
    for (int i = 0; i < 300; ++i) {
        text += fmt::format(" SG_ S{} m1 : 8|8@1+ (1,0) [0|0] \"\" X\n", i);
        switches += fmt::format("SG_MUL_VAL_ 1 S{} M0 {}-{}", i, i, i);
        for (int k = 1; k < 1000; ++k)
            switches += fmt::format(", {}-{}", 300 * k + i, 300 * k + i);
        switches += ";\n";
    }
    EXPECT_EQ(all_notes(read(text + switches)), "");
    EXPECT_LT(std::chrono::steady_clock::now() - since, std::chrono::seconds(20)); // 1 s; far more on a busy machine
}

TEST_F(Dbc, RingsAreRefusedFromEverySignalAndLimitsThatAreNoNumbersAreNone) {
    const std::string head = "BO_ 1 A: 8 X\n", end = " : 8|8@1+ (1,0) [0|0] \"\" X\n";
    EXPECT_THAT(refusal(head + " SG_ P m1M" + end + " SG_ Q m1M" + end + " SG_ R m1M" + end +
                        "SG_MUL_VAL_ 1 P Q 1-1;\nSG_MUL_VAL_ 1 Q R 1-1;\nSG_MUL_VAL_ 1 R Q 1-1;\n"),
                testing::HasSubstr("in a ring, A.Q among them"));
    for (const std::string limits : {"nan|nan", "-inf|inf", "NaN|1", "0|INF"})
        EXPECT_THAT(all_notes(read("BO_ 1 A: 2 X\n SG_ S : 0|8@1+ (1,0) [" + limits + "] \"\" X\n")), HasSubstr("; taken as none"));
}

TEST_F(Dbc, RefusalsNameLineAndReason) {
    const std::string head = "BU_:\nBO_ 1 A: 8 X\n", good = " SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n";
    const std::pair<std::string, std::string> cases[] = {
        {"hello", ":1: found 'hello', expected a statement as BO_, SG_, CM_ ..."},
        {"BU_: A\n  B\nVALL_ 1 S 1 \"a\";", ":3: found 'VALL_', expected a statement, VAL_ perhaps"},
        {head + "VALL_ 1 S 1 \"a\";", ":3: found 'VALL_', expected a statement, VAL_ perhaps"},
        {"BO_ x A: 8 X", ":1: found 'x', expected an identifier of a message, a whole number from 0 to 4294967295"},
        {"BO_ 4294967296 A: 8 X", ":1: found '4294967296', expected an identifier of a message, a whole number from 0 to 4294967295"},
        {"BO_ 1 A 8 X", ":1: found '8', expected ':' behind the message's name"},
        {"BO_ 1 A: -8 X", ":1: found '-8', expected a length in bytes, a whole number from 0 to 65535"},
        {"BO_ 1", ":1: found the end of the file, expected a name of a message"},
        {" SG_ S : 0|8@1+ (1,0) [0|0] \"\" X", ":1: found a signal (SG_) before the first message, expected BO_"},
        {head + " SG_ S X : 0|8@1+ (1,0) [0|0] \"\" X", ":3: found 'X', expected M, m0, m0M ... or ':' behind the signal's name"},
        {head + " SG_ S : 0|8@2+ (1,0) [0|0] \"\" X",
         ":3: found '2+', expected a byte order: 0 = Motorola, 1 = Intel, a whole number from 0 to 1"},
        {head + " SG_ S : 0|8@1* (1,0) [0|0] \"\" X", ":3: found '*', expected a sign: + or -"},
        {head + " SG_ S : 0|8@1+ (1;0) [0|0] \"\" X", ":3: found ';', expected ',' between factor and offset"},
        {head + " SG_ S : 0|8@1+ (one,0) [0|0] \"\" X", ":3: found 'one', expected a factor"},
        {head + " SG_ S : 0|8@1+ (1e999,0) [0|0] \"\" X", ":3: found '1e999', expected a factor that a double can hold"},
        {head + " SG_ S : 0|8@1+ (1,0) [0|0] km X", ":3: found 'km', expected a unit in quotes"},
        {head + " SG_ S : 0|8@1+ (1,0) [0|0] \"km X", ":3: found a text that does not end, expected a closing \""},
        {head + " SG_ S : 0|0@1+ (1,0) [0|0] \"\" X", ":3: found A.S of 0 bits, expected 1 to 64"},
        {head + " SG_ S : 0|65@1+ (1,0) [0|0] \"\" X", ":3: found A.S of 65 bits, expected 1 to 64"},
        {head + " SG_ S : 0|8@1+ (0,7) [0|0] \"\" X",
         ":3: found A.S with factor 0 and offset 7, expected a factor other than 0, and numbers"},
        {head + good + "SIG_VALTYPE_ 1 S : 1;", ":3: found A.S, a float of 8 bits, expected 32"},
        {head + good + "SIG_VALTYPE_ 1 S : 2;", ":3: found A.S, a double of 8 bits, expected 64"},
        {head + good + "SIG_VALTYPE_ 1 S : 3;",
         ":4: found '3', expected 0 = whole number, 1 = float, 2 = double, a whole number from 0 to 2"},
        {head + good + good, ":4: found a second signal A.S, expected each name once in a message (the first is in line 3)"},
        {head + "BO_ 1 B: 8 X\n", ":3: found a second message with identifier 1, B, expected each once (the first is in line 2)"},
        {head + " SG_ S m1M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ T m1M : 8|8@1+ (1,0) [0|0] \"\" X\nSG_MUL_VAL_ 1 S T 1-1;\nSG_MUL_VAL_ 1 T S "
                "1-1;",
         ":3: found multiplexors that switch each other in a ring, A.S among them, expected a multiplexor that is always there"},
        {head + good + "SG_MUL_VAL_ 1 S S 1-1;", ":4: found A.S as its own multiplexor, expected another signal"},
        {head + good + "SG_MUL_VAL_ 1 S T 3-1;", ":4: found the range 3-1, expected the smaller value first"},
        {head + good + "SG_MUL_VAL_ 1 S T 3;", ":4: found ';', expected '-' between the range's ends"},
        {head + " SG_ S M : 0|32@1+ (1,0) [0|0] \"\" X\nSIG_VALTYPE_ 1 S : 1;",
         ":3: found A.S as multiplexor, a floating-point signal, expected a whole number"},
        {head + "CM_ BO_ 1 no quotes;", ":3: found 'no', expected a comment in quotes, or BU_, BO_, SG_, EV_"},
        {head + "CM_ BO_ 1 \"begins\nand goes on", ":3: found a text that does not end, expected a closing \""},
        {head + "CM_ BO_ 1 \"a\" \"b\";", ":3: found '\"', expected ';' behind the comment"},
        {head + "BA_ GenMsgCycleTime BO_ 1 5;", ":3: found 'GenMsgCycleTime', expected a name of an attribute in quotes"},
        {head + "BA_ \"GenMsgCycleTime\" BO_ 1 ;", ":3: found ';', expected a number or a text in quotes"},
        {head + "BA_DEF_ BO_ \"A\" INTEGER 0 1;", ":3: found 'INTEGER', expected INT, HEX, FLOAT, STRING or ENUM"},
        {head + good + "VAL_ 1 S 1 ;", ":4: found ';', expected a text in quotes behind the number"},
        {head + good + "VAL_ 1 S \"a\" 1;", ":4: found '\"', expected pairs of a number and a text in quotes"},
        {head + "EV_ Fog: 0 [0|1]", ":3: found no end of what begins here, expected ';'"},
    };
    for (const auto& [text, expected] : cases)
        EXPECT_EQ(refusal(text), "trial.dbc" + expected) << text;
    EXPECT_THAT(refusal(std::string("BO_ 1 A: 8 X\n\0", 14)), HasSubstr("trial.dbc:2: found a zero byte"));
    EXPECT_THAT(refusal(""), HasSubstr("trial.dbc"));
}

// Bytes changed, cut out and put in twice: reads or refuses with a sentence that names the file, never anything else.
TEST_F(Dbc, MutatedFilesNeverFallOver) {
    std::mt19937 random(7);
    const std::string good = whole_file, bytes("0\0 -9e.,;:|@()[]\"\\\n\r\xFFmM_", 24);
    int refused = 0;
    constexpr int times = 1000;
    for (int i = 0; i < times; ++i) {
        std::string text = good;
        for (unsigned n = 1 + random() % 4; n > 0; --n) {
            const std::size_t at = random() % text.size(), length = std::min<std::size_t>(random() % 40, text.size() - at);
            switch (random() % 5) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(random() % text.size(), text.substr(at, length));
                break;
            case 2:
                text.resize(at + 1);
                break;
            case 3:
                text.insert(at, std::to_string(random()));
                break;
            default:
                text[at] = bytes[random() % bytes.size()];
            }
        }
        const std::string said = refusal(text);
        refused += !said.empty();
        if (!said.empty()) {
            ASSERT_THAT(said, HasSubstr("trial.dbc"));
        }
    }
    EXPECT_GT(refused, times / 4) << "the mutations hit";
    EXPECT_LT(refused, times) << "and some are harmless";
}

// Each file of others is read, or refused with line and reason.
TEST_F(Dbc, FilesOfOthers) {
    const std::filesystem::path folder = std::filesystem::path(FERNLICHT_SHARED_DATA) / "can";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "no files of others in " << folder;
    const auto files = tests::files_below(folder, {".dbc", ".DBC"});
    std::size_t refused = 0, messages = 0, signals = 0, notes = 0;
    for (const std::filesystem::path& file : files) {
        try {
            FilesRead opened;
            const CanDatabase read = read_dbc(file, opened);
            messages += read.messages.size();
            notes += read.notes.size();
            for (const CanMessage& message : read.messages)
                signals += message.signals.size();
        } catch (const InputError& error) {
            ++refused;
            EXPECT_GT(error.where().line, 0U) << error.what();
            std::printf("refused: %s\n", error.what());
        }
    }
    std::printf("%zu files, %zu refused; %zu messages, %zu signals, %zu notes\n", files.size(), refused, messages, signals, notes);
    EXPECT_FALSE(files.empty());
    EXPECT_EQ(refused, 0U) << "all that were there when this was written are read";
}

} // namespace
} // namespace fernlicht
