// `fernlicht new`: what it writes is sound, and plays as it stands.
#include "tests/runner/program.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

constexpr const char* shortly = " --frames 0:0 --no-accuracy --backend software";

TEST(New, WritesFilesThatPlayAsTheyStand) {
    const TemporaryFolder folder;
    const auto here = [&](const std::string& arguments) {
        const Outcome run = run_shell("cd " + folder.path().string() + " && '" FERNLICHT_BINARY "' " + arguments);
        EXPECT_EQ(run.exit_code, 0) << arguments << '\n' << run.output;
        return run.output;
    };
    EXPECT_THAT(here("new drive"), HasSubstr("fernlicht run drive.yaml"));
    EXPECT_THAT(here("new study nights"), HasSubstr("fernlicht study nights.yaml"));
    EXPECT_THAT(here("new lamp"), HasSubstr("run first-light --lamp lamp.csv"));
    EXPECT_THAT(here("new lamp mine.ies"), HasSubstr("lamp mine.ies --regulation r149-c"));
    here("new lamp --kind pixels matrix");
    EXPECT_THAT(here("check --fail-on-warning drive.yaml nights.yaml lamp.csv mine.ies matrix.yaml"),
                HasSubstr("5 files, 0 errors, 0 warnings"));
    here(std::string("run drive.yaml --resolution 64x48 --out drive") + shortly);
    here(std::string("study nights.yaml --out nights --store store") + shortly);
    for (const char* const lamp : {"lamp.csv", "mine.ies", "high=matrix.yaml"})
        here(std::string("run first-light --resolution 64x48 --lamp ") + lamp + " --out " + lamp + "-run" + shortly);
    for (const char* const lamp : {"lamp.csv", "mine.ies"})
        EXPECT_THAT(here(std::string("lamp --regulation r149-c ") + lamp), HasSubstr("75R")) << "it keeps the table of its class";
}

TEST(New, ReplacesNothing) {
    const TemporaryFolder folder;
    const std::string file = folder / "mine.yaml";
    std::ofstream(file) << "precious";
    EXPECT_THAT(printed("new drive " + file, 2), HasSubstr("is there already, expected a new file, or --force"));
    EXPECT_EQ(content_of(file), "precious");
    printed("new drive --force " + file);
    EXPECT_THAT(content_of(file), HasSubstr("fernlicht: 1"));
    EXPECT_THAT(printed("new drive " + (folder / "mine.ies"), 2), HasSubstr("ends in .yaml"));
    EXPECT_THAT(printed("new lamp " + (folder / "mine.exr"), 2), HasSubstr(".csv, .ies, .yaml"));
    EXPECT_THAT(printed("new lamp --kind laser " + (folder / "l"), 2), HasSubstr("table, ies, pixels"));
    EXPECT_THAT(printed("new lamp --kind ies " + (folder / "l.csv"), 2), HasSubstr("ends in .ies"));
    EXPECT_THAT(printed("new study " + (folder / "none/s"), 2), HasSubstr("there is no folder"));
    EXPECT_THAT(printed("new car", 2), HasSubstr("lamp, drive, study"));
}

} // namespace
} // namespace fernlicht
