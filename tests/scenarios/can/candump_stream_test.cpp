// Whole logs of candump: kinds of lines, what stamps count from, real ones.
#include "scenarios/can/candump_stream.h"
#include "tests/trial.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <tuple>

namespace fernlicht {
namespace {

using testing::ElementsAre, testing::HasSubstr;
using What = CandumpStream::What;

std::vector<std::int64_t> times_ms(const std::string& text, const CandumpReading& reading = {}) {
    CandumpStream stream("a.log", text, reading);
    std::vector<std::int64_t> times;
    for (What what; (what = stream.next()) != What::end;)
        if (what == What::frame)
            times.push_back(stream.line().frame.time_ns / 1'000'000);
    return times;
}

std::string refusal(const std::string& text, const CandumpReading& reading = {}) {
    return tests::refusal_of([&] { times_ms(text, reading); });
}

TEST(CandumpStream, TellsFramesFromWhatStandsBetweenThem) {
    CandumpStream stream("a.log", "# a comment\n"
                                  "\n"
                                  "(0000000001.000000) can0 20000004#0004000000000000\r\n"
                                  "\tcontroller-problem{rx-error-warning}\n"
                                  "DROPCOUNT: dropped 2 CAN frames on 'can1' socket (total drops 7)\n"
                                  "; another\n"
                                  "(0000000002.000000) can0 123#11");
    std::vector<What> kinds;
    for (What what; (what = stream.next()) != What::end;) {
        kinds.push_back(what);
        EXPECT_EQ(stream.ended(), kinds.size() < 7);
        if (what == What::lost) {
            EXPECT_EQ(stream.lost().channel, "can1");
            EXPECT_EQ(stream.lost().frames, 2U);
            EXPECT_EQ(stream.lost().total, 7U);
        }
    }
    EXPECT_THAT(kinds, ElementsAre(What::comment, What::comment, What::frame, What::explanation, What::lost, What::comment, What::frame));
    EXPECT_EQ(std::tuple(stream.text(), stream.line_number()), std::tuple("(0000000002.000000) can0 123#11", 7U));
}

TEST(CandumpStream, GoesOnBehindABadLine) {
    CandumpStream stream("a.log", "(1.000000) can0 123#11\nnonsense\n(2.000000) can0 123#22\n");
    EXPECT_EQ(stream.next(), What::frame);
    EXPECT_THROW(stream.next(), InputError);
    EXPECT_EQ(stream.next(), What::frame);
    EXPECT_EQ(stream.line().frame.data[0], 0x22);
    EXPECT_EQ(std::tuple(stream.next(), stream.next()), std::tuple(What::end, What::end));
}

TEST(CandumpStream, GoesOnBehindALineThatIsTooLong) {
    for (const std::size_t length : {16'385U, 20'000U, 300'000U, 2'000'000U})
        for (const bool in_a_file : {false, true}) {
            const std::string text =
                std::string(length, 'x') + "\n(1.000000) can0 123#11\n" + std::string(length, 'y') + "\n(2.000000) can0 123#22";
            CandumpStream stream = in_a_file ? CandumpStream(tests::written("long.log", text).string()) : CandumpStream("a.log", text);
            EXPECT_THROW(stream.next(), InputError);
            EXPECT_EQ(stream.next(), What::frame) << length;
            EXPECT_EQ(stream.line_number(), 2U);
            EXPECT_THROW(stream.next(), InputError);
            EXPECT_EQ(stream.next(), What::frame);
            EXPECT_EQ(stream.line().frame.data[0], 0x22);
            EXPECT_EQ(stream.next(), What::end);
        }
}

TEST(CandumpStream, RefusesWhatIsNoLogAndTimesBeyondItsClock) {
    EXPECT_THAT(refusal(std::string(20'000, 'x')), HasSubstr("a.log:1: found a line of more than 16384 bytes"));
    EXPECT_THAT(refusal("(1.000000) can0 123#11\n" + std::string(20'000, ' ') + "\n"), HasSubstr("a.log:2: found a line of more"));
    EXPECT_THAT(refusal("(1.000000) can0 123#11\n\tword\n"), HasSubstr("a.log:2:1"));
    EXPECT_THAT(refusal("DROPCOUNT: dropped many CAN frames\n"), HasSubstr("a.log:1:1"));
    EXPECT_THAT(refusal(std::string("\0\0\0\n", 4)), HasSubstr("a.log:1:1: found '\\x00\\x00\\x00'"));
    EXPECT_THAT(refusal("(9000000000.000000) can0 123#\n(9000000000.000000) can0 123#\n", {.stamps = CandumpStamps::delta}),
                HasSubstr("a.log:2: found stamps that add up"));
    EXPECT_THROW(CandumpStream("/nowhere/a.log"), InputError);
    EXPECT_THROW(CandumpStream("/"), InputError);
}

TEST(CandumpStream, KnowsWhatStampsCountFrom) {
    const std::string delta = " (000.000000)  can0  123   [0] \n (000.250000)  can0  123   [0] \n (000.100000)  can0  123   [0] \n";
    const std::string zero = " (000.000000)  can0  123   [0] \n (000.250000)  can0  123   [0] \n (000.350000)  can0  123   [0] \n";
    const std::string absolute = "(0000000000.000000) can0 123#\n(0000000000.250000) can0 123#\n(0000000000.100000) can0 123#\n";
    EXPECT_THAT(times_ms(delta), ElementsAre(0, 250, 350));
    EXPECT_THAT(times_ms(zero), ElementsAre(0, 250, 350));
    EXPECT_THAT(times_ms(absolute), ElementsAre(0, 250, 100));
    CandumpReading reading{.first_ns = 5'000'000'000};
    EXPECT_THAT(times_ms(delta, reading), ElementsAre(5000, 5250, 5350));
    EXPECT_THAT(times_ms(zero, reading), ElementsAre(5000, 5250, 5350));
    EXPECT_THAT(times_ms(absolute, reading), ElementsAre(0, 250, 100)); // nothing to add to
    reading.stamps = CandumpStamps::delta;
    EXPECT_THAT(times_ms(absolute, reading), ElementsAre(5000, 5250, 5350));
    reading.stamps = CandumpStamps::zero;
    EXPECT_THAT(times_ms(delta, reading), ElementsAre(5000, 5250, 5100));
    reading.stamps = CandumpStamps::absolute;
    EXPECT_THAT(times_ms(delta, reading), ElementsAre(0, 250, 100));
    // The log form has zero stamps (candump -L -tz), never deltas.
    EXPECT_THAT(times_ms("(000.000000) can0 123#\n(000.250000) can0 123#\n(000.100000) can0 123#\n"), ElementsAre(0, 250, 100));
}

TEST(CandumpStream, TakesDatesByTheOffsetFromUtc) {
    const std::string text = " (2026-11-22 12:38:19.250000)  can0  123   [0] \n";
    CandumpReading reading;
    EXPECT_THAT(times_ms(text, reading), ElementsAre(1795351099250));
    reading.utc_offset_s = 3600;
    EXPECT_THAT(times_ms(text, reading), ElementsAre(1795347499250));
    EXPECT_THAT(refusal(" (1970-01-01 00:30:00.000000)  can0  123   [0] \n", reading), HasSubstr("before 1970 in UTC"));
}

TEST(CandumpStream, ReadsFilesInPiecesAsFromMemory) {
    std::string text;
    for (int i = 0; i < 40'000; ++i) // lines across the ends of what is read at once
        text += candump_line({.time_ns = i * 1'000'000LL,
                              .channel = "can0",
                              .id = static_cast<std::uint32_t>(i % 2048),
                              .length = static_cast<std::uint8_t>(i % 9)}) +
                "\n";
    const std::filesystem::path path = tests::written("pieces.log", text);
    std::string again;
    CandumpStream stream(path);
    EXPECT_TRUE(stream.may_wait());
    while (stream.next() == What::frame)
        again += candump_line(stream.line().frame, stream.line().style) + "\n";
    EXPECT_EQ(again, text);
    FilesRead opened;
    EXPECT_EQ(read_candump(path, opened).size(), 40'000U);
    ASSERT_EQ(opened.size(), 1U);
    EXPECT_EQ(opened[0].bytes, text.size());
}

TEST(CandumpStream, WritesTheRecordingOfOthersBackByteByByte) {
    const std::filesystem::path path = std::filesystem::path(FERNLICHT_SHARED_DATA) / "can/collin80__SavvyCAN/examples/candump.log";
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << path << " is not there";
    FilesRead opened;
    const std::string text = read_file(path, opened);
    std::string again;
    CandumpStream stream(path, text);
    for (What what; (what = stream.next()) != What::end;) {
        ASSERT_EQ(what, What::frame);
        append_candump_line(again, stream.line().frame, stream.line().style);
        again += '\n';
    }
    EXPECT_TRUE(again == text);
    EXPECT_EQ(stream.line_number(), 12974U);
}

} // namespace
} // namespace fernlicht
