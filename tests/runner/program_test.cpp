// The program's own command line, before any command's.
#include "tests/runner/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(ProgramCommandLine, AWordThatIsNoCommandIsNamed) {
    const Outcome misspelt = run_program("diference a.png b.png");
    EXPECT_EQ(misspelt.exit_code, 2);
    EXPECT_THAT(misspelt.output,
                ::testing::StartsWith("fernlicht: 'diference' is no command, expected one of run, live, study, bench, compare, "));
    EXPECT_EQ(run_program("").exit_code, 2);
    EXPECT_EQ(run_program("--version").exit_code, 0);
    EXPECT_EQ(run_program("run --help").exit_code, 0);
}

} // namespace
} // namespace fernlicht
