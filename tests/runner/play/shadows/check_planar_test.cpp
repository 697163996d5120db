// `shadows: planar` where the ground is no plane: refused before anything is drawn, by drive and line.
#include "tests/runner/experiments/shadows/short_drive.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::ContainsRegex, testing::HasSubstr, testing::Not;

constexpr const char* small_and_quiet = " --quiet --resolution 96x72 --no-accuracy --out ";

class CheckPlanar : public testing::Test {
  protected:
    TemporaryFolder folder_;
};

TEST_F(CheckPlanar, AllDrivesAreAskedBeforeTheFirstIsPlayed) {
    const std::string level = short_drive(folder_, "straight", "none"), hilly = short_drive(folder_, "first-light", "{method: planar}");
    const Outcome run = run_program("run " + level + " " + hilly + small_and_quiet + (folder_ / "out"));
    EXPECT_EQ(run.exit_code, 2) << run.output;
    const std::string text = content_of(hilly);
    const auto line = std::count(text.begin(), text.end(), '\n'); // the file's last
    EXPECT_THAT(run.output,
                HasSubstr(hilly + ":" + std::to_string(line) + ":19: shadows: found 'planar' and ground that is not one plane"));
    EXPECT_THAT(run.output, ContainsRegex("lies [0-9.]+ cm (above|below) it; choose another method \\(after 0[.][0-9]+ s, lamp set '"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
}

TEST_F(CheckPlanar, TheFlagIsNamedWhereItAsked) {
    const std::string hilly = short_drive(folder_, "first-light", "none");
    const Outcome run = run_program("run " + hilly + " --shadows planar" + small_and_quiet + (folder_ / "out"));
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_THAT(run.output, HasSubstr(hilly + ": --shadows: found 'planar' and ground that is not one plane"));
    EXPECT_THAT(run.output, Not(HasSubstr("shadows: shadows:")));
}

TEST_F(CheckPlanar, OtherProgramsNameDriveAndLineToo) {
    const std::string hilly = short_drive(folder_, "first-light", "planar");
    for (const std::string command : {"accuracy --moments 1 --techniques photometric", "bench --count 1 --techniques photometric",
                                      "aliasing --moment 0.2 --techniques photometric"}) {
        const Outcome run = run_program(command + " " + hilly + " --quiet --out " + (folder_ / "out"));
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_THAT(run.output, ContainsRegex("first-light[.]yaml:[0-9]+:10: shadows: found 'planar'")) << command;
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out")) << command;
    }
}

// Wide of tolerance, the level road passes, and is drawn.
TEST_F(CheckPlanar, GroundWithinTheToleranceIsPlayed) {
    const std::string level = short_drive(folder_, "worked-example", "{method: planar, tolerance_m: 1}");
    const Outcome run = run_program("run " + level + small_and_quiet + (folder_ / "out"));
    EXPECT_LE(run.exit_code, 1) << run.output;
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out/report.json"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/INCOMPLETE"));
}

} // namespace
} // namespace fernlicht
