#include "runner/findings/run_context.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(RepeatCommand, LeavesOutFolderAndOthersAndQuotes) {
    const std::vector<std::string> call{"fernlicht", "run", "a.yaml", "my b.yaml", "--out", "today", "--frames=0:4", "--quiet"};
    EXPECT_EQ(repeat_command(call, {}, {"a.yaml"}), "fernlicht run 'my b.yaml' --frames=0:4 --quiet");
    EXPECT_EQ(repeat_command({}, {"--only", "x-1"}), "");
}

TEST(RepeatCommand, KeepsTheChoiceUnlessThereIsAnother) {
    const std::vector<std::string> call{"fernlicht", "study",     "s.yaml", "--only",           "x*",          "--out=o",
                                        "--resume",  "--history", "h.db",   "--fail-on-change", "--baselines", "b"};
    EXPECT_EQ(repeat_command(call), "fernlicht study s.yaml --only 'x*' --baselines b");
    EXPECT_EQ(repeat_command(call, {"--only", "x-1"}), "fernlicht study s.yaml --baselines b --only x-1");
}

} // namespace
} // namespace fernlicht
