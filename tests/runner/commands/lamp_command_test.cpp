#include "runner/commands/lamp_command.h"

#include "scenarios/lamps/lamp_model.h"
#include "scenarios/lamps/spots/spot_fit.h"
#include "tests/runner/program.h"
#include "tests/trial.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::HasSubstr;

class LampCommand : public testing::Test {
  protected:
    static LampRequest shipped(const std::string& name) {
        LampRequest request;
        request.file = library_file("lamps/" + name + ".ies");
        return request;
    }
    std::string printed(const LampRequest& request) {
        testing::internal::CaptureStdout();
        const int code = lamp_command(request);
        std::fflush(stdout);
        std::string text = testing::internal::GetCapturedStdout();
        EXPECT_EQ(code, 0);
        return text;
    }
    static std::string refusal(const LampRequest& request) {
        return tests::refusal_of([&] { lamp_command(request); });
    }
    TemporaryFolder folder_;
};

TEST_F(LampCommand, TellsAShippedLamp) {
    const std::string text = printed(shipped("halogen-low"));
    EXPECT_THAT(text, HasSubstr("halogen low beam (model)"));
    EXPECT_THAT(text, HasSubstr("lx at 25 m, at H 1.5"));
    EXPECT_THAT(text, HasSubstr("a model, not a measurement"));
}

TEST_F(LampCommand, FitsSpotLightsWhereAsked) {
    LampRequest request = shipped("xenon-low");
    request.spots = 2;
    const std::string text = printed(request);
    EXPECT_THAT(text, HasSubstr("2 fitted; they leave over "));
    EXPECT_THAT(text, HasSubstr("exponent 128, cut-off "));
    request.json = true;
    const auto json = nlohmann::json::parse(printed(request));
    const SpotFit fit = fit_spots(lamp_of(request).table, 2);
    ASSERT_EQ(json["spot_fit"]["spots"].size(), 2u);
    EXPECT_EQ(json["spot_fit"]["relative_l2"], fit.relative_l2);
    EXPECT_EQ(json["spot_fit"]["spots"][1]["cutoff_deg"], fit.spots[1].cutoff_deg);
    request.spots.reset();
    EXPECT_FALSE(nlohmann::json::parse(printed(request)).contains("spot_fit"));
    for (const int count : {-1, 0, 9}) {
        request.spots = count;
        EXPECT_THAT(refusal(request), HasSubstr("--spots"));
    }
}

TEST_F(LampCommand, JsonHasTheFiguresOfTheTable) {
    LampRequest request = shipped("xenon-low");
    request.json = true;
    const auto j = nlohmann::json::parse(printed(request));
    const LampFile lamp = read_lamp(request.file);
    EXPECT_DOUBLE_EQ(j["peak"]["cd"].get<double>(), peak_of(lamp.table).cd);
    EXPECT_DOUBLE_EQ(j["flux_lm"].get<double>(), flux_lm(lamp.table));
    EXPECT_GT(j["interpolation_error"]["samples"].get<int>(), 1000);
}

TEST_F(LampCommand, ModelsConvertToTheShippedFiles) {
    for (const LampModel& model : lamp_models()) {
        LampRequest request;
        request.model = model.name;
        request.convert = folder_ / (model.name + ".ies");
        printed(request);
        EXPECT_TRUE(content_of(request.convert) == content_of(shipped(model.name).file)) << model.name;
    }
}

TEST_F(LampCommand, ScaleMirrorAddAndSubtractComeInThisOrder) {
    LampRequest request = shipped("halogen-low");
    const LampFile plain = lamp_of(request), high = lamp_of(shipped("halogen-high"));
    request.scale = 0.5;
    request.mirror = true;
    request.add = {shipped("halogen-high").file};
    LampFile changed = lamp_of(request);
    for (const double h : {-9.0, -2.5, 0.0, 1.3, 17.0})
        for (const double v : {-5.0, -0.86, -0.57, 0.0, 2.0})
            EXPECT_NEAR(intensity_cd(changed.table, h, v), 0.5 * intensity_cd(plain.table, -h, v) + intensity_cd(high.table, h, v), 1e-6)
                << h << " " << v;
    EXPECT_EQ(changed.opened.size(), 2u);
    request.subtract = {shipped("halogen-high").file};
    changed = lamp_of(request);
    EXPECT_NEAR(intensity_cd(changed.table, -1.3, -1.0), 0.5 * intensity_cd(plain.table, 1.3, -1.0), 1e-6);
    EXPECT_THAT(changed.notes.back(), HasSubstr("would be negative"));
}

TEST_F(LampCommand, WhatWasChangedIsSaidInTheFileWritten) {
    for (const char* name : {"changed.ies", "changed.csv"}) {
        LampRequest request = shipped("halogen-low");
        request.scale = 1.05;
        request.mirror = true;
        request.add = {shipped("halogen-high").file};
        request.convert = folder_ / name;
        printed(request);
        LampRequest again;
        again.file = request.convert;
        const LampFile lamp = lamp_of(again);
        ASSERT_FALSE(lamp.labels.empty());
        std::size_t said = 0;
        for (const auto& [key, value] : lamp.labels)
            said += key == "OTHER" && value ==
                                          "changed, other texts are of the lamp before: scaled by 1.05; mirrored, left and right traffic "
                                          "exchanged; added halogen high beam (model)";
        EXPECT_EQ(said, 1U) << content_of(request.convert).substr(0, 1500);
    }
}

TEST_F(LampCommand, SubtractedFromItselfALampIsDarkAndStillPrintsAndPictures) {
    LampRequest request = shipped("halogen-low");
    request.subtract = {request.file};
    request.picture = folder_ / "dark.svg";
    EXPECT_THAT(printed(request), HasSubstr("no light in any direction"));
    EXPECT_THAT(content_of(request.picture), HasSubstr("no light in any direction"));
}

TEST_F(LampCommand, PicturesAreWrittenAsTheirNamesSay) {
    LampRequest request = shipped("xenon-low");
    request.picture = folder_ / "lamp.png";
    request.window = {-12, 14, -6, 4};
    printed(request);
    EXPECT_EQ(content_of(request.picture).substr(1, 3), "PNG");
    request.picture = folder_ / "lamp.svg";
    printed(request);
    const std::string once = content_of(request.picture);
    EXPECT_THAT(once, HasSubstr("20 lx"));
    request.force = true;
    printed(request);
    EXPECT_TRUE(content_of(request.picture) == once);
}

TEST_F(LampCommand, WhatCannotBeDoneIsRefusedInOneSentence) {
    EXPECT_THAT(refusal({}), HasSubstr("found no lamp"));
    LampRequest request = shipped("halogen-low");
    request.model = "xenon-low";
    EXPECT_THAT(refusal(request), HasSubstr("found both"));
    request.file.clear();
    request.model = "xenon";
    EXPECT_THAT(refusal(request), HasSubstr("halogen-low, halogen-high, xenon-low, xenon-high"));
    request = shipped("halogen-low");
    request.picture = folder_ / "lamp.gif";
    EXPECT_THAT(refusal(request), HasSubstr(".svg or .png"));
    request = shipped("halogen-low");
    request.scale = -1.0;
    EXPECT_THAT(refusal(request), HasSubstr("--scale: found -1"));
    request.scale = 0.0;
    EXPECT_THAT(refusal(request), HasSubstr("--scale: found 0, expected a number above 0"));
    request = shipped("halogen-low");
    request.picture = folder_ / "lamp.svg";
    request.window = {5, -5, -3, 3};
    EXPECT_THAT(refusal(request), HasSubstr("--window"));
    EXPECT_FALSE(std::filesystem::exists(request.picture));
    request = shipped("halogen-low");
    request.convert = folder_ / "lamp.xyz";
    EXPECT_THAT(refusal(request), HasSubstr("lamp.xyz"));
    EXPECT_THAT(refusal(shipped("missing")), HasSubstr("missing.ies"));
}

TEST_F(LampCommand, AFileThatIsReadIsNeverOverwritten) {
    const std::filesystem::path copy = folder_ / "copy.ies";
    std::filesystem::copy_file(shipped("halogen-low").file, copy);
    const std::string before = content_of(copy);
    LampRequest request = shipped("halogen-low");
    request.add = {copy};
    request.convert = folder_ / "./copy.ies";
    EXPECT_THAT(refusal(request), HasSubstr("found a file that is read"));
    EXPECT_TRUE(content_of(copy) == before);
}

TEST_F(LampCommand, AFileThatIsThereIsReplacedByForceAlone) {
    const std::filesystem::path there = folder_ / "there.ies";
    std::ofstream(there) << "somebody's work";
    LampRequest request = shipped("halogen-low");
    request.convert = there;
    EXPECT_THAT(refusal(request), HasSubstr("--convert: found a file of that name, expected another name to write to, or --force"));
    std::filesystem::rename(there, folder_ / "there.svg");
    request.convert.clear();
    request.picture = folder_ / "there.svg";
    EXPECT_THAT(refusal(request), HasSubstr("--picture: found a file of that name"));
    EXPECT_EQ(content_of(request.picture), "somebody's work");
    request.force = true;
    printed(request);
    EXPECT_THAT(content_of(request.picture), HasSubstr("<svg"));
}

TEST_F(LampCommand, TellsWhatDiffersFromAnotherLamp) {
    LampRequest request = shipped("halogen-low");
    request.against = request.file;
    EXPECT_THAT(printed(request), HasSubstr("no difference beyond noise"));
    request.json = true;
    EXPECT_EQ(nlohmann::json::parse(printed(request)).at("differs"), false);
    request.scale = 0.97;
    request.picture = folder_ / "difference.svg";
    const nlohmann::json told = nlohmann::json::parse(printed(request));
    EXPECT_NEAR(told.at("level_share").at("value").get<double>(), -0.03, 1e-4);
    EXPECT_EQ(told.at("zones").size(), 0U);
    EXPECT_THAT(content_of(request.picture), HasSubstr("dimmer all over"));
    request.spots = 3;
    request.force = true;
    EXPECT_THAT(refusal(request), HasSubstr("--against: found --spots or --convert beside it"));
}

TEST_F(LampCommand, RefusesToCompareWithDarkness) {
    LampRequest request = shipped("halogen-low");
    request.against = request.file;
    request.subtract = {request.file};
    EXPECT_THAT(refusal(request), HasSubstr("found no light in it"));
}

TEST_F(LampCommand, JudgesAnAdaptiveBeamForOneVehicleAndSaysWhatItAssumes) {
    LampRequest request;
    request.file = library_file("lamps/pixels-16384.yaml");
    request.add = {library_file("lamps/led-low.ies")};
    request.regulation = "fmvss108-adb";
    EXPECT_THAT(refusal(request), HasSubstr("--other or --dimmed"));
    request.adaptive.other_m = {60.0, 3.5};
    const std::string text = printed(request); // passes
    EXPECT_THAT(text, HasSubstr("modelled on FMVSS 108 S9.4.1.6.4.3 to 5"));
    EXPECT_THAT(text, HasSubstr("assumed: pixels are dark for what is 1.8 m wide and 1.5 m high 60 m ahead"));
    EXPECT_THAT(text, HasSubstr("dimmed 0.5U, 1.5L to L"));
    request.adaptive.tables = {"fmvss108-ub2", "fmvss108-lb2v-vol"};
    EXPECT_THAT(refusal(request), HasSubstr("--adb-tables: found"));
    request.adaptive.tables = {"fmvss108-lb2v-vol", "fmvss108-ub2"};
    request.adaptive.other_m = {60.0, 100.0};
    EXPECT_THAT(refusal(request), HasSubstr("no pixel lights a place"));
    request.file = library_file("lamps/led-high.ies");
    request.adaptive.other_m = {60.0, 3.5};
    EXPECT_THAT(refusal(request), HasSubstr("none of whose parts dims"));
    request.adaptive = {.dimmed_deg = {-4.0, -5.0, -1.0, 1.0}};
    EXPECT_THAT(refusal(request), HasSubstr("--dimmed"));
    request.adaptive = {.dimmed_deg = {-5.0, -4.0, -1.0, 1.0}};
    request.regulation = "fmvss108-ub2";
    EXPECT_THAT(refusal(request), HasSubstr("fmvss108-adb"));
    request.regulation.clear();
    EXPECT_THAT(refusal(request), HasSubstr("--dimmed"));
}

TEST_F(LampCommand, NamesTheFlagOfAnAdaptiveBeamThatIsWrong) {
    LampRequest request;
    request.file = library_file("lamps/matrix-84.yaml");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const char* const table : {"fmvss108-adb", "r149-adb-oncoming-50m"}) {
        request.regulation = table;
        const auto told = [&](const AdaptiveRequest& asked) {
            request.adaptive = asked;
            return refusal(request);
        };
        EXPECT_THAT(told({.other_m = {50.0, 3.5}, .other_size_m = {0.0, 1.5}}), testing::StartsWith("--other-size: found 0 1.5"));
        EXPECT_THAT(told({.other_m = {50.0, 3.5}, .lamp_at_m = {0.5, -1.0}}), testing::StartsWith("--lamp-at: found 0.5 -1"));
        EXPECT_THAT(told({.other_m = {50.0, 3.5}, .margin_deg = -0.1}), testing::StartsWith("--margin: found -0.1, expected degrees"));
        EXPECT_THAT(told({.other_m = {50.0, 3.5}, .margin_deg = nan}), testing::StartsWith("--margin: found nan"));
        EXPECT_THAT(told({.other_m = {-50.0, 3.5}}), testing::StartsWith("--other: found -50 3.5"));
        EXPECT_THAT(told({.margin_deg = 2.0}), testing::StartsWith("--margin: found without --other"));
        EXPECT_THAT(told({.dimmed_deg = {-5.0, -1.0, -1.0, 2.0}, .lamp_at_m = {0.5, 0.7}}),
                    testing::StartsWith("--lamp-at: found without --other"));
    }
    request.adaptive = {.dimmed_deg = {-5.0, -1.0, -1.0, 2.0}};
    EXPECT_THAT(refusal(request),
                testing::StartsWith("--dimmed: found with --regulation r149-adb-oncoming-50m, expected --other AHEAD LEFT"));
    request.adaptive = {.other_m = {50.0, 3.5}};
    request.regulation = "r149-c";
    EXPECT_THAT(refusal(request), testing::StartsWith("--other: found with --regulation r149-c, expected --regulation fmvss108-adb"));
}

/// All on, a lamp of pixels is far too bright on the line; with a car there spared it keeps to it, on both sides of the car.
TEST_F(LampCommand, MakesTheStateThatEuropesLinesJudge) {
    const std::string check = "lamp '" + library_file("lamps/pixels-16384.yaml") + "' --regulation r149-adb-oncoming-50m";
    EXPECT_EQ(run_program(check).exit_code, 1);
    const std::string both = check + " --other-side '" + library_file("lamps/pixels-16384.yaml") + "' --other 50 3";
    const Outcome spared = run_program(both + " --other-size 3 1.5");
    EXPECT_EQ(spared.exit_code, 0) << spared.output;
    EXPECT_THAT(spared.output, testing::AllOf(HasSubstr("50 m ahead of the lamp and 3 m left of the car's middle"),
                                              HasSubstr("the lamp is 0.45 m left of the middle"), HasSubstr("the lamp is -0.45 m left")));
    EXPECT_EQ(run_program(check + " --other 50 -6").exit_code, 1) << "somebody elsewhere";
}

TEST_F(LampCommand, TurnsALampAndWhereItIsDimmedByTheSameAim) {
    LampFile low = read_lamp(library_file("lamps/led-low.ies"));
    for (double& v_deg : low.table.v_deg)
        v_deg += 1.0;
    write_lamp(low, folder_ / "low.csv");
    const std::string check = "lamp '" + library_file("lamps/led-high.ies") + "' --regulation fmvss108-adb --dimmed -5 -1 -1 2 --aim-by '" +
                              (folder_ / "low.csv") + "' --aim-rule ";
    const std::string text = run_program(check + "auto").output;
    EXPECT_THAT(text, HasSubstr("V -2.00 to 1.00, by fmvss108-lb2v-vol")) << "a degree down, as the low beam";
    for (const char* rule : {"as-is", "maximum"})
        EXPECT_EQ(run_program(check + rule).output, text) << rule;
    EXPECT_THAT(run_program(check + "auto --json").output, testing::Not(HasSubstr("as_filed"))) << "its rows hold for the aimed lamp";
}

/// A box of pixels dark from 1 s on: another lamp then, in every respect.
TEST_F(LampCommand, LooksAtAPixelLampAtATime) {
    std::ofstream(folder_ / "pixels.yaml") << "fernlicht_pixel_lamp: 1\nraster: {pixels: [4, 1], h_deg: [-8, 8], v_deg: [-3, 3], "
                                              "spread_deg: [0.5, 0.25], cd: 1000}\n";
    std::ofstream(folder_ / "levels.csv") << "0, 1, 1, 1, 1\n1, 1, 1, 0, 1\n";
    LampRequest request;
    request.file = folder_ / "pixels.yaml";
    request.levels = folder_ / "levels.csv";
    request.levels_s = 0.5;
    EXPECT_NEAR(intensity_cd(lamp_of(request).table, 2.0, 0.0), 1000.0, 1.0);
    request.levels_s = 1.0;
    EXPECT_LT(intensity_cd(lamp_of(request).table, 2.0, 0.0), 1.0);
    EXPECT_THAT(printed(request),
                HasSubstr("levels of levels.csv at 1 s: 3 of 4 parts shine, 75 % of the flux; dark at H 0 to 4, V -3 to 3"));
    request.mirror = true;
    EXPECT_LT(intensity_cd(lamp_of(request).table, -2.0, 0.0), 1.0);
    std::ofstream(folder_ / "many.yaml") << "fernlicht_pixel_lamp: 1\nraster: {pixels: [202, 1], h_deg: [-8, 8], v_deg: [-3, 3], "
                                            "spread_deg: [0.5, 0.25], cd: 1000}\n";
    std::ofstream levels(folder_ / "every-other.csv");
    levels << "0";
    for (int i = 0; i < 101; ++i)
        levels << ", 0, 1";
    levels.close();
    request.file = folder_ / "many.yaml";
    request.levels = folder_ / "every-other.csv";
    EXPECT_THAT(printed(request), HasSubstr("; dark in 101 boxes: H -8 to -7.921, V -3 to 3; "));
    EXPECT_THAT(lamp_of(request).notes, testing::Contains(testing::EndsWith("; and 1 more")));
    request.mirror = false;
    request.file = folder_ / "pixels.yaml"; // what a run writes: as it shone
    request.levels = folder_ / "levels-drive-set.csv";
    std::ofstream(request.levels, std::ios::binary)
        << "time_s,lamp,level,lit,of,flux,dark,level_1,level_2,level_3,level_4\r\n0,high-left,1,4,4,1,,1,1,1,1\r\n"
           "0,high-right,1,4,4,1,,1,1,1,1\r\n1,high-left,0.5,3,4,0.75,0:4/-3:3,1,1,0,1\r\n1,high-right,1,4,4,1,,1,1,1,1\r\n";
    request.levels_s = 1.5;
    EXPECT_THAT(refusal(request), HasSubstr("--levels-lamp: levels of high-left, high-right, expected --levels-lamp with one of them"));
    request.levels_lamp = "high";
    EXPECT_THAT(refusal(request), HasSubstr("no levels of 'high', expected one of high-left, high-right"));
    request.levels_lamp = "high-left";
    EXPECT_LT(intensity_cd(lamp_of(request).table, 2.0, 0.0), 1.0);
    EXPECT_NEAR(intensity_cd(lamp_of(request).table, -6.0, 0.0), 500.0, 1.0) << "the lamp as a whole is at half";
    EXPECT_THAT(printed(request), HasSubstr("75 % of the flux, the lamp as a whole at 50 %; dark at H 0 to 4"));
    request.levels_s = 0.9;
    EXPECT_NEAR(intensity_cd(lamp_of(request).table, 2.0, 0.0), 1000.0, 1.0);
    request.file = folder_ / "many.yaml";
    EXPECT_THAT(refusal(request), HasSubstr("levels-drive-set.csv:2: found 4 of 4 levels, expected 202, as the lamp has"));
    request.levels_lamp.clear();
    EXPECT_THAT(refusal(request), HasSubstr("--levels-lamp with one of them")) << "not the first lamp's count";
    request.levels_s.reset();
    EXPECT_THAT(refusal(request), HasSubstr("--levels FILE and --at S, both or neither"));
    request = shipped("halogen-low");
    request.levels = folder_ / "levels.csv";
    request.levels_s = 0.0;
    EXPECT_THAT(refusal(request), HasSubstr("levels of a lamp without pixels"));
}

} // namespace
} // namespace fernlicht
