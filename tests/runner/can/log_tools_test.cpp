// fernlicht can merge, cut and convert, as a user runs them; beside can-utils' own file tools where these are installed.
#include "scenarios/can/candump_log.h"
#include "tests/runner/program.h"
#include "tests/scenarios/can/random_frames.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tuple>

namespace fernlicht {
namespace {

using testing::AllOf, testing::HasSubstr, testing::StartsWith;

std::string written(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return "'" + (folder / name) + "'";
}

/// Standard output alone.
std::string told(const TemporaryFolder& folder, const std::string& arguments) {
    const Outcome outcome = run_program(arguments + " > '" + (folder / "told") + "'");
    EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.output;
    return content_of(folder / "told");
}

bool is_installed(const std::string& program) { return run_shell("command -v " + program).exit_code == 0; }

const std::string mixed_log = "(0000000010.000000) can0 100#0011\n"
                              "(0000000010.500000) can1 100#0011\n"
                              "(0000000010.500000) can0 00000100#\n"
                              "(0000000011.000000) can0 200##1AABBCC\n"
                              "(0000000011.500000) can0 20000040#0000000000000000\n"
                              "DROPCOUNT: dropped 3 CAN frames on 'can1' socket (total drops 3)\n"
                              "(0000000012.000000) can0 100#R2\n";

TEST(CanCut, KeepsWhatIsAskedForAndNothingElse) {
    const TemporaryFolder folder;
    const std::string log = written(folder, "a.log", mixed_log);
    EXPECT_EQ(told(folder, "can cut " + log), mixed_log);
    EXPECT_EQ(told(folder, "can cut - < " + log), mixed_log);
    EXPECT_EQ(told(folder, "can cut " + written(folder, "mark.log", "\xef\xbb\xbf" + mixed_log)), mixed_log);
    const auto stamps = [&](const std::string& flags) {
        std::string text;
        std::istringstream lines(told(folder, "can cut " + log + " " + flags));
        for (std::string line; std::getline(lines, line);)
            text += line.starts_with("(") ? line.substr(9, 4) + line.substr(20, 4) + " " : "lost ";
        return text;
    };
    EXPECT_EQ(stamps("--from 10.5 --to 11"), "10.5can1 10.5can0 11.0can0 lost ");
    EXPECT_EQ(stamps("--from +0.5 --to +1.000000000 --channel can0"), "10.5can0 11.0can0 ");
    EXPECT_EQ(stamps("--id 100"), "10.0can0 10.5can1 lost 12.0can0 ");
    EXPECT_EQ(stamps("--id 00000100,200 --channel any"), "10.5can0 11.0can0 lost ");
    EXPECT_EQ(stamps("--filter 100:C00007FF --channel can0"), "10.0can0 ");
    EXPECT_EQ(stamps("--filter 0~0,#FFFFFFFF --channel can0"), "11.5can0 ");
    EXPECT_EQ(stamps("--channel can1 --channel can0,200:7FF"), "10.5can1 11.0can0 lost ");
    EXPECT_EQ(stamps("--channel can0 --invert"), "10.5can1 ");
}

TEST(CanCut, KeepsDeltasTrueAndAsksWhatAPipeCannotTell) {
    const TemporaryFolder folder;
    const std::string log = written(folder, "d.txt",
                                    " (000.000000)  can0  100   [0] \n (000.100000)  can0  200   [1]  11\n"
                                    " (000.300000)  can0  100   [0] \n (000.100000)  can0  200   [1]  22\n");
    EXPECT_EQ(told(folder, "can cut --id 200 " + log), " (000.000000)  can0  200   [1]  11\n (000.400000)  can0  200   [1]  22\n");
    EXPECT_EQ(told(folder, "can cut --from +0.2 --to +0.45 " + log), " (000.000000)  can0  100   [0] \n");
    const Outcome outcome = run_program("can convert -", "cat " + log + " |");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output,
                HasSubstr("standard input:1: found stamps that start at 0, expected to be told whether they are delta or zero"));
    EXPECT_EQ(run_program("can convert --stamps delta -", "cat " + log + " |").exit_code, 0);
}

TEST(CanCut, RefusesInOneSentence) {
    const TemporaryFolder folder;
    const std::string log = written(folder, "a.log", "(1.000000) can0 123#11\n(2.000000) can0 123#1\n");
    const auto refused = [&](const std::string& arguments, const std::string& sentence) {
        const Outcome outcome = run_program("can " + arguments);
        EXPECT_EQ(outcome.exit_code, 2) << arguments;
        EXPECT_THAT(outcome.output, HasSubstr(sentence));
        EXPECT_THAT(outcome.output, testing::EndsWith("\n"));
    };
    refused("cut " + log, "a.log:2:21: found '1', expected bytes of two hexadecimal digits each");
    refused("cut " + (folder / "none.log"), "none.log: cannot be read: No such file or directory");
    refused("cut --id 800 " + log, "--id: found '800', expected an identifier up to 7FF");
    refused("cut --id 12345 " + log, "--id: found '12345'");
    refused("cut --from soon " + log, "--from: found 'soon', expected seconds from 0 up");
    refused("cut --from 1.0123456789 " + log, "at most nine digits behind the point");
    refused("cut --filter 123 " + log, "--filter: found '123', expected filters as candump has them");
    refused("cut --stamps late " + log, "--stamps: found 'late', expected absolute, zero or delta");
    refused("cut --utc-offset 2 " + log, "--utc-offset: found '2', expected hours and minutes");
    refused("merge --offset fast " + log, "--offset: found 'fast', expected seconds");
    refused("merge --offset=-5 " + log, "a.log:1: found a stamp that --offset takes before 0");
    refused("merge - - ", "expected standard input once");
    refused("convert -t d " + log, "-t: found 'd', expected a or z in the log form");
    refused("convert -a " + log, "found -a without --screen, expected both: the log form has one look");
    refused("convert --out " + log + " " + log, "a.log is there already, expected a new file, or --force");
    refused("cut --to 5 " + written(folder, "none.txt", "  can0  123   [0] \n"),
            "none.txt:1: found a frame without a stamp, expected stamps to cut by");
    refused("", "found no tool behind can, expected one of merge, cut");
    refused("cutt " + log, "found 'cutt' behind can, expected a tool, cut perhaps");
    refused("cut --bogus " + log, "--bogus");
    refused("--bogus cut " + log, "found '--bogus' behind can");
    refused("convert -a -8 " + log, "found -a, -8 without --screen, expected both: the log form has one look");
    refused("cut --from 5 --to 3 " + log, "--to: found '3', expected a time not before --from");
    refused("cut --from +5 --to +3 " + log, "--to: found '+3'");
    const std::string good = written(folder, "good.log", "(1.000000) can0 123#11\n");
    for (const std::string name : {"ome.log=can1", "foo=bar"})
        refused("merge " + good + " --rename-channel " + name,
                "--rename-channel: found '" + name + "', expected one of the files or a channel of theirs");
    refused("cut " + written(folder, "junk.log", "\x80\xff \xc3\xa4\n"), "junk.log:1:1: found '\\x80\\xff");
}

TEST(CanCut, SkipsBadLinesWhereAskedToAndTellsOfChannelsThatNoFrameHas) {
    const TemporaryFolder folder;
    const std::string bad = written(folder, "a.log", "(1.000000) can0 123#11\nx\ny\n(2.000000) can0 123#22\n(3.000000) can0 1"),
                      wide = written(folder, "b.log", std::string(40'000, 'x') + "\n(000.000000) can0 123#11\n(000.500000) can0 123#22\n");
    const Outcome lenient = run_program("can cut --lenient " + bad), long_line = run_program("can cut --lenient " + wide),
                  channels = run_program("can cut --channel can7 --channel can1 -o /dev/null " + written(folder, "c.log", mixed_log));
    EXPECT_EQ(std::tuple(lenient.exit_code, long_line.exit_code, channels.exit_code), std::tuple(0, 0, 0));
    EXPECT_THAT(lenient.output,
                AllOf(HasSubstr("skipped: "), HasSubstr("a.log:2:1: found 'x'"), HasSubstr("3 lines skipped that are no frames"),
                      HasSubstr("(1.000000) can0 123#11\n(2.000000) can0 123#22\n")));
    EXPECT_THAT(long_line.output, AllOf(HasSubstr("b.log:1: found a line of more than 16384 bytes"),
                                        HasSubstr("(000.000000) can0 123#11\n(000.500000) can0 123#22\n")));
    EXPECT_THAT(channels.output, AllOf(testing::EndsWith("c.log: no frame of channel can7\n"), testing::Not(HasSubstr("channel can1"))));
}

/// What is read may be what is written; what fails leaves the file that was there, and nothing beside it.
TEST(CanTools, LoseNoFileThatIsReplaced) {
    const TemporaryFolder folder;
    const std::string log = written(folder, "a.log", mixed_log), kept = "(0000000010.000000) can0 100#0011\n";
    std::filesystem::create_symlink("a.log", folder / "link.log");
    const std::string names[] = {log, "'" + (folder / "./a.log") + "'", "'" + (folder / "link.log") + "'"};
    for (const std::string& name : names) {
        for (const std::string tool : {"cut", "convert", "merge"}) {
            EXPECT_EQ(run_program("can " + tool + " " + log + " --force -o " + name).exit_code, 0) << tool;
            EXPECT_THAT(content_of(folder / "a.log"), StartsWith(kept)) << tool;
        }
    }
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.log"));
    EXPECT_EQ(run_program("can cut --to 10.4 " + log + " --force -o " + log).exit_code, 0);
    EXPECT_THAT(content_of(folder / "a.log"), StartsWith(kept));
    const std::string before = content_of(folder / "a.log");

    const std::string half = written(folder, "half.log", kept + "junk\n");
    EXPECT_EQ(run_program("can cut " + half + " --force -o " + log).exit_code, 2);
    EXPECT_EQ(content_of(folder / "a.log"), before);
    const Outcome outcome = run_program("can cut " + half);
    EXPECT_THAT(outcome.output, StartsWith(kept)) << "good lines come out before a bad one is refused";
    EXPECT_EQ(run_program("can cut " + written(folder, "junk.log", "junk\n") + " -o '" + (folder / "new.log") + "'").exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "new.log"));
    EXPECT_EQ(run_program("can cut " + log + " -o /dev/null").exit_code, 0);
    EXPECT_EQ(run_program("can cut " + log + " --force -o /dev/full").exit_code, 3);
    for (const auto& entry : std::filesystem::directory_iterator(folder / ""))
        EXPECT_EQ(entry.path().string().find(".part-"), std::string::npos) << entry.path();
}

TEST(CanMerge, IsStableByTime) {
    const TemporaryFolder folder;
    const std::string a =
        written(folder, "a.log", "(0000000001.000000) can0 001#\n(0000000002.000000) can0 002#\n(0000000002.000000) can0 003#\n");
    const std::string b = written(folder, "b.log", "# begins\n(0000000002.000000) can0 004#\n(0000000003.000000) can0 005# R\n");
    EXPECT_EQ(told(folder, "can merge " + a + " " + b),
              "# begins\n(0000000001.000000) can0 001#\n(0000000002.000000) can0 002#\n"
              "(0000000002.000000) can0 003#\n(0000000002.000000) can0 004#\n(0000000003.000000) can0 005# R\n");
    EXPECT_THAT(told(folder, "can merge " + b + " - < " + a),
                HasSubstr("001#\n(0000000002.000000) can0 004#\n(0000000002.000000) can0 002#\n"));
    const std::string renamed = told(folder, "can merge " + a + " " + b + " --rename-channel " + b + "=can1 --offset " + b + "=-1.5 -o - ");
    EXPECT_EQ(renamed, "# begins\n(0000000000.500000) can1 004#\n(0000000001.000000) can0 001#\n(0000000001.500000) can1 005# R\n"
                       "(0000000002.000000) can0 002#\n(0000000002.000000) can0 003#\n");
    EXPECT_EQ(run_program("can merge -o '" + (folder / "out.log") + "' " + a + " --rename-channel can0=vcan3").exit_code, 0);
    EXPECT_EQ(content_of(folder / "out.log"),
              "(0000000001.000000) vcan3 001#\n(0000000002.000000) vcan3 002#\n(0000000002.000000) vcan3 003#\n");
}

/// Stamps of a log have six digits; with an offset below a microsecond they need nine, or the result would fall.
TEST(CanMerge, KeepsNanosecondsOfAnOffset) {
    const TemporaryFolder folder;
    const std::string a = written(folder, "a.log", "(0000000001.000000) can0 001#\n");
    const std::string b = written(folder, "b.log", "(0000000001.000000100) can0 002#\n");
    EXPECT_EQ(told(folder, "can merge " + a + " " + b + " --offset " + a + "=0.0000005"),
              "(0000000001.000000100) can0 002#\n(0000000001.000000500) can0 001#\n");
}

TEST(CanMerge, MakesDeltasAbsoluteAndKeepsWhatFalls) {
    const TemporaryFolder folder;
    const std::string d = written(folder, "d.txt",
                                  " (000.000000)  can0  TX - -  100   [0] \n (000.300000)  can0  RX - -  100   [0] \n (000.100000)  can0  "
                                  "RX - -  20000001   [0]                            ERRORFRAME\n\ttx-timeout\n");
    EXPECT_EQ(told(folder, "can merge --start 5.5 " + d),
              "(005.500000) can0 100# T\n(005.800000) can0 100# R\n(005.900000) can0 20000001# R\n");
    const std::string falls = written(folder, "f.log", "(0000000002.000000) can0 001#\n(0000000001.000000) can0 002#\n");
    const Outcome outcome = run_program("can merge " + falls);
    EXPECT_THAT(outcome.output, HasSubstr("f.log:2: its stamps fall; its own order is kept"));
    EXPECT_THAT(outcome.output, HasSubstr("001#\n(0000000001.000000) can0 002#"));
    EXPECT_EQ(told(folder, "can convert --sort " + falls), "(0000000001.000000) can0 002#\n(0000000002.000000) can0 001#\n");
}

TEST(CanConvert, GoesToTheScreenAndBack) {
    const TemporaryFolder folder;
    std::mt19937_64 random(11);
    std::string text;
    std::int64_t time_ns = 1'436'509'052'000'000'000;
    for (int i = 0; i < 5'000; ++i) {
        CanFrame frame = random_frame(random);
        frame.time_ns = time_ns += static_cast<std::int64_t>(random() % 100'000) * 1000;
        frame.channel = "can0";
        CandumpStyle style{.sent = random() % 2 == 0};
        text += candump_line(frame, style) + "\n";
    }
    const std::string log = written(folder, "a.log", text);
    EXPECT_EQ(told(folder, "can convert " + log), text);
    for (const std::string look :
         {"-ta -x -8", "-tA -x -8 -a --utc-offset +05:30", "-td -x -8 -i -e", "-tz -x -8 -S -a -c", "-ta -N -x -8 -ccc -e"}) {
        SCOPED_TRACE(look);
        const std::string screen = written(folder, "screen.txt", told(folder, "can convert --screen " + look + " " + log));
        std::string back = "can convert -ta " + screen + " --start 1436509052." + text.substr(12, 6);
        if (look.find("utc") != std::string::npos)
            back += " --utc-offset +0530";
        std::string again = told(folder, back);
        if (look.find("-N") != std::string::npos) { // nine digits come back as nine
            const std::string nine = written(folder, "nine.log", again);
            EXPECT_EQ(told(folder, "can merge " + nine), again);
            for (std::size_t at = 0; (at = again.find("000) can0", at)) != std::string::npos;)
                again.erase(at, 3);
        }
        ASSERT_TRUE(again == text) << again.substr(0, 400);
        EXPECT_EQ(told(folder, "can cut " + screen), content_of(folder / "screen.txt"));
        EXPECT_EQ(told(folder, "can convert --screen " + look + " " + log + " | '" FERNLICHT_BINARY "' can cut - --stamps " +
                                   (look.starts_with("-td")   ? "delta"
                                    : look.starts_with("-tz") ? "zero"
                                                              : "absolute")),
                  content_of(folder / "screen.txt"));
    }
}

/// A pipe that does not end: each line comes out before the next goes in, and Ctrl-C ends it.
TEST(CanTools, FollowAPipeThatDoesNotEnd) {
    const TemporaryFolder folder;
    const std::string program = "'" FERNLICHT_BINARY "'", pipe = folder / "pipe", out = folder / "out";
    const std::string until_there = "for i in $(seq 600); do [ -s '" + out + "' ] && break; sleep 0.05; done; ";
    const std::string first = "(0000000001.000000) can0 001#11", second = "(0000000002.000000) can0 002#22";
    for (const std::string tool : {"cut -", "merge -", "convert -"}) {
        const Outcome outcome = run_shell("( rm -f '" + pipe + "' '" + out + "'; mkfifo '" + pipe + "'; ( echo '" + first + "'; cat '" +
                                          pipe + "' ) | " + program + " can " + tool + " > '" + out + "' & " + until_there + "cat '" + out +
                                          "'; echo between; echo '" + second + "' > '" + pipe + "'; wait; cat '" + out + "' )");
        EXPECT_EQ(outcome.output, first + "\nbetween\n" + first + "\n" + second + "\n") << tool;
    }
    const Outcome outcome =
        run_shell("( rm -f '" + pipe + "'; mkfifo '" + pipe + "'; " + program + " can cut - < '" + pipe + "' & reader=$!; exec 3> '" +
                  pipe + "'; echo '" + first + "' >&3; sleep 1; while kill -INT $reader; do sleep 0.3; done; wait $reader; echo $? )");
    EXPECT_THAT(outcome.output, HasSubstr(first + "\n"));
}

TEST(CanTools, EndQuietlyWhenNobodyReads) {
    const TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 50'000; ++i)
        text += "(0000000001.000000) can0 001#1122334455667788\n";
    const std::string log = written(folder, "a.log", text);
    EXPECT_EQ(run_program("can cut " + log + " | head -n 1").output, "(0000000001.000000) can0 001#1122334455667788\n");
    EXPECT_EQ(run_program("can merge " + log + " | head -n 1", "trap '' PIPE; ").output, "(0000000001.000000) can0 001#1122334455667788\n");
    for (const std::string tool : {"cut", "convert"}) {
        const Outcome full = run_shell("( '" FERNLICHT_BINARY "' can " + tool + " " + log + " > /dev/full )");
        EXPECT_EQ(full.exit_code, 3) << tool;
        EXPECT_THAT(full.output, HasSubstr("standard output: cannot be written: No space left on device"));
    }
}

/// log2long prints as candump does on a screen; what it prints of our frames is read as these frames and written as it was.
TEST(CanUtils, Log2longPrintsWhatWeReadBack) {
    if (!is_installed("log2long"))
        GTEST_SKIP() << "log2long of can-utils is not installed";
    const TemporaryFolder folder;
    std::mt19937_64 random(5);
    std::string text;
    std::vector<CanFrame> frames;
    for (int i = 0; i < 5'000; ++i) {
        frames.push_back(random_frame(random));
        frames.back().raw_dlc = 0; // not in every version
        text += candump_line(frames.back()) + "\n";
    }
    const Outcome outcome = run_shell("log2long < " + written(folder, "a.log", text));
    ASSERT_EQ(outcome.exit_code, 0);
    std::istringstream lines(outcome.output);
    std::string line;
    for (CanFrame frame : frames) {
        ASSERT_TRUE(std::getline(lines, line));
        const CandumpLine read = parse_candump_line(line, {});
        frame.bit_rate_switch = frame.error_state_indicator = false; // not on its screen
        ASSERT_EQ(read.frame, frame) << line;
        CandumpStyle style;
        style.form = CandumpStyle::Form::screen;
        style.narrow = style.indented = style.ascii = true;
        ASSERT_EQ(candump_line(frame, style), line);
        ASSERT_EQ(candump_line(read.frame, read.style), line);
    }
    EXPECT_FALSE(std::getline(lines, line));
}

/// What log2asc and asc2log make of our log is read as the same frames.
TEST(CanUtils, Asc2logWritesWhatWeRead) {
    if (!is_installed("log2asc") || !is_installed("asc2log"))
        GTEST_SKIP() << "log2asc and asc2log of can-utils are not installed";
    const TemporaryFolder folder;
    std::mt19937_64 random(6);
    std::string text;
    std::vector<CanFrame> frames;
    while (frames.size() < 3'000) {
        CanFrame frame = random_frame(random);
        if (frame.error) // ASC files do not say what the error was
            continue;
        frame.raw_dlc = 0;
        frame.channel = "can0";
        frame.time_ns = static_cast<std::int64_t>(1'436'509'052 + frames.size()) * 1'000'000'000;
        frames.push_back(frame);
        text += candump_line(frame) + "\n";
    }
    const Outcome outcome = run_shell("log2asc -I " + written(folder, "a.log", text) + " can0 | asc2log -I /dev/stdin 2> /dev/null");
    std::istringstream lines(outcome.output);
    std::string line;
    for (const CanFrame& frame : frames) {
        do
            ASSERT_TRUE(std::getline(lines, line)) << outcome.output.substr(0, 500);
        while (!line.starts_with("("));
        CandumpLine read;
        ASSERT_NO_THROW(read = parse_candump_line(line, {}));
        read.frame.time_ns = frame.time_ns; // it starts at its own day
        ASSERT_EQ(read.frame, frame) << line;
    }
}

} // namespace
} // namespace fernlicht
