// Drives whose cars a storyboard moves, through the program; and drives played again from their log.
#include "tests/runner/program.h"
#include "tests/scenarios/openscenario/story_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht::osc {
namespace {

using testing::HasSubstr;

constexpr const char* small_thirty = " --quiet --no-accuracy --resolution 96x72 --capture all --frames 0:30 ";

const std::string lights_off =
    R"(<PrivateAction><AppearanceAction><LightStateAction transitionTime="0"><LightType><VehicleLight vehicleLightType="lowBeam"/></LightType>
<LightState mode="off"/></LightStateAction></AppearanceAction></PrivateAction>)";

const std::string two_cars_apart =
    of("Ego", teleport(on_lane(-1, 50.0)) + speed("20")) + of("Other", teleport(on_lane(-1, 80.0)) + speed("15"));

std::string drive_text(const std::string& more = {}) {
    return fmt::format(R"(fernlicht: 1
name: told
storyboard: told.xosc
rate_hz: 20
duration_s: 3
lamp_sets:
  halogen: {{source: filament, file: "{0}"}}
traffic:
  others: {{entities: all, lamps: {{left: "{0}", right: "{0}"}}}}
measure: {{extent: false}}
{1})",
                       library_file("lamps/halogen-low.ies"), more);
}

/// The rows of one kind and name at a tick, split at commas.
std::vector<std::string> row_of(const std::string& log, int tick, const std::string& kind, const std::string& name) {
    for (const std::vector<std::string>& fields : csv_rows(log))
        if (fields.size() == 20 && fields[1] == std::to_string(tick) && fields[3] == kind && fields[19] == name)
            return fields;
    ADD_FAILURE() << "no row of " << kind << " " << name << " at tick " << tick;
    return std::vector<std::string>(20, "0");
}

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

TEST(StoryRun, CarsAreWhereTheStoryboardHasThemAndTheLogPlaysAgain) {
    const TemporaryFolder folder;
    write(folder / "told.yaml", drive_text());
    write(folder / "told.xosc", scenario_text(two_cars_apart, story(event("dark", lights_off, at_time(1.0)), "Other") + stop_at(10.0)));
    const std::string run = "run " + (folder / "told.yaml") + small_thirty;
    printed(run + "--out " + (folder / "a"));
    const std::string log = content_of(folder / "a/drive-log-told.csv");
    const auto x_m = [&](int tick, const std::string& kind, const std::string& name) {
        return std::stod(row_of(log, tick, kind, name)[4]);
    };
    EXPECT_NEAR(x_m(20, "ego", "ego") - x_m(0, "ego", "ego"), 20.0, 0.01); // 1 s at 20 m/s along a road to the east
    EXPECT_NEAR(x_m(20, "body", "Other") - x_m(0, "body", "Other"), 15.0, 0.01);
    EXPECT_NEAR(x_m(0, "body", "Other") - x_m(0, "ego", "ego"), 30.0, 0.01);
    EXPECT_GT(std::stod(row_of(log, 10, "light", "Other left")[17]), 0.5);
    EXPECT_THAT(log, HasSubstr("halogen,30,1.5,body,"));
    EXPECT_THAT(log, testing::Not(testing::ContainsRegex("halogen,30,1.5,light,[^\n]*Other left\n"))); // switched off after 1 s

    printed(run + "--replay " + (folder / "a/drive-log-told.csv") + " --out " + (folder / "b"));
    EXPECT_EQ(log, content_of(folder / "b/drive-log-told.csv"));
    int frames = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "a/frames/told-halogen")) {
        ++frames;
        EXPECT_TRUE(content_of(entry.path().string()) == content_of(folder / "b/frames/told-halogen/" + entry.path().filename().string()))
            << entry.path().filename();
    }
    EXPECT_GE(frames, 31);

    // The resolved drive stands for the first.
    printed("run " + (folder / "a/told.yaml") + small_thirty + "--out " + (folder / "c"));
    EXPECT_EQ(log, content_of(folder / "c/drive-log-told.csv"));

    // Another place in the log is another picture: replaying does follow it.
    std::string moved = log;
    const std::string place = row_of(log, 10, "ego", "ego")[4];
    moved.replace(moved.find(",10,0.5,ego," + place), 12 + place.size(), ",10,0.5,ego," + fmt::format("{}", std::stod(place) + 1.0));
    write(folder / "moved.csv", moved);
    printed(run + "--replay " + (folder / "moved.csv") + " --out " + (folder / "d"));
    EXPECT_FALSE(content_of(folder / "a/frames/told-halogen/driver-000010.png") ==
                 content_of(folder / "d/frames/told-halogen/driver-000010.png"));
    EXPECT_TRUE(content_of(folder / "a/frames/told-halogen/driver-000011.png") ==
                content_of(folder / "d/frames/told-halogen/driver-000011.png"));
}

TEST(StoryRun, WhatCannotBePlayedIsOneSentence) {
    const TemporaryFolder folder;
    const std::string swarm = "<GlobalAction><TrafficAction trafficName=\"t\"><TrafficSwarmAction/></TrafficAction></GlobalAction>";
    const std::string text = scenario_text(two_cars_apart, story(event("e", swarm, at_time(1.0))) + stop_at(10.0));
    write(folder / "told.yaml", drive_text());
    write(folder / "told.xosc", text);
    const std::string run = "run " + (folder / "told.yaml") + small_thirty;
    EXPECT_THAT(printed(run + "--out " + (folder / "a"), 2), HasSubstr("told.xosc:"));
    printed(run + "--lenient --out " + (folder / "b"));
    EXPECT_THAT(content_of(folder / "b/report.json"), HasSubstr("TrafficAction is not supported and left out"));

    write(folder / "told.yaml", drive_text("route: {lane: 0}\n"));
    EXPECT_THAT(printed(run + "--out " + (folder / "c"), 2), HasSubstr("storyboard"));

    write(folder / "told.yaml", drive_text());
    write(folder / "told.xosc", scenario_text(two_cars_apart, stop_at(10.0)));
    write(folder / "short.csv", "no log\n");
    EXPECT_THAT(printed(run + "--replay " + (folder / "short.csv") + " --out " + (folder / "d"), 2), HasSubstr("short.csv:1"));

    printed(run + "--out " + (folder / "e"));
    const std::string log = content_of(folder / "e/drive-log-told.csv");
    write(folder / "old.csv", "variant" + log.substr(std::string_view("lamp_set").size()));
    EXPECT_THAT(printed(run + "--replay " + (folder / "old.csv") + " --out " + (folder / "o"), 2),
                HasSubstr("`fernlicht migrate --in-place`"));
    EXPECT_THAT(printed("migrate --in-place " + (folder / "old.csv")), HasSubstr("old.csv: changed in line 1\n"));
    EXPECT_EQ(content_of(folder / "old.csv"), log);
    const std::size_t at = log.find(",ego,") + 5;
    write(folder / "far.csv", log.substr(0, at) + "1e30" + log.substr(log.find(',', at)));
    EXPECT_THAT(printed(run + "--replay " + (folder / "far.csv") + " --out " + (folder / "f"), 2),
                testing::AllOf(HasSubstr("far.csv:2"), HasSubstr("a place of 1e+30 m")));
    const std::size_t tick = log.find(',', log.find('\n')) + 1;
    write(folder / "late.csv", log.substr(0, tick) + "6e67" + log.substr(log.find(',', tick)));
    EXPECT_THAT(printed(run + "--replay " + (folder / "late.csv") + " --out " + (folder / "t"), 2),
                HasSubstr("late.csv:2: found tick 6e67, expected a whole number from 0 on"));

    const auto with_entities = [&](const std::string& names) {
        std::string drive = drive_text();
        write(folder / "told.yaml", drive.replace(drive.find("entities: all"), 13, "entities: [" + names + "]"));
        return run_program(run + "--out " + (folder / "g")).output;
    };
    EXPECT_THAT(with_entities("Othr"), HasSubstr("no entity 'Othr' in the storyboard, expected one of Ego, Other"));
    EXPECT_THAT(with_entities("Ego"), HasSubstr("the own car"));

    const std::string play = "storyboard " + (folder / "told.xosc") + " --duration 1 --brief --out ";
    printed(play + (folder / "told.xosc"), 2);
    EXPECT_EQ(content_of(folder / "told.xosc"), scenario_text(two_cars_apart, stop_at(10.0)));
    printed(play + (folder / "tracks.csv"));
    printed(play + (folder / "tracks.csv"), 2);
    printed(play + (folder / "tracks.csv") + " --force");
}

} // namespace
} // namespace fernlicht::osc
