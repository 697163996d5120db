#include "runner/workers/worker_pool.h"

#include "tests/runner/program.h"

#include <algorithm>
#include <chrono>
#include <gmock/gmock.h>
#include <map>
#include <thread>

namespace fernlicht {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

struct WorkerPoolTest : testing::Test {
    TemporaryFolder folder;
    std::map<std::size_t, WorkerEnd> ends;
    WorkerPool pool{2, {60.0, 0}};

    void run(const std::vector<std::string>& scripts) {
        run_workers(
            scripts.size(), pool,
            [&](std::size_t i) {
                return WorkerCommand{{"sh", "-c", scripts[i]}, "/bin/sh", {"GIVEN=yes"}, folder / (std::to_string(i) + ".log")};
            },
            [&](std::size_t i, const WorkerEnd& end) { ends[i] = end; });
    }
    std::string log(int i) const { return content_of(folder / (std::to_string(i) + ".log")); }
    std::string text(std::size_t i) const { return ending_text(ends.at(i), pool.limits); }
};

TEST_F(WorkerPoolTest, TellsHowEachEndedAndTheOthersGoOn) {
    run({"echo $GIVEN; echo said >&2", "exit 3", "kill -SEGV $$", "kill -9 $$", "echo last"});
    ASSERT_EQ(ends.size(), 5U);
    EXPECT_EQ(log(0), "yes\nsaid\n");
    EXPECT_EQ(text(1), "ended with exit code 3");
    EXPECT_EQ(text(2), "was killed by SIGSEGV");
    EXPECT_EQ(text(3), "was killed by SIGKILL");
    EXPECT_EQ(ends.at(4).code, 0);
    EXPECT_EQ(log(4), "last\n");
    EXPECT_EQ(ends.at(0).said, "said");
    EXPECT_EQ(ends.at(1).said, "");
}

/// As on a disk that is full.
TEST_F(WorkerPoolTest, WhatItSaidIsKnownWhereItsLogCannotBeWritten) {
    std::filesystem::create_directory(folder / "0.log");
    run({"echo before; echo no space left >&2; exit 3"});
    EXPECT_EQ(ends.at(0).said, "no space left");
    EXPECT_EQ(ends.at(0).code, 3);
}

TEST_F(WorkerPoolTest, OneThatHangsIsStoppedWithAllThatItStarted) {
    pool.limits.time_s = 0.3;
    run({"sleep 1000 & echo $!; trap '' TERM; while :; do sleep 1; done", "echo quick"});
    EXPECT_THAT(text(0), testing::MatchesRegex("was stopped after [56] s; its limit is 0.3 s"));
    EXPECT_EQ(ends.at(1).code, 0);
    const ::pid_t child = std::stoi(log(0));
    for (int wait = 0; wait < 200 && ::kill(child, 0) == 0; ++wait)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    // Its child may be left as a zombie until whoever is its parent now asks for it.
    EXPECT_THAT(content_of("/proc/" + std::to_string(child) + "/stat"), AnyOf("", HasSubstr(") Z ")));
}

/// Not a test: what takes memory in the test below.
TEST(WorkerPoolMemory, DISABLED_Takes300MiB) {
    std::vector<char> taken(std::size_t{300} << 20, 1);
    std::printf("took %zu\n", taken.size() + static_cast<std::size_t>(taken[12345]));
}

TEST_F(WorkerPoolTest, OneThatTakesTooMuchMemoryFailsAlone) {
    pool.limits.memory_mib = 200;
    const std::string taker = "env -u GTEST_TOTAL_SHARDS -u GTEST_SHARD_INDEX " + std::filesystem::read_symlink("/proc/self/exe").string() +
                              " --gtest_also_run_disabled_tests --gtest_filter=WorkerPoolMemory.DISABLED_Takes300MiB";
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "AddressSanitizer needs more than any limit";
#endif
    run({taker, "echo beside"});
    EXPECT_NE(ends.at(0).code, 0) << log(0);
    EXPECT_THAT(log(0), HasSubstr("bad_alloc"));
    EXPECT_EQ(log(1), "beside\n");
    ends.clear();
    pool.limits.memory_mib = 2000;
    run({taker});
    EXPECT_EQ(ends.at(0).code, 0) << log(0);
    EXPECT_GT(ends.at(0).peak_memory_mib, 300.0);
}

TEST_F(WorkerPoolTest, StartsNoneAndEndsAllWhenItIsToStop) {
    const auto began = std::chrono::steady_clock::now();
    pool.go_on = [&] { return std::chrono::steady_clock::now() - began < std::chrono::milliseconds(300); };
    run({"sleep 1000", "sleep 1000", "echo never"});
    ASSERT_EQ(ends.size(), 2U);
    EXPECT_EQ(text(0), "was interrupted");
}

TEST_F(WorkerPoolTest, RunsAsManyAtATimeAsItMay) {
    std::vector<std::string> scripts(6, "date +%s%N; sleep 0.4; date +%s%N");
    run(scripts);
    std::vector<std::pair<long long, int>> steps;
    for (int i = 0; i < 6; ++i) {
        long long from = 0, to = 0;
        std::istringstream(log(i)) >> from >> to;
        steps.insert(steps.end(), {{from, 1}, {to, -1}});
    }
    std::ranges::sort(steps);
    int running = 0, most = 0;
    for (const auto& [when, step] : steps)
        most = std::max(most, running += step);
    EXPECT_EQ(most, 2);
}

TEST_F(WorkerPoolTest, AProgramThatIsNotThere) {
    run_workers(
        1, pool,
        [&](std::size_t) {
            return WorkerCommand{{"/nonexistent/program"}, {}, {}, folder / "0.log"};
        },
        [&](std::size_t i, const WorkerEnd& end) { ends[i] = end; });
    EXPECT_EQ(ends.at(0).code, 126);
    EXPECT_THAT(log(0), StartsWith("this program cannot be started"));
}

} // namespace
} // namespace fernlicht
