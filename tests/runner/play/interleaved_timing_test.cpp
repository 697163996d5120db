#include "metrics/statistics/statistics.h"
#include "runner/play/interleaved_timing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tuple>
#include <unistd.h>

namespace fernlicht {
namespace {

/// A device that draws when it is waited for, on a clock of its own: submitting costs a second, drawing what the technique says.
struct Machine {
    double now_s = 0.0, cpu_s = 0.0, queued_s = 0.0, gpu_s = 0.0;
    std::vector<std::string> calls;

    TimedTechnique timed(const std::string& name, double frame_s) {
        return {[this, name, frame_s](std::size_t moment) {
                    calls.push_back(fmt::format("{}{}", name, moment));
                    now_s += 1.0;
                    cpu_s += 1.0;
                    queued_s += frame_s;
                },
                [this] {
                    calls.emplace_back("finish");
                    now_s += queued_s;
                    cpu_s += 0.5 * queued_s;
                    queued_s = 0.0;
                }};
    }
    TimingClocks clocks() {
        TimingClocks c;
        c.wall_s = [this] { return now_s; };
        c.cpu_s = [this] { return cpu_s; };
        return c;
    }
};

TimingOptions small(std::size_t moments, std::size_t rounds) {
    TimingOptions options;
    options.moments = moments;
    options.rounds = rounds;
    options.warm_up_plays = 1;
    return options;
}

TEST(InterleavedTimes, TimesFramesBackToBackAndOneByOne) {
    Machine machine;
    const InterleavedTimes timing = time_interleaved({machine.timed("a", 8.0), machine.timed("b", 2.0)}, small(4, 2), machine.clocks());
    ASSERT_EQ(timing.samples.size(), 2U);
    EXPECT_EQ(timing.samples[0].frame_s, (std::vector<double>{9.0, 9.0})); // (4 * 1 + 4 * 8) / 4
    EXPECT_EQ(timing.samples[0].cpu_s, (std::vector<double>{5.0, 5.0}));
    EXPECT_EQ(timing.samples[0].latency_s, std::vector<double>(8, 9.0));
    EXPECT_EQ(timing.samples[1].frame_s, (std::vector<double>{3.0, 3.0}));
    EXPECT_TRUE(timing.samples[0].gpu_s.empty());
}

TEST(InterleavedTimes, WarmsAllUpFirstThenFinishesOnceBackToBackAndAfterEachFrame) {
    Machine machine;
    const InterleavedTimes timing = time_interleaved({machine.timed("a", 1.0), machine.timed("b", 1.0)}, small(2, 1), machine.clocks());
    std::vector<std::string> expected{"a0", "a1", "finish", "b0", "b1", "finish"};
    for (const std::size_t i : timing.orders.at(0))
        for (const char* call : {"{}0", "{}1", "finish", "{}0", "finish", "{}1", "finish"})
            expected.push_back(fmt::format(fmt::runtime(call), "ab"[i]));
    EXPECT_EQ(machine.calls, expected);
}

TEST(InterleavedTimes, EachRoundHasTheSeedsNextOrder) {
    Machine machine;
    std::vector<TimedTechnique> timed_techniques;
    for (const char* name : {"a", "b", "c", "d", "e", "f", "g", "h"})
        timed_techniques.push_back(machine.timed(name, 1.0));
    TimingOptions options = small(1, 3);
    const InterleavedTimes timing = time_interleaved(timed_techniques, options, machine.clocks());
    std::mt19937_64 chance(1);
    ASSERT_EQ(timing.orders.size(), 3U);
    for (const auto& order : timing.orders)
        EXPECT_EQ(order, random_order(8, chance));
    const std::size_t first_turn = 16; // after 8 warm-ups of a draw and a finish; a turn has two of each
    for (std::size_t k = 0; k < 8; ++k)
        EXPECT_EQ(machine.calls[first_turn + 4 * k], fmt::format("{}0", "abcdefgh"[timing.orders[0][k]]));
    options.seed = 2;
    EXPECT_NE(time_interleaved(timed_techniques, options, machine.clocks()).orders, timing.orders);
}

TEST(InterleavedTimes, ReadsTheGpusClockRoundEachFrame) {
    Machine machine;
    TimingClocks clocks = machine.clocks();
    double began_s = 0.0;
    clocks.gpu_begin = [&] { began_s = machine.now_s; };
    clocks.gpu_end = [&] { machine.gpu_s += 3.0 * (machine.now_s - began_s); };
    clocks.gpu_s = [&] { return std::exchange(machine.gpu_s, 0.0); };
    const InterleavedTimes timing = time_interleaved({machine.timed("a", 8.0)}, small(4, 2), clocks);
    EXPECT_EQ(timing.samples[0].gpu_s, (std::vector<double>{3.0, 3.0}));
}

TEST(InterleavedTimes, StopsBetweenRounds) {
    Machine machine;
    TimingOptions options = small(2, 10);
    options.go_on = [](std::size_t done) { return done < 3; };
    const InterleavedTimes timing = time_interleaved({machine.timed("a", 1.0), machine.timed("b", 1.0)}, options, machine.clocks());
    EXPECT_EQ(timing.orders.size(), 3U);
    for (const TimingSamples& samples : timing.samples)
        EXPECT_EQ(samples.frame_s.size(), 3U);
}

TEST(MachineLoad, ReadsWorkAndProcessesWhateverTheirNames) {
    EXPECT_EQ(machine_ticks("cpu  1 20 300 4000 50000 600000 7000000 80000000 9 9"), 87600321.0);
    EXPECT_FALSE(machine_ticks("cpu0 1 2 3 4 5 6 7 8"));
    EXPECT_FALSE(machine_ticks("cpu  1 2 3"));
    EXPECT_FALSE(machine_ticks(""));
    const auto process = process_ticks("77 (a) b (c) S 1 77 77 0 -1 4194304 102 0 0 0 250 31 0 0 20 0 1");
    ASSERT_TRUE(process);
    EXPECT_EQ(std::tuple(process->first, process->second), std::tuple("a) b (c", 281.0));
    EXPECT_FALSE(process_ticks(""));
    EXPECT_FALSE(process_ticks("77 (a) S 1 2"));
}

TEST(MachineLoad, OthersAreWhatTheMachineUsedBeyondUs) {
    CpuUse before, after;
    before.machine_s = 1000.0;
    before.processes = {{1, {"init", 5.0}}, {7, {"us", 0.0}}, {8, {"make", 2.0}}};
    after = before;
    after.wall_s = 10.0;
    after.own_s = 12.0;
    after.machine_s = 1017.0;
    after.processes[7].second = 12.0;
    after.processes[8].second = 5.0;
    after.processes[9] = {"cc1plus", 1.5}; // began meanwhile
    const OtherLoad use = other_load(before, after, 7);
    EXPECT_DOUBLE_EQ(use.cores.value(), 0.5);
    EXPECT_EQ(use.busiest, "make");
    EXPECT_DOUBLE_EQ(use.busiest_cores, 0.3);
    after.machine_s.reset();
    EXPECT_FALSE(other_load(before, after, 7).cores);
    EXPECT_EQ(other_load(before, before, 7).busiest, "");
}

TEST(MachineLoad, OurOwnWorkIsSeenAndNotAnothers) {
    const CpuUse before = cpu_use();
    ASSERT_TRUE(before.machine_s);
    ASSERT_TRUE(before.load_average);
    EXPECT_TRUE(before.processes.contains(::getpid()));
    double sum = 0.0;
    while (own_cpu_s() < before.own_s + 0.3)
        sum += 1.0;
    EXPECT_GT(sum, 0.0);
    const CpuUse after = cpu_use();
    EXPECT_GE(after.own_s - before.own_s, 0.3);
    EXPECT_GE(*after.machine_s - *before.machine_s, 0.25); // in ticks of a hundredth, on each core
}

} // namespace

} // namespace fernlicht
