#include "runner/play/machine_load.h"

#include <gtest/gtest.h>
#include <tuple>
#include <unistd.h>

namespace fernlicht {
namespace {

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
    const OtherUse use = other_use(before, after, 7);
    EXPECT_DOUBLE_EQ(use.cores.value(), 0.5);
    EXPECT_EQ(use.busiest, "make");
    EXPECT_DOUBLE_EQ(use.busiest_cores, 0.3);
    after.machine_s.reset();
    EXPECT_FALSE(other_use(before, after, 7).cores);
    EXPECT_EQ(other_use(before, before, 7).busiest, "");
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
