// `shadows: auto` through the program: what it takes, what it says, and that the resolved drive needs no choice any more.
#include "runner/play/shadows/choose_shadows.h"
#include "tests/runner/experiments/shadows/short_drive.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* few = " --quiet --resolution 96x72 --capture all --no-accuracy --backend software ";

class AutomaticShadows : public testing::Test {
  protected:
    std::string drive_with(const std::string& drive, const std::string& shadows) { return short_drive(folder, drive, shadows); }
    json played(const std::string& drive, const std::string& out, const std::string& frames = "3:5") {
        const Outcome run = run_program("run " + drive + few + "--frames " + frames + " --out " + (folder / out));
        EXPECT_LE(run.exit_code, 1) << run.output;
        return json::parse(content_of(folder / (out + "/report.json"))).at("drives").at(0);
    }

    TemporaryFolder folder;
};

TEST_F(AutomaticShadows, NothingInABeamNeedsNone) {
    const json choice = played(drive_with("straight", "auto"), "out").at("shadow_choice");
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
    EXPECT_THAT(page, HasSubstr("How shadows are drawn"));
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
    const json choice = played(drive_with("oncoming", "{method: auto, error_bound: 0.9}"), "out").at("shadow_choice");
    EXPECT_GT(choice.at("moments_shadowed"), 0);
    std::string text = content_of(drive_with("oncoming", "{method: auto, error_bound: 0.004}"));
    const std::string own = "variants:";
    ASSERT_NE(text.find(own), std::string::npos);
    std::ofstream(folder / "oncoming.yaml") << text << "changes: [{at_s: 0, level: 0}]\n";
    const json dark = played(folder / "oncoming.yaml", "dark").at("shadow_choice");
    EXPECT_GT(dark.at("moments_shadowed"), 0);
    EXPECT_NE(dark.at("chosen"), "none");
}

/// How many maps the bound saves stands in the report: all pictures of a moment share theirs, and with a bound so do moments.
TEST_F(AutomaticShadows, ReportsTellOfMapsThatStood) {
    const auto kept = [&](const std::string& shadows, const std::string& out) {
        const json drive = played(drive_with("first-light", shadows), out, "20:22");
        for (const json& left : drive.at("left_out")) {
            int stood = 0, used = 0;
            if (std::sscanf(left.get<std::string>().c_str(), "drawing %d of the %d shadow maps", &stood, &used) == 2)
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
        played(drive_with("first-light", "{method: auto, error_bound: 0, map_texels: [8192, 8192], lamp_places: 64}"), "out")
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
        EXPECT_THAT(refused("run " + drive + few + "--out " + (folder / "o")),
                    HasSubstr("expected a share from 0 to below 1 (0.01 is 1 %)"))
            << bound;
    }
    EXPECT_THAT(refused("run " + drive_with("braking", "{method: volume}") + few + "--out " + (folder / "o")), HasSubstr("one of none"));
    std::string text = content_of(library_file("drives/s-bend-can.yaml"));
    for (std::size_t at = 0; (at = text.find("../", at)) != std::string::npos;)
        text.replace(at, 3, library_file(""));
    std::ofstream(folder / "live.yaml") << text << "shadows: auto\n";
    EXPECT_THAT(refused("live " + (folder / "live.yaml") + " --can-log " + library_file("can/s-bend.log") + " --out " + (folder / "o")),
                HasSubstr("'auto'"));
    EXPECT_FALSE(std::filesystem::exists(folder / "o"));
}

} // namespace
} // namespace fernlicht
