// candump itself, with frames of ours from a socket that is none: what it prints is read, written back and converted byte by byte.
#include "scenarios/can/candump_stream.h"
#include "tests/runner/program.h"
#include "tests/scenarios/can/random_frames.h"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// As fake_can_socket.c reads it.
struct SocketRecord {
    std::int64_t seconds, microseconds;
    char channel[16];
    std::uint32_t bytes, sent, lost;
    std::uint32_t id;
    std::uint8_t length, flags, reserved, raw_dlc;
    std::uint8_t data[64];
};
static_assert(sizeof(SocketRecord) == 120);

class CandumpTest : public testing::Test {
  protected:
    void SetUp() override {
        if (run_shell("command -v candump").exit_code != 0)
            GTEST_SKIP() << "candump of can-utils is not installed";
        const std::string help = run_shell("candump").output;
        knows_dlc_ = help.find(" -8 ") != std::string::npos;
        knows_nanoseconds_ = help.find(" -N ") != std::string::npos;
        std::mt19937_64 random(42);
        std::ofstream file(folder_ / "frames", std::ios::binary);
        std::int64_t time_ns = 1'436'509'052'249'713'000;
        for (int i = 0; i < 3'000; ++i) {
            CanFrame frame = random_frame(random);
            frame.time_ns = time_ns += static_cast<std::int64_t>(random() % 4 == 0 ? 0 : random() % 1'500'000) * 1000;
            frame.channel = std::array<const char*, 3>{
                "can0", "vcan12", "fifteen_letters"}[std::min<std::size_t>(random() % 3, static_cast<std::size_t>(i) / 100)];
            if (frame.error) {
                frame.id &= 0x1ffU; // classes that every version has words for
                frame.length = 8;
            }
            if (!knows_dlc_)
                frame.raw_dlc = 0;
            SocketRecord record{.seconds = frame.time_ns / 1'000'000'000, .microseconds = frame.time_ns % 1'000'000'000 / 1000};
            frame.channel.copy(record.channel, sizeof record.channel - 1);
            record.bytes = frame.fd ? 72 : 16;
            record.sent = random() % 2;
            record.lost = random() % 50 == 0 ? 1 + static_cast<std::uint32_t>(random() % 2) : 0;
            record.id = frame.id | (frame.extended ? 0x80000000U : 0) | (frame.remote ? 0x40000000U : 0) | (frame.error ? 0x20000000U : 0);
            record.length = frame.length;
            record.flags = static_cast<std::uint8_t>((frame.bit_rate_switch ? 1 : 0) | (frame.error_state_indicator ? 2 : 0));
            record.raw_dlc = frame.raw_dlc;
            std::ranges::copy(frame.data, record.data);
            file.write(reinterpret_cast<const char*>(&record), sizeof record);
            frames_.push_back(frame);
        }
    }

    std::string candump(const std::string& options, const std::string& zone = "UTC0") const {
        const Outcome outcome = run_shell("TZ=" + zone + " LD_PRELOAD='" FERNLICHT_FAKE_CAN "' FERNLICHT_FRAMES='" + (folder_ / "frames") +
                                          "' candump -d -n 3000 " + options + " any > '" + (folder_ / "printed") + "'");
        EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
        return content_of(folder_ / "printed");
    }

    std::string ours(const std::string& arguments) const {
        const Outcome outcome = run_program("can " + arguments + " > '" + (folder_ / "ours") + "'");
        EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
        return content_of(folder_ / "ours");
    }

    std::string file_of(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return "'" + (folder_ / name) + "'";
    }

    static void expect_same(const std::string& text, const std::string& expected) {
        const std::size_t at = static_cast<std::size_t>(std::ranges::mismatch(text, expected).in1 - text.begin());
        const std::size_t line = text.rfind('\n', at) + 1, other = expected.rfind('\n', at) + 1;
        EXPECT_TRUE(text == expected) << text.substr(line, 200) << "\nexpected\n" << expected.substr(other, 200);
    }

    TemporaryFolder folder_;
    std::vector<CanFrame> frames_;
    bool knows_dlc_ = false, knows_nanoseconds_ = false;
};

TEST_F(CandumpTest, WritesLogsThatAreReadAndWrittenWithoutLoss) {
    for (const std::string options : {"-L", "-L -x"}) {
        const std::string text = candump(options), file = file_of("a.log", text);
        CandumpStream stream("a.log", text);
        std::vector<CanFrame> read;
        std::string again;
        std::uint64_t lost = 0;
        for (CandumpStream::What what; (what = stream.next()) != CandumpStream::What::end;) {
            if (what == CandumpStream::What::frame) {
                read.push_back(stream.line().frame);
                append_candump_line(again, read.back(), stream.line().style);
                again += '\n';
            } else {
                ASSERT_EQ(what, CandumpStream::What::lost);
                lost += stream.lost().frames;
                EXPECT_EQ(stream.lost().total, lost);
                again += stream.text();
                again += '\n';
            }
        }
        EXPECT_TRUE(read == frames_);
        EXPECT_GT(lost, 0U);
        expect_same(again, text);
        expect_same(ours("cut " + file), text);
        expect_same(ours("convert " + file), text);
        expect_same(ours("merge " + file), text);
    }
}

TEST_F(CandumpTest, PrintsWhatWeConvertALogTo) {
    const std::string log = file_of("a.log", candump("-L -x"));
    std::vector<std::string> looks = {"-ta",    "-td -x",       "-tz -a",       "-ta -x -a -e", "-ta -i",       "-td -i -a -e",
                                      "-ta -S", "-tz -S -a -x", "-ta -S -i -a", "-ta -c -x",    "-td -c -c -e", "-tz -c -c -c -x -e",
                                      "-tA -c", "-tA -x"};
    if (knows_dlc_)
        looks.insert(looks.end(), {"-ta -8", "-td -8 -x -a -e"});
    if (knows_nanoseconds_)
        looks.insert(looks.end(), {"-ta -N", "-td -N", "-tA -N -x"});
    for (const std::string& look : looks) {
        SCOPED_TRACE(look);
        const std::string printed = candump(look);
        expect_same(ours("convert --screen " + look + " " + log), printed);
        expect_same(ours("cut " + file_of("screen.txt", printed)), printed);
    }
    expect_same(ours("convert --screen -tA --utc-offset +05:30 " + log), candump("-tA", "IST-5:30"));
    expect_same(ours("convert --screen -t n " + log), candump(""));
}

TEST_F(CandumpTest, PrintsScreensThatAreReadAsTheFramesThatWere) {
    for (const std::string look : {"-ta -x", "-td -x -i -S", "-tz -c -x -a -e", "-tA -c -c -c -x"}) {
        SCOPED_TRACE(look);
        const std::string screen = file_of("screen.txt", candump(look));
        const std::string text = ours("convert -ta --start 1436509052.249713 " + screen);
        CandumpStream stream("back.log", text);
        std::vector<CanFrame> read;
        for (CandumpStream::What what; (what = stream.next()) != CandumpStream::What::end;)
            if (what == CandumpStream::What::frame)
                read.push_back(stream.line().frame);
        std::vector<CanFrame> expected = frames_;
        expected.front().time_ns =
            look.starts_with("-td") || look.starts_with("-tz") ? 1'436'509'052'249'713'000 : expected.front().time_ns;
        const std::int64_t off_ns = expected.front().time_ns - frames_.front().time_ns;
        for (CanFrame& frame : expected) {
            frame.raw_dlc = 0; // shown by -8 alone
            if (&frame != &expected.front())
                frame.time_ns += off_ns;
        }
        ASSERT_EQ(read.size(), expected.size());
        for (std::size_t i = 0; i < read.size(); ++i)
            ASSERT_EQ(read[i], expected[i]) << i << ' ' << candump_line(read[i]) << ' ' << candump_line(expected[i]);
    }
}

} // namespace
} // namespace fernlicht
