#include "runner/experiments/improve/improve_result.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string improve_xenon = "improve " + library_file("lamps/xenon-low.ies") + " ";

TEST(ImproveCommand, ProposesALampAndProvesIt) {
    const TemporaryFolder folder;
    const std::string asked = improve_xenon + "--cells-of " + library_file("studies/standard.yaml") +
                              " --only 'straight*' --frames 30:40 --gain 'reach_5lx_target_own_right_edge_m by 5 m' --keep "
                              "glare_oncoming_facing_max_lx --regulation r149-c --out ";
    const std::string said = printed(asked + (folder / "out"));
    EXPECT_THAT(said, HasSubstr("All that was asked is met by `xenon-low-improved.ies`"));
    const json found = tests::checked(content_of(folder / "out/improve.json"), improve_members);
    EXPECT_TRUE(found.at("improved"));
    const json& reach = found.at("readings")[0];
    EXPECT_GE(reach.at("found").get<double>(), reach.at("before").get<double>() + 5.0);
    EXPECT_LE(reach.at("found").get<double>(), reach.at("before").get<double>() + 5.1);
    EXPECT_NEAR(reach.at("found"), reach.at("foretold"), 0.02);
    const json& glare = found.at("readings")[1];
    EXPECT_LE(glare.at("found").get<double>(), glare.at("before").get<double>());
    EXPECT_EQ(found.at("verdict_after"), "pass");
    EXPECT_GT(found.at("steps").size(), 1U);
    for (const char* name : {"report.html", "improve.svg", "beams.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + std::string(name)))) << name;
    // The same lamp every time, and other commands find of it what this one says.
    printed(asked + (folder / "again"));
    EXPECT_EQ(content_of(folder / "out/xenon-low-improved.ies"), content_of(folder / "again/xenon-low-improved.ies"));
    EXPECT_THAT(printed("lamp " + (folder / "out/xenon-low-improved.ies") + " --regulation r149-c"), HasSubstr("meets all 25 rows"));
    printed("importance " + library_file("drives/straight.yaml") + " --lamp " + (folder / "out/xenon-low-improved.ies") +
            " --frames 30:40 --trials 0 --reading reach_5lx_target_own_right_edge_m --out " + (folder / "read"));
    EXPECT_NEAR(json::parse(content_of(folder / "read/importance.json")).at("value").get<double>(), reach.at("found").get<double>(), 1e-9);
}

TEST(ImproveCommand, SaysWhatIsNotToBeHad) {
    const TemporaryFolder folder;
    const std::string said =
        printed(improve_xenon + "--drive " + library_file("drives/straight.yaml") +
                    " --frames 30:30 --gain 'reach_5lx_target_own_m by 20%' --max-change 10 --as csv --out " + (folder / "out"),
                1);
    EXPECT_THAT(said, HasSubstr("+9.10 m were asked, +"));
    EXPECT_THAT(said, HasSubstr("Most of all the most that a sample may change stands against it"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/xenon-low-improved.csv"));
}

TEST(ImproveCommand, RefusesWhatItCannotSeek) {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& flags) { return printed(improve_xenon + flags + " --out " + (folder / "a"), 2); };
    const std::string straight = "--drive " + library_file("drives/straight.yaml") + " --frames 30:30 ";
    EXPECT_THAT(refusal("--gain 'reach_5lx_target_own_m by 5 m'"), HasSubstr("neither --drive nor --cells-of"));
    EXPECT_THAT(refusal(straight), HasSubstr("at least one reading to be gained"));
    EXPECT_THAT(refusal(straight + "--gain reach_5lx_target_own_m"), HasSubstr("READING by AMOUNT"));
    EXPECT_THAT(refusal(straight + "--gain 'reach_5lx_target_own_m by 5 lx'"), HasSubstr("reach_5lx_target_own_m in m"));
    EXPECT_THAT(refusal(straight + "--gain 'brightness by 5'"), HasSubstr("fernlicht readings"));
    EXPECT_THAT(refusal(straight + "--gain 'patch_dark_own_m by 5'"), HasSubstr("--gain, straight-1: found 'patch_dark_own_m'"));
    EXPECT_THAT(refusal(straight + "--gain 'bend: reach_5lx_target_own_m by 5'"), HasSubstr("a drive among straight-1"));
    EXPECT_THAT(refusal(straight + "--gain 'reach_5lx_target_own_m by 5' --keep glare_oncoming_facing_max_lx"),
                HasSubstr("a drive with oncoming drivers"));
    EXPECT_THAT(refusal(straight + "--gain 'width_0.01lx_target_all_at_20m_m by 5'"), HasSubstr("only known to be beyond a bound"));
    EXPECT_THAT(refusal("--cells-of " + library_file("studies/aim-alone.yaml") + " --gain 'reach_5lx_target_own_m by 5'"),
                HasSubstr("has no cell with this lamp"));
    EXPECT_THAT(refusal(straight + "--gain 'reach_5lx_target_own_m by 5' --keep-row 'zone III'"),
                HasSubstr("--regulation, whose row it is"));
    EXPECT_THAT(refusal(straight + "--gain 'reach_5lx_target_own_m by 5' --regulation r98-d --keep-row 'zone 3'"),
                HasSubstr("--keep-row: found 'zone 3'"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

} // namespace
} // namespace fernlicht
