// The intake check through the program: of a lamp, and of the lamps of a run.
#include "scenarios/lamps/lamp_file.h"
#include "tests/runner/program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string checked_lamp(const std::string& flags, int exit_code = 0) {
    return printed("lamp " + library_file("lamps/xenon-low.ies") + " --check " + flags, exit_code);
}

TEST(LampCheckCommand, TellsFunctionCutOffAndVoltage) {
    const std::string text = checked_lamp("");
    EXPECT_THAT(text, HasSubstr("low (recognised)"));
    EXPECT_THAT(text, HasSubstr("degrees higher on the right"));
    EXPECT_THAT(text, HasSubstr("not stated: taken as 13.2 V"));
    EXPECT_THAT(text, HasSubstr("×0.90"));
    EXPECT_THAT(text, HasSubstr("No finding."));
    EXPECT_THAT(checked_lamp("--function low --voltage 12.8 --strict"), HasSubstr("low (stated)"));
    EXPECT_THAT(checked_lamp("--function other"), HasSubstr("Not checked"));
    EXPECT_THAT(text, testing::Not(HasSubstr("1 % down"))) << "it is in regulation aim";
}

/// Its cut-off at 0.46 D instead of 0.57 D.
TEST(LampCheckCommand, SaysHowFarACutOffLiesFromRegulationAim) {
    LampFile lamp = read_lamp(library_file("lamps/xenon-low.ies"));
    for (double& v : lamp.table.v_deg)
        v += 0.11;
    const TemporaryFolder folder;
    write_lamp(lamp, folder / "high.ies");
    EXPECT_THAT(printed("lamp " + (folder / "high.ies") + " --check"), HasSubstr("0.11 degrees above 1 % down"));
}

/// By name, wherever a lamp's file is asked for; a file of that name comes first.
TEST(LampCheckCommand, TakesShippedLampsByName) {
    const std::string by_file = printed("lamp " + library_file("lamps/led-low.ies"));
    for (const char* name : {"led-low", "led-low.ies", "fernlicht:lamps/led-low.ies"})
        EXPECT_EQ(printed(std::string("lamp ") + name), by_file);
    EXPECT_THAT(printed("lamp fernlicht:lamps/led-lo.ies", 2), HasSubstr("expected one as 'fernlicht:lamps/led-low.ies'"));
    EXPECT_THAT(printed("lamp fernlicht:lamps/zzzzzzzzzzzzzzzzzzzzz.ies", 2), HasSubstr("which is no shipped file, expected one in "));
    EXPECT_THAT(printed("lamp led-lo", 2), HasSubstr("led-lo: cannot be read"));
    EXPECT_THAT(printed("compare led-low xenon-low"), HasSubstr("against"));
}

TEST(LampCheckCommand, AFindingIsAnErrorWhereStrict) {
    EXPECT_THAT(checked_lamp("--mirror"), HasSubstr("left-hand traffic, or the table is mirrored"));
    EXPECT_THAT(checked_lamp("--mirror --left-hand-traffic"), HasSubstr("No finding."));
    const std::string refused = checked_lamp("--mirror --scale 10 --strict", 2);
    EXPECT_THAT(refused, HasSubstr("xenon-low.ies: --strict: its cut-off rises to the left"));
    EXPECT_THAT(refused, HasSubstr("; and it has 10")) << "all of them";
    EXPECT_LT(refused.find("finding  rise"), refused.find("--strict:")) << "and the table before: " << refused;
    EXPECT_LT(refused.find("finding  flux"), refused.find("--strict:"));
    const json found = json::parse(checked_lamp("--scale 10 --json"));
    ASSERT_EQ(found.at("findings").size(), 1u);
    EXPECT_EQ(found["findings"][0]["fault"], "flux");
    EXPECT_EQ(found["findings"][0]["meaningless"], true);
    EXPECT_EQ(found["measured_at_v"], nullptr);
    EXPECT_NEAR(found["cut_off_v_deg"].get<double>(), -0.57, 0.02);
}

TEST(LampCheckCommand, RefusesWhatItDoesNotDo) {
    for (const char* flags : {"--cut-off", "--regulation r98-d", "--spots 2", "--convert x.ies", "--picture x.png", "--function dim",
                              "--voltage 24", "--add x.ies"})
        checked_lamp(flags, 2);
    for (const char* flags : {"--strict", "--function low", "--voltage 12.8"})
        EXPECT_THAT(printed("lamp " + library_file("lamps/xenon-low.ies") + " " + flags, 2), HasSubstr("without --check"));
}

TEST(LampCheckCommand, ALowBeamThatIsStatedToBeAHighBeamIsSaidToBeOne) {
    EXPECT_THAT(checked_lamp("--function high"), HasSubstr("it is a low beam by its light"));
    const std::string against =
        printed("lamp " + library_file("lamps/xenon-high.ies") + " --against " + library_file("lamps/xenon-low.ies"));
    EXPECT_THAT(against,
                HasSubstr("difference     a high beam by its light, the other lamp a low beam: they do not stand for one another\n"));
    EXPECT_THAT(printed("lamp " + library_file("lamps/halogen-low.ies") + " --against " + library_file("lamps/xenon-low.ies")),
                testing::Not(HasSubstr("by its light")));
    const json told = json::parse(
        printed("lamp " + library_file("lamps/xenon-high.ies") + " --against " + library_file("lamps/xenon-low.ies") + " --json"));
    EXPECT_EQ(told.at("function"), "high");
    EXPECT_EQ(told.at("function_against"), "low");
}

/// A text grid of our own, one intensity all over, and its recipe.
TEST(LampCheckCommand, ComparesTextGridsByTheirRecipe) {
    const TemporaryFolder folder;
    std::ofstream(folder / "grid.txt") << "V;-1;1\n-1;500;500\n1;500;500\n";
    std::ofstream(folder / "ours.yaml") << "fernlicht_recipe: 1\nlayout: matrix\ndelimiter: semicolon\nunit: cd\n";
    const std::string two = "compare " + (folder / "grid.txt") + " " + (folder / "grid.txt");
    EXPECT_THAT(printed(two, 2), HasSubstr("is no lamp file that we know"));
    EXPECT_THAT(printed(two + " --recipe " + (folder / "ours.yaml")), HasSubstr("no difference beyond noise"));
}

class LampCheckOfARun : public testing::Test {
  protected:
    LampCheckOfARun() { // for the other side of the road
        printed("lamp " + library_file("lamps/halogen-low.ies") + " --mirror --convert " + mirrored_);
    }
    Outcome run(const std::string& flags) {
        return run_program("run " + library_file("drives/straight.yaml") + " --lamp " + mirrored_ +
                           " --quiet --no-accuracy --frames 0:1 --resolution 64x48 --out " + (folder_ / "out") + " " + flags);
    }
    TemporaryFolder folder_;
    std::string mirrored_ = folder_ / "other-side.ies";
};

TEST_F(LampCheckOfARun, AMeaninglessFileIsAWarningAndStandsOnThePage) {
    const Outcome outcome = run("");
    EXPECT_LE(outcome.exit_code, 1) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("fernlicht: lamp file other-side.ies ("));
    const json report = json::parse(content_of(folder_ / "out/report.json"));
    const json& files = report.at("lamp_files");
    ASSERT_EQ(files.size(), 1u) << "once, on both sides of both lamp sets, which are one: " << files.dump(2);
    EXPECT_EQ(files[0]["used_as"], json::array({"other-side: left", "other-side: right"}));
    EXPECT_EQ(files[0]["file"], "other-side.ies");
    EXPECT_EQ(files[0]["function"], "low");
    EXPECT_EQ(files[0]["findings"][0]["fault"], "rise");
    EXPECT_THAT(content_of(folder_ / "out/report.html"), HasSubstr("Lamp files"));
}

TEST_F(LampCheckOfARun, StrictRefusesItBeforeTheFirstFrame) {
    const Outcome outcome = run("--strict");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output,
                HasSubstr("other-side.ies: --strict: other-side.ies (other-side: left; other-side: right), rise: its cut-off "
                          "rises to the left"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(LampCheckOfARun, AHighBeamOnALowBeamsMountIsAWarningAndStrictTellsOfEveryFile) {
    const std::string high = library_file("lamps/xenon-high.ies"), on_the_left = "--lamp left=" + high + " --lamp right=" + mirrored_;
    const std::string start = "run " + library_file("drives/straight.yaml") +
                              " --quiet --no-accuracy --frames 0:1 --resolution 64x48 --out " + (folder_ / "high") + " ";
    EXPECT_THAT(
        run_program(start + "--lamp " + high).output,
        HasSubstr("fernlicht: lamp file xenon-high.ies (xenon-high: left; xenon-high: right), function: it is a high beam by its light "
                  "(no cut-off, and 100 % of its maximum straight ahead), on the mount of a low beam; readings with it are "
                  "meaningless"));
    std::filesystem::remove_all(folder_ / "high");
    const Outcome refused = run_program(start + on_the_left + " --strict");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output,
                testing::AllOf(HasSubstr("2 findings that make readings meaningless"), HasSubstr("function: it is a high beam"),
                               HasSubstr("rise: its cut-off rises to the left"), HasSubstr("without --strict")));
}

TEST_F(LampCheckOfARun, AnAimOnTheCommandLineTakesTheFindingAway) {
    const std::string start = "run " + library_file("drives/straight.yaml") + " --lamp " + (folder_ / "hh.ies") +
                              " --quiet --no-accuracy --frames 0:1 --resolution 64x48 --strict --out " + (folder_ / "hh");
    LampFile lamp = read_lamp(library_file("lamps/halogen-low.ies"));
    for (double& v : lamp.table.v_deg)
        v += 0.57;
    write_lamp(lamp, folder_ / "hh.ies");
    const Outcome refused = run_program(start);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr("expected a file without such findings, `aim: auto`, or the run without --strict"));
    EXPECT_EQ(run_program(start + " --aim auto").exit_code, 0);
    EXPECT_THAT(content_of(folder_ / "hh/straight-1.yaml"), HasSubstr("rule: auto"));
    EXPECT_THAT(printed(start + " --aim level", 2), HasSubstr("--aim: found 'level', expected as-is or auto"));
}

TEST_F(LampCheckOfARun, AStudyDoesTheSame) {
    const std::string file = folder_ / "two.yaml";
    std::ofstream(file) << "fernlicht_study: 1\nlamps:\n  ours: {low: " << library_file("lamps/halogen-low.ies")
                        << ", function: low}\n  theirs: {low: " << mirrored_ << "}\ndrives: [" << library_file("drives/straight.yaml")
                        << "]\npictured_moments: 1\nresolution_px: [64, 48]\n";
    const std::string study = "study " + file + " --frames 0:1 --quiet --no-accuracy --out " + (folder_ / "study");
    EXPECT_THAT(printed(study + " --strict", 2), HasSubstr("other-side.ies: --strict"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "study"));
    EXPECT_THAT(printed(study), HasSubstr("fernlicht: lamp file other-side.ies (theirs: left; theirs: right), rise: "));
    const json found = json::parse(content_of(folder_ / "study/study.json"));
    ASSERT_EQ(found.at("lamp_files").size(), 2u);
    EXPECT_EQ(found["lamp_files"][0]["function_stated"], true);
    EXPECT_TRUE(found["lamp_files"][0]["findings"].empty());
    EXPECT_THAT(content_of(folder_ / "study/report.html"), HasSubstr("Lamp files"));
}

TEST(LampFlags, LeaveTheFileThatFollowsToTheCommand) {
    const TemporaryFolder folder;
    printed("lamp --picture '" + folder / "beam.svg" + "' --window -10 10 -5 5 " + library_file("lamps/led-low.ies"));
    EXPECT_TRUE(std::filesystem::exists(folder / "beam.svg"));
}

} // namespace
} // namespace fernlicht
