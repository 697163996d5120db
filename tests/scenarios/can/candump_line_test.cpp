// Lines of candump, read and written back byte by byte.
#include "scenarios/can/can_frame.h"
#include "scenarios/can/candump_log.h"
#include "tests/scenarios/can/random_frames.h"
#include "tests/trial.h"

#include <gmock/gmock.h>
#include <tuple>

namespace fernlicht {
namespace {

using testing::ElementsAre, testing::HasSubstr;

const InputError::Where here{"a.log", 7, 0, {}};

CandumpLine parsed(const std::string& line) { return parse_candump_line(line, here); }

/// What is not the form's own is not in the way.
void expect_same_text(const std::string& line) {
    SCOPED_TRACE(line);
    CandumpLine read;
    ASSERT_NO_THROW(read = parsed(line));
    EXPECT_EQ(candump_line(read.frame, read.style), line);
}

TEST(CandumpLine, ReadsWhatTheDescriptionOfTheFormatShows) { // can-utils, lib.h
    CandumpLine line = parsed("(1436509052.249713) vcan0 044#2A366C2BBA");
    EXPECT_EQ(std::tuple(line.frame.time_ns, line.frame.channel, line.frame.id), std::tuple(1436509052249713000, "vcan0", 0x44U));
    EXPECT_FALSE(line.frame.extended || line.frame.fd || line.frame.remote || line.frame.error);
    EXPECT_THAT(line.frame.bytes(), testing::ElementsAre(0x2a, 0x36, 0x6c, 0x2b, 0xba));
    EXPECT_EQ(line.style, CandumpStyle{});

    line = parsed("(0000000000.000000) can0 12345678#");
    EXPECT_TRUE(line.frame.extended);
    EXPECT_EQ(std::tuple(line.frame.id, line.frame.length), std::tuple(0x12345678U, 0));

    line = parsed("(0000000000.000000) can0 123#R7");
    EXPECT_TRUE(line.frame.remote);
    EXPECT_EQ(line.frame.length, 7);
    EXPECT_TRUE(line.frame.bytes().empty());
    EXPECT_EQ(parsed("(0000000000.000000) can0 7A1#r").frame.remote, true);
    EXPECT_EQ(parsed("(0000000000.000000) can0 123#R0").frame.length, 0);
    EXPECT_EQ(parsed("(0000000000.000000) can0 123#R8_9").frame.raw_dlc, 9);

    line = parsed("(0000000000.000000) can0 123#1122334455667788_E");
    EXPECT_EQ(std::tuple(line.frame.raw_dlc, line.frame.length), std::tuple(14, 8));

    for (const char* same : {"123#11.22.33.44.55.66.77.88", "123#11.2233.44556677.88", "123#1122334455667788"})
        EXPECT_THAT(parsed(std::string("(0000000000.000000) can0 ") + same).frame.bytes(),
                    testing::ElementsAre(0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88));

    line = parsed("(0000000000.000000) can0 32345678#112233");
    EXPECT_TRUE(line.frame.error);
    EXPECT_FALSE(line.frame.extended);
    EXPECT_EQ(line.frame.id, 0x12345678U);

    line = parsed("(0000000000.000000) can0 123##1112233");
    EXPECT_TRUE(line.frame.fd && line.frame.bit_rate_switch);
    EXPECT_FALSE(line.frame.error_state_indicator);
    EXPECT_EQ(line.frame.length, 3);
    line = parsed("(0000000000.000000) can0 123##3");
    EXPECT_TRUE(line.frame.bit_rate_switch && line.frame.error_state_indicator);
    EXPECT_EQ(line.frame.length, 0);
}

TEST(CandumpLine, ReadsTheScreenForm) { // can-utils, lib.h
    CandumpLine line = parsed("  can0  14B0DC51   [8]  4A 94 E8 2A EC 58 55 62   'J..*.XUb'");
    EXPECT_TRUE(line.frame.extended);
    EXPECT_EQ(line.frame.id, 0x14b0dc51U);
    EXPECT_THAT(line.frame.bytes(), testing::ElementsAre(0x4a, 0x94, 0xe8, 0x2a, 0xec, 0x58, 0x55, 0x62));
    EXPECT_EQ(line.style.stamp_digits, 0);
    line = parsed("  can0  321   {B}  11 22 33 44 55 66 77 88");
    EXPECT_EQ(line.frame.raw_dlc, 11);
    line = parsed("  can0  20001111   [7]  C6 23 7B 32 69 98 3C      ERRORFRAME");
    EXPECT_TRUE(line.frame.error);
    EXPECT_EQ(line.frame.id, 0x1111U);
    line = parsed(" (2026-11-22 12:38:19.000001)  can0  RX B E  12345678  [03]  11 22 33");
    EXPECT_EQ(line.frame.time_ns, 1795351099000001000); // date -u -d '2026-11-22 12:38:19' +%s
    EXPECT_TRUE(line.frame.fd && line.frame.bit_rate_switch && line.frame.error_state_indicator);
    EXPECT_EQ(line.style.sent, false);
    line = parsed(" (012.345678901)  can0  TX - -  123   [2]  22`11");
    EXPECT_EQ(line.frame.time_ns, 12345678901);
    EXPECT_THAT(line.frame.bytes(), testing::ElementsAre(0x11, 0x22));
    EXPECT_EQ(line.style.sent, true);
    EXPECT_THAT(parsed("  can0  123   [2]  00010001 11111111").frame.bytes(), testing::ElementsAre(0x11, 0xff));
}

TEST(CandumpLine, WritesBackWhatOthersWrote) {
    for (const char* line : {
             "(166.000000) vcan0 21A#FE3612FE690507AD",
             "(1436509052.249713)   vcan0 044#2A366C2BBA",
             "(1436509052.249713421) can0 044#2A366C2BBA R",
             "(1436509052.249713) can0 12345678#R8_F T",
             "(000.000000) can0 123##50011",
             "(1436509052.249713) can0 123##7.00.11",
             "(1436509052.249713) can0 123#00.11",
             "(1345212884.318850)  vcan0       123   [2]  11 22                     '.\"'", // log2long
             "(1345212884.318850)  vcan0  20000004   [8]  00 11 22 33 44 55 66 77   ERRORFRAME",
             "  can0  123   [0] ",
             "  can0  123  [00] ",
             "  can0  123   [0]  remote request",
             "    can0  123   [8]  remote request",
             "  can0  123   [0]                            ''",
             "  can0  123   [0]                            ``",
             "  can0       123   {F}  88`77`66`55`44`33`22`11   `.wfUD3\".`",
             "  can0  20000040   [0]                            ERRORFRAME",
             " \33[1m\33[35m(1345212884.318850)  can0  RX - -  123   [1]  11\33[0m",
             " (1345212884.318850)  \33[1m\33[31mcan0\33[0m  123   [1]  11",
             "  \33[1m\33[31mcan0  RX B -\33[0m  123  [01]  11",
             "  \33[1mcan0  123   [1]  11\33[0m",
             " \33[1m can0  123   [1]  11\33[0m",
             "  \33[1mcan0  20000040   [0]                            ERRORFRAME",
         })
        expect_same_text(line);
}

TEST(CandumpLine, LeavesOutWhatOtherSpellingsDoNotMean) {
    EXPECT_EQ(candump_line(parsed("(0000000000.000000) can0 7a1#aB.cD").frame), "(0000000000.000000) can0 7A1#ABCD");
    EXPECT_EQ(candump_line(parsed("(0000000000.000000) can0 7a1#r0\r").frame), "(0000000000.000000) can0 7A1#R");
}

/// Every frame through every form: what the form can hold comes back, and the text twice the same.
TEST(CandumpLine, HoldsRandomFramesInEveryForm) {
    std::mt19937_64 random(20261122);
    const auto coin = [&] { return random() % 2 == 0; };
    for (int i = 0; i < 200'000; ++i) {
        CanFrame frame = random_frame(random);
        CandumpStyle style{.stamp_digits = std::uint8_t{coin() ? std::uint8_t{6} : std::uint8_t{9}}};
        if (style.stamp_digits == 9)
            frame.time_ns += static_cast<std::int64_t>(random() % 1000);
        style.channel_columns = coin() ? 0 : static_cast<std::uint8_t>(frame.channel.size() + 1 + random() % 5);
        if (coin())
            style.sent = coin();
        CanFrame expected = frame;
        if (coin()) {
            style.more_fd_flags = frame.fd ? static_cast<std::uint8_t>(random() % 4 * 4) : std::uint8_t{0};
            style.dotted = coin();
        } else {
            style.form = CandumpStyle::Form::screen;
            style.date = coin();
            style.narrow = false;
            style.indented = coin();
            style.binary = coin();
            style.ascii = coin();
            style.swapped = coin();
            style.shows_dlc = coin();
            style.colour_mode = static_cast<std::uint8_t>(random() % 4);
            style.colour = static_cast<std::uint8_t>(random() % 6);
            style.colour_stays_on = style.colour_mode > 1 && coin();
            if (coin()) {
                style.stamp_digits = 0;
                expected.time_ns = 0;
            }
            if (!style.sent) // no columns for them
                expected.bit_rate_switch = expected.error_state_indicator = false;
            if (!style.shows_dlc)
                expected.raw_dlc = 0;
        }
        if (style.form == CandumpStyle::Form::log || style.stamp_digits > 0)
            style.second_digits = coin() ? 10 : 3;
        const std::string text = candump_line(frame, style);
        CandumpLine read;
        ASSERT_NO_THROW(read = parsed(text)) << text;
        ASSERT_EQ(read.frame, expected) << text;
        ASSERT_EQ(candump_line(read.frame, read.style), text);
    }
}

TEST(CandumpLine, SaysWhatIsWrongAndWhere) {
    struct Bad {
        const char *line, *message;
    };
    for (const Bad& bad : std::initializer_list<Bad>{
             {"hello", "a.log:7:1: found 'hello', expected a stamp '(seconds.digits)', or a blank as candump's screen form begins with"},
             {"(12 can0 123#", "a.log:7:4: found ' can0 123#', expected a point"},
             {"(x.000000) can0 123#", "a.log:7:2: found 'x.000000)', expected seconds since 1970"},
             {"(99999999999.000000) can0 123#", "a.log:7:2: found '99999999999.000000)', expected seconds up to 9223372035"},
             {"(1.5) can0 123#", "a.log:7:4: found '5)', expected 6 or 9 digits behind the point"},
             {"(1.000000 can0 123#", "expected ')' behind the stamp"},
             {"(2026-02-30 00:00:00.000000) can0 123#", "a.log:7:2: found '2026-02-30', expected a day that there is"},
             {"(2026-13-30 00:00:00.000000) can0 123#", "expected a month from 01 to 12"},
             {"(2026-12-30 24:00:00.000000) can0 123#", "expected hours from 00 to 23"},
             {"(1.000000)can0 123#", "a.log:7:11: found 'can0', expected a blank between stamp and channel"},
             {"(1.000000) ", "found the end of the line, expected the name of a channel"},
             {"(1.000000) sixteen_letters__ 123#", "expected the name of a channel, at most 15 bytes"},
             {"(1.000000) can0", "found the end of the line, expected a blank and a frame behind the channel"},
             {"(1.000000) can0 12#", "a.log:7:17: found '12#', expected an identifier of 3 or 8 hexadecimal digits"},
             {"(1.000000) can0 12X#", "a.log:7:17: found '12X#', expected an identifier of 3 or 8 hexadecimal digits"},
             {"(1.000000) can0 800#", "expected an identifier of 11 bits, up to 7FF"},
             {"(1.000000) can0 80000000#", "expected an identifier of 29 bits, up to 1FFFFFFF"},
             {"(1.000000) can0 123#1", "a.log:7:21: found '1', expected bytes of two hexadecimal digits each"},
             {"(1.000000) can0 123#11g2", "a.log:7:23: found 'g2', expected bytes of two hexadecimal digits each"},
             {"(1.000000) can0 123#112233445566778899", "expected at most 8 bytes, or '##' and flags for CAN FD"},
             {"(1.000000) can0 123#1122334455667788_8", "expected a data length code from 9 to F"},
             {"(1.000000) can0 123#112233_9", "expected bytes of two hexadecimal digits each"},
             {"(1.000000) can0 123#R9", "expected a length from 0 to 8"},
             {"(1.000000) can0 123#RX", "a.log:7:22: found 'X', expected the end of the line"},
             {"(1.000000) can0 20000001#R", "an error frame is no remote request"},
             {"(1.000000) can0 20000001##0", "an error frame is classic CAN"},
             {"(1.000000) can0 123##", "found the end of the line, expected the flags of CAN FD"},
             {"(1.000000) can0 123##0112233445566778899", "found 9 bytes, expected 0 to 8, 12, 16, 20, 24, 32, 48 or 64"},
             {"(1.000000) can0 123#11 X", "a.log:7:23: found ' X', expected the end of the line"},
             {"(1.000000) can0 45123#81:00:12345678#1122", "found a CAN XL frame, which is not supported, expected classic CAN or CAN FD"},
             {"  can0       123 [0002] (45|81:00:12345678) 11 22", "found a CAN XL frame, which is not supported"},
             {"  can0  123#11", "expected an identifier and a length, as the screen form has; the log form begins with '('"},
             {"  can0  123   8  11", "expected the length, as [8], or of CAN FD [08]"},
             {"  can0  123   [9]  11", "expected a length from 0 to 8, or of CAN FD with two digits"},
             {"  can0  123  [09]  11", "expected a length of CAN FD: 00 to 08, 12"},
             {"  can0  123   [2]  11", "found the end of the line, expected 2 bytes, separated by blanks or all by '`'"},
             {"  can0  123   [2]  11 2", "expected 2 bytes of two hexadecimal digits each"},
             {"  can0  123   [2]  11 22 33", "expected the end of the line"},
             {"  can0  123   [2]  11 22                     'ab'", "expected the bytes' text"},
             {"  can0  20000001   [2]  11 22", "expected ERRORFRAME"},
             {"  can0  RX X -  123   [2]  11 22", "expected the flags of CAN FD"},
             {" \33[7mcan0  123   [2]  11 22", "found '\\x1b[7mcan0', expected one of candump's colours"},
         }) {
        EXPECT_THAT(tests::refusal_of([&] { parsed(bad.line); }), testing::AllOf(HasSubstr(bad.message), testing::StartsWith("a.log:7:")))
            << bad.line;
    }
}

/// Lines of all forms with bytes changed, doubled, dropped and swapped: a frame or a sentence, and a frame's text is read as the same
/// frame.
TEST(CandumpLine, TakesAnyTextAsFrameOrRefusesIt) {
    std::mt19937_64 random(7);
    const std::vector<std::string> seeds = {
        "(1436509052.249713) vcan0 044#2A366C2BBA R",
        "(1436509052.249713421) can0 12345678##5.11.22.33",
        "(1436509052.249713) can0 20000004#0011223344556677",
        "(1436509052.249713) can0 123#R8_F T",
        " (2026-11-22 12:38:19.000001)  can0  RX B E  12345678  [03]  11 22 33",
        "  can0       123   {F}  88`77`66`55`44`33`22`11   `.wfUD3\".`",
        " \33[1m\33[35m(1345212884.318850)  can0  RX - -  123   [1]  11\33[0m",
        "  can0  123   [2]  00010001 11111111                                                           '..'",
        "  can0  20000040   [0]                            ERRORFRAME",
    };
    const std::string alphabet = "0123456789ABCDEFabcdef#.()[]{}_RT :-'`\33\t\r\n\377xX";
    std::size_t frames = 0, refused = 0;
    for (int i = 0; i < 300'000; ++i) {
        std::string line = seeds[random() % seeds.size()];
        for (std::uint64_t n = 1 + random() % 4; n-- > 0 && !line.empty();) {
            const std::size_t at = random() % line.size();
            switch (random() % 5) {
            case 0:
                line[at] = alphabet[random() % alphabet.size()];
                break;
            case 1:
                line.erase(at, 1 + random() % 3);
                break;
            case 2:
                line.insert(at, line.substr(random() % line.size(), random() % 6));
                break;
            case 3:
                line[at] = static_cast<char>(random() % 256);
                break;
            default:
                line.resize(at);
            }
        }
        try {
            const CandumpLine read = parse_candump_line(line, here);
            const std::string text = candump_line(read.frame, read.style);
            CandumpLine again;
            ASSERT_NO_THROW(again = parse_candump_line(text, here)) << line << '\n' << text;
            ASSERT_EQ(again.frame, read.frame) << line << '\n' << text;
            ASSERT_LE(read.frame.length, 64);
            ++frames;
        } catch (const InputError& error) {
            ASSERT_EQ(error.where().line, 7U) << line;
            ++refused;
        }
    }
    EXPECT_GT(frames, 20'000U); // neither all nor none
    EXPECT_GT(refused, 100'000U);
}

// candump's filters with the kernel's meaning; the examples are those of candump's own help.

bool passes(const std::string& filters, const std::string& frame) {
    return parse_can_filters(filters, "--filter").passes(parse_candump_line("(1.000000) can0 " + frame, {}).frame);
}

/// Filters, with frames that pass them and frames that do not.
TEST(CanFilter, LooksAtTheBitsOfTheMaskOfAnyOrAllFilters) {
    struct Case {
        std::string filters;
        std::vector<std::string> pass, stop;
    };
    for (const Case& one : std::initializer_list<Case>{
             {"123:7FF", {"123#11", "123##111", "00000123#11", "123#R", "12345123#11"}, {"124#11"}}, // "including EFF and RTR frames"
             {"400:700", {"4FF#11"}, {"500#11"}},
             {"400~7F0", {"410#11"}, {"40F#11"}},
             {"0x123:0x7ff", {"123#11"}, {}},
             {"123:C00007FF", {"123#11"}, {"00000123#11", "123#R"}},           // "only SFF and non-RTR frames"
             {"12345678:DFFFFFFF", {"12345678#11"}, {"678#11", "12345678#R"}}, // "only for extended CAN ID 12345678"
             {"00000123:DFFFFFFF", {"00000123#"}, {"123#"}},
             {"123:9FFFFFFF", {"123#"}, {"00000123#"}}, // the extended flag in the mask: 11 bits are looked at
             {"0:0", {}, {"20000004#0000000000000000"}},
             {"0:0,#FFFFFFFF", {"20000004#0000000000000000", "123#"}, {}},
             {"0~0,#FFFFFFFF", {"20000004#0000000000000000"}, {"123#"}}, // "only error frames"
             {"#00000003", {"123#"}, {"20000004#0000000000000000"}},     // without a filter for data frames all of them
             {"100:700,200:700", {"2AA#"}, {"3AA#"}},
             {"100~7FF,200~7FF", {"100#"}, {}},
             {"100~7FF,200~7FF,j", {}, {"100#"}},
             {"100~7FF,200~7FF,J", {"300#"}, {}}}) {
        for (const std::string& frame : one.pass)
            EXPECT_TRUE(passes(one.filters, frame)) << one.filters << ' ' << frame;
        for (const std::string& frame : one.stop)
            EXPECT_FALSE(passes(one.filters, frame)) << one.filters << ' ' << frame;
    }
}

TEST(CanFilter, BelongsToAChannelAndSaysWhatIsNone) {
    const CanFrame frame = parse_candump_line("(1.000000) can0 123#", {}).frame;
    CanFrame error = parse_candump_line("(1.000000) can0 20000001#", {}).frame;
    EXPECT_TRUE(parse_channel_filter("can0", "--channel").passes(frame));
    EXPECT_TRUE(parse_channel_filter("can0", "--channel").passes(error));
    EXPECT_FALSE(parse_channel_filter("can0,0:0", "--channel").passes(error));
    EXPECT_FALSE(parse_channel_filter("can1", "--channel").passes(frame));
    EXPECT_TRUE(parse_channel_filter("any", "--channel").passes(frame));
    EXPECT_TRUE(parse_channel_filter("any,123:7FF", "--channel").passes(frame));
    EXPECT_FALSE(parse_channel_filter("can0,124:7FF,#FF", "--channel").passes(frame));
    for (const char* bad : {"", "123", "123:", ":7FF", "123:7FG", "123:7FF,", "#", "#X", "123456789:7FF", "jj", "123:7FF:1", "-1:7FF"})
        EXPECT_THROW(parse_can_filters(bad, "--filter"), InputError) << bad;
    for (const char* bad : {"", ",123:7FF", "sixteen_letters__", "can0,"})
        EXPECT_THROW(parse_channel_filter(bad, "--channel"), InputError) << bad;
    EXPECT_THAT(tests::refusal_of([] { parse_can_filters("123:7FF,nonsense", "--filter"); }),
                HasSubstr("--filter: found 'nonsense', expected filters as candump has them"));
}

// Error frames in words: data after include/uapi/linux/can/error.h, words as candump -e prints them.

std::vector<std::string> words(const std::string& frame) { return error_words(parse_candump_line("(1.000000) can0 " + frame, {}).frame); }

TEST(ErrorWords, NameClassesAndWhatTheirDataSay) {
    EXPECT_THAT(words("20000001#0000000000000000"), ElementsAre("tx-timeout"));
    EXPECT_THAT(words("20000002#0B00000000000000"), ElementsAre("lost-arbitration{at bit 11}"));
    EXPECT_THAT(words("20000004#0004000000000000"), ElementsAre("controller-problem{rx-error-warning}"));
    EXPECT_THAT(words("20000004#0030000000000000"), ElementsAre("controller-problem{rx-error-passive,tx-error-passive}"));
    EXPECT_THAT(words("20000008#0000041900000000"), ElementsAre("protocol-violation{{bit-stuffing-error}{acknowledge-slot}}"));
    EXPECT_THAT(words("20000040#0000000000000000"), ElementsAre("bus-off"));
    EXPECT_THAT(words("20000204#0008000000008060"), ElementsAre("controller-problem{tx-error-warning}", "error-counter-tx-rx{{128}{96}}"));
    EXPECT_THAT(words("20000080#0000000000000102"), ElementsAre("bus-error", "error-counter-tx-rx{{1}{2}}"));
    EXPECT_THAT(words("200000A8#000000FF00000000"), ElementsAre("protocol-violation{{}{}}", "no-acknowledgement-on-tx", "bus-error"));
    EXPECT_TRUE(words("20001000#0000000000000000").empty());
    EXPECT_TRUE(words("123#11").empty());
}

} // namespace
} // namespace fernlicht
