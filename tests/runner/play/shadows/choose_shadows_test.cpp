// `shadows: auto` through the program: what it takes, what it says, and that the resolved drive needs no choice any more.
#include "runner/experiments/shadows/stress_scenes.h"
#include "runner/play/shadows/choose_shadows.h"
#include "runner/play/shadows/shadow_truth.h"
#include "tests/runner/experiments/shadows/short_drive.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* few_automatic = " --quiet --resolution 64x48 --capture all --no-accuracy --backend software ";

class AutomaticShadows : public testing::Test {
  protected:
    std::string drive_with(const std::string& drive, const std::string& shadows) { return short_drive(folder, drive, shadows); }
    json played(const std::string& drive, const std::string& out, const std::string& frames = "3:5") {
        const Outcome run = run_program("run " + drive + few_automatic + "--frames " + frames + " --out " + (folder / out));
        EXPECT_LE(run.exit_code, 1) << run.output;
        return json::parse(content_of(folder / (out + "/report.json"))).at("drives").at(0);
    }

    TemporaryFolder folder;
};

TEST_F(AutomaticShadows, NothingInABeamNeedsNone) {
    const json choice = played(drive_with("straight", "auto") + " --dressing plain", "out").at("shadow_choice");
    EXPECT_EQ(choice.at("chosen"), "none");
    EXPECT_EQ(choice.at("moments_shadowed"), 0);
    EXPECT_TRUE(choice.at("tried").empty());
    EXPECT_THAT(choice.at("why").get<std::string>(), HasSubstr("nothing stands in a beam"));
}

TEST_F(AutomaticShadows, TheCheapestWithinTheBoundIsTakenAndTheResolvedDriveNamesIt) {
    const json with_choice = played(drive_with("shelter", "{method: auto, error_bound: 0.05}"), "first");
    const json& choice = with_choice.at("shadow_choice");
    const json& tried = choice.at("tried");
    ASSERT_GE(tried.size(), 2U);
    EXPECT_EQ(tried.front().at("method"), "none");
    EXPECT_GT(tried.front().at("error").get<double>(), 0.05);
    EXPECT_LE(tried.back().at("error").get<double>(), 0.05);
    EXPECT_EQ(choice.at("chosen"), tried.back().at("method"));
    const json again = played(folder / ("first/" + with_choice.at("drive").get<std::string>() + ".yaml"), "second");
    EXPECT_FALSE(again.contains("shadow_choice"));
    for (const json& frame : with_choice.at("frames"))
        EXPECT_TRUE(content_of(folder / ("first/" + frame.at("exr").get<std::string>())) ==
                    content_of(folder / ("second/" + frame.at("exr").get<std::string>())));
    const std::string page = content_of(folder / "first/report.html");
    EXPECT_THAT(page, HasSubstr("How shadows are rendered"));
    EXPECT_THAT(page, HasSubstr("chose <code>" + choice.at("chosen").get<std::string>() + "</code>"));
}

/// A mirror in which nothing is lit is right by any method, and decides nothing.
TEST_F(AutomaticShadows, TheWorstOfAllViewsDecides) {
    std::string text = content_of(drive_with("shelter", "{method: auto, error_bound: 0.05}"));
    const std::string views = "\nviews:\n";
    ASSERT_NE(text.find(views), std::string::npos);
    text.insert(text.find(views) + views.size(), "  behind: {yaw_deg: 180, resolution_px: [96, 72]}\n");
    std::ofstream(folder / "shelter.yaml") << text;
    const json choice = played(folder / "shelter.yaml", "out").at("shadow_choice");
    EXPECT_NE(choice.at("chosen"), "none");
    const json& none = choice.at("tried").front();
    EXPECT_GT(none.at("error").get<double>(), 0.05);
    EXPECT_NE(none.at("worst_view"), "behind");
    const json& taken = choice.at("tried").back();
    EXPECT_EQ(taken.at("pictures"), 3 * choice.at("moments_compared").get<int>());
}

/// Own lamps that reach nothing are no reason to leave out what others' lamps throw.
TEST_F(AutomaticShadows, OthersLampsAreAskedToo) {
    const json choice = played(drive_with("oncoming", "{method: auto, error_bound: 0.9}"), "out", "3:3").at("shadow_choice");
    EXPECT_GT(choice.at("moments_shadowed"), 0);
    std::string text = content_of(drive_with("oncoming", "{method: auto, error_bound: 0.004}"));
    const std::string own = "lamp_sets:";
    ASSERT_NE(text.find(own), std::string::npos);
    std::ofstream(folder / "oncoming.yaml") << text << "changes: [{at_s: 0, level: 0}]\n";
    const json dark = played(folder / "oncoming.yaml", "dark", "3:3").at("shadow_choice");
    EXPECT_GT(dark.at("moments_shadowed"), 0);
    EXPECT_NE(dark.at("chosen"), "none");
}

/// How many maps the bound saves stands in the report: all pictures of a moment share theirs, and with a bound so do moments.
TEST_F(AutomaticShadows, ReportsTellOfMapsThatStood) {
    const auto kept = [&](const std::string& shadows, const std::string& out) {
        const json drive = played(drive_with("first-light", shadows), out, "20:22");
        for (const json& left : drive.at("left_out")) {
            int stood = 0, used = 0;
            if (std::sscanf(left.get<std::string>().c_str(), "rendering %d of the %d shadow maps", &stood, &used) == 2)
                return static_cast<double>(stood) / used;
        }
        return 0.0;
    };
    EXPECT_GT(kept("{method: map, redraw_texels: 16}", "bound"), kept("map", "exact"));
}

TEST_F(AutomaticShadows, StudiesWhoseCellsWouldChooseEachForItselfRefuse) {
    std::ofstream(folder / "study.yaml") << "fernlicht_study: 1\ntitle: t\nlamps: {a: {low: " << library_file("lamps/halogen-low.ies")
                                         << ", source: filament}}\ndrives: [" << drive_with("straight", "auto") << "]\n";
    const Outcome run = run_program("study " + (folder / "study.yaml") + " --quiet --out " + (folder / "s"));
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_THAT(run.output, HasSubstr("'auto'"));
}

TEST_F(AutomaticShadows, WhereNoneStaysWithinTheLeastWrongIsTakenAndSaid) {
    const json choice = played(drive_with("shelter", "{method: auto, error_bound: 0}"), "out").at("shadow_choice");
    EXPECT_THAT(choice.at("why").get<std::string>(), HasSubstr("no method stays within 0 %; "));
    EXPECT_EQ(choice.at("tried").size(), shadow_methods_by_cost().size());
    double least = 2.0;
    std::string method;
    for (const json& tried : choice.at("tried"))
        if (tried.contains("error") && tried.at("error") < least) {
            least = tried.at("error");
            method = tried.at("method");
        }
    EXPECT_EQ(choice.at("chosen"), method);
}

/// Maps that find no room are no reason to give up: other methods are tried.
TEST_F(AutomaticShadows, MethodsWithoutRoomArePassedOver) {
    const json choice =
        played(drive_with("first-light", "{method: auto, error_bound: 0, map_texels: [4096, 4096], lamp_places: 64}"), "out", "3:3")
            .at("shadow_choice");
    const json& soft = choice.at("tried").back();
    EXPECT_EQ(soft.at("method"), "soft-map");
    EXPECT_FALSE(soft.contains("error") && !soft.at("error").is_null());
    EXPECT_THAT(soft.dump(), HasSubstr("map_texels"));
    EXPECT_NE(choice.at("chosen"), "soft-map");
}

TEST_F(AutomaticShadows, EveryMethodOfTheTableIsTried) {
    std::vector<ShadowMethod> all, tried = shadow_methods_by_cost();
    for (const ShadowMethodName& row : shadow_method_names())
        all.push_back(row.method);
    EXPECT_THAT(tried, testing::UnorderedElementsAreArray(all));
    EXPECT_EQ(tried.front(), ShadowMethod::none);
}

TEST_F(AutomaticShadows, WhatIsWrongIsOneSentence) {
    const auto refused = [&](const std::string& arguments) {
        const Outcome run = run_program(arguments);
        EXPECT_EQ(run.exit_code, 2) << run.output;
        EXPECT_EQ(std::ranges::count(run.output, '\n'), 1) << run.output;
        return run.output;
    };
    for (const std::string bound : {"1", "2", "-0.1"}) {
        const std::string drive = drive_with("straight", "{method: auto, error_bound: " + bound + "}");
        EXPECT_THAT(refused("run " + drive + few_automatic + "--out " + (folder / "o")),
                    HasSubstr("expected a share from 0 to below 1 (0.01 is 1 %)"))
            << bound;
    }
    EXPECT_THAT(refused("run " + drive_with("braking", "{method: volume}") + few_automatic + "--out " + (folder / "o")),
                HasSubstr("one of none"));
    std::string text = content_of(library_file("drives/s-bend-can.yaml"));
    for (std::size_t at = 0; (at = text.find("../", at)) != std::string::npos;)
        text.replace(at, 3, library_file(""));
    std::ofstream(folder / "live.yaml") << text << "shadows: auto\n";
    EXPECT_THAT(refused("live " + (folder / "live.yaml") + " --can-log " + library_file("can/s-bend.log") + " --out " + (folder / "o")),
                HasSubstr("'auto'"));
    EXPECT_FALSE(std::filesystem::exists(folder / "o"));
}

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
    for (const std::string command : {"accuracy --count 1 --techniques photometric", "bench --count 1 --techniques photometric",
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

const std::vector<ShadowScene>& scenes() {
    static const std::vector<ShadowScene> all =
        stress_scenes(std::make_shared<const LampFile>(read_lamp(library_file("lamps/xenon-low.ies"))));
    return all;
}

TEST(ShadowTruth, DiscsHaveHalfShadowsThatPointsLack) {
    Device device = open_device("auto");
    const ShadowScene& scene = scenes().front();
    const Reference rays(*scene.scene);
    Renderer unshadowed(device, *scene.scene, without_shadows(scene.light));
    const View view = at_size(scene.view, 160, 120);
    ShadowTruth points(rays, unshadowed, scene.moments, view), discs(rays, unshadowed, scene.moments, view, 0.05);
    const auto halves = [&](ShadowTruth& truth) {
        const ShadowImages images = truth.images(unshadowed, 0);
        int count = 0;
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x)
                if (const auto degrees = shadow_degrees(images, x, y))
                    count += degrees->truth > 0.05 && degrees->truth < 0.2 ? 1 : 0; // no lamp alone gives so little
        return count;
    };
    EXPECT_GT(halves(discs), halves(points) + 5);
}

TEST(StressScenes, MovingAheadTakesTheLampsAlong) {
    Moment moment = scenes().front().moments.front();
    moment.ego.axes = axes_from_angles(radians(90.0), 0.0, 0.0);
    const Moment moved = moved_ahead(moment, 2.0);
    EXPECT_NEAR(moved.ego.position_m.y, 2.0, 1e-12);
    EXPECT_NEAR(moved.lamps[0].pose.position_m.y, moment.lamps[0].pose.position_m.y + 2.0, 1e-12);
    moment.lamps[0].intensity_factor = 0.0;
    const Moment alone = first_lamp_alone(moment);
    EXPECT_EQ(alone.lamps[0].intensity_factor, 0.0);
    EXPECT_EQ(alone.lamps[1].intensity_factor, 1.0);
    moment.lamps[0].intensity_factor = 0.5;
    EXPECT_EQ(first_lamp_alone(moment).lamps[0].intensity_factor, 0.5);
    EXPECT_LT(first_lamp_alone(moment).lamps[1].intensity_factor, 1e-5);
    EXPECT_GT(first_lamp_alone(moment).lamps[1].intensity_factor, 0.0); // it still shines
}

} // namespace

} // namespace fernlicht
