// What flags do to a drive.
#include "tests/scenarios/drives/drive_fixture.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class DriveEditsTest : public DriveFixture {
  protected:
    double peak(const Drive& drive, std::size_t lamp_set, std::size_t lamp) {
        return intensity_cd(drive.lamp_sets.at(lamp_set).lamps.at(lamp).file->table, 0.0, 0.0);
    }
    DriveEdits with_lamp(const std::string& side) {
        DriveEdits edits;
        edits.lamps = {{side, folder / "other.ies"}};
        return edits;
    }
    const std::string pair =
        "fernlicht: 1\nroad: road.xodr\nspeed_mps: 1\nduration_s: 3\n"
        "car: {mounts: {left: [3, 1, 1], right: [3, -1, 1], high-left: [3, 0, 1]}}\n"
        "lamp_sets:\n  a: {file: low.ies}\n  b: {file: low.ies}\n"
        "changes: [{at_s: 1, lamp: left, file: low.ies, source: arc}, {at_s: 1, lamp: left, level: 0.5, file: low.ies}]\n";
};

TEST_F(DriveEditsTest, OneSideInEveryLampSet) {
    const Drive drive = read(pair, with_lamp("left"));
    ASSERT_EQ(drive.lamp_sets.size(), 2U);
    for (const std::size_t lamp_set : {0U, 1U}) {
        EXPECT_DOUBLE_EQ(peak(drive, lamp_set, 0), 2000.0);
        EXPECT_DOUBLE_EQ(peak(drive, lamp_set, 1), 1000.0);
        EXPECT_DOUBLE_EQ(peak(drive, lamp_set, 2), 1000.0) << "the high beam was not meant";
        ASSERT_EQ(drive.lamp_sets[lamp_set].changes.size(), 1U) << "no later switch back to the drive's own file";
        EXPECT_EQ(drive.lamp_sets[lamp_set].changes[0].level, 0.5);
        EXPECT_FALSE(drive.lamp_sets[lamp_set].changes[0].file);
    }
    EXPECT_EQ(drive.opened.back().path, folder / "other.ies");
}

TEST_F(DriveEditsTest, AllLampsLeaveOneLampSet) {
    const Drive drive = read(pair, with_lamp(""));
    ASSERT_EQ(drive.lamp_sets.size(), 1U);
    EXPECT_EQ(drive.lamp_sets[0].name, "other");
    EXPECT_DOUBLE_EQ(peak(drive, 0, 0), 2000.0);
    EXPECT_DOUBLE_EQ(peak(drive, 0, 1), 2000.0);
    EXPECT_DOUBLE_EQ(peak(drive, 0, 2), 1000.0);
    EXPECT_THAT(drive.notes, ElementsAre(HasSubstr("only the first ('a') is played")));
}

TEST_F(DriveEditsTest, ALampThatIsATextGridComesWithItsRecipe) {
    write_file(folder / "grid.txt", "V;-1;1\n-1;500;500\n1;500;500\n");
    write_file(folder / "ours.yaml", "fernlicht_recipe: 1\nlayout: matrix\ndelimiter: semicolon\nunit: cd\n");
    DriveEdits edits;
    edits.lamps = {{"", folder / "grid.txt"}, {"high", folder / "other.ies"}};
    edits.lamp_recipe = folder / "ours.yaml";
    const Drive drive = read(pair, edits);
    EXPECT_DOUBLE_EQ(peak(drive, 0, 0), 500.0);
    EXPECT_DOUBLE_EQ(peak(drive, 0, 2), 2000.0);
    edits.lamp_recipe.clear();
    EXPECT_THAT(refusal(pair, edits), HasSubstr("grid.txt: is no lamp file that we know"));
}

TEST_F(DriveEditsTest, AnAimStandsInPlaceOfTheDrives) {
    const std::string turned = "fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\n"
                               "car: {mounts: {left: [3, 1, 1], high-left: [3, 0, 1], fog-left: [3, 1, 0.4]}}\nlamp_sets:\n"
                               "  a: {lamps: {left: {file: low.ies, aim: {pitch_deg: 0.4, yaw_deg: 1}}, high-left: {file: low.ies}, "
                               "fog-left: {file: low.ies, aim: {pitch_deg: 0.4}}}}\n";
    for (const BeamAim aim : {BeamAim::automatic, BeamAim::as_is}) {
        DriveEdits edits;
        edits.aim = aim;
        const Drive drive = read(turned, edits);
        for (const MountedLamp& lamp : drive.lamp_sets.at(0).lamps) {
            const bool fog = lamp.name == "fog-left";
            EXPECT_EQ(lamp.aim_rule, fog ? BeamAim::as_is : aim) << lamp.name;
            EXPECT_EQ(lamp.pitch_rad != 0.0, fog) << lamp.name;
            EXPECT_EQ(lamp.yaw_rad, 0.0) << lamp.name;
        }
    }
    EXPECT_NE(read(turned, {}).lamp_sets.at(0).lamps.at(0).pitch_rad, 0.0);
}

TEST_F(DriveEditsTest, HighBeamsAreMeantByName) {
    const Drive drive = read(pair, with_lamp("high-left"));
    EXPECT_EQ(drive.lamp_sets.size(), 2U);
    EXPECT_DOUBLE_EQ(peak(drive, 0, 0), 1000.0);
    EXPECT_DOUBLE_EQ(peak(drive, 0, 2), 2000.0);
}

TEST_F(DriveEditsTest, ASideThatNoLampHas) { EXPECT_THAT(refusal(pair, with_lamp("top")), HasSubstr("one of high-left, left, right")); }

TEST_F(DriveEditsTest, AMissingLampOrRoad) {
    DriveEdits edits;
    edits.lamps = {{"", folder / "none.ies"}};
    EXPECT_THAT(refusal(minimal, edits), HasSubstr("none.ies"));
    edits = {};
    edits.road = folder / "none.xodr";
    EXPECT_THAT(refusal(minimal, edits), HasSubstr("none.xodr: there is no such road file"));
    edits.road = folder / std::string(300, 'a');
    EXPECT_THAT(refusal(minimal, edits), HasSubstr("there is no such road file")) << "a name that no file can have";
}

TEST_F(DriveEditsTest, AnotherRoadForgetsTheRoute) {
    write_file(folder / "road2.xodr", "<OpenDRIVE/>");
    DriveEdits edits;
    edits.road = folder / "road2.xodr";
    const Drive drive = read(minimal + "route: {road: 4, lane: -1, s_m: 30, via: [5]}\n", edits);
    EXPECT_EQ(drive.road_file, folder / "road2.xodr");
    EXPECT_EQ(drive.start.road, "");
    EXPECT_EQ(drive.start.lane, 0);
    EXPECT_EQ(drive.start.s_m, 0.0);
    EXPECT_TRUE(drive.via.empty());
    EXPECT_EQ(drive.notes.size(), 1U);
}

TEST_F(DriveEditsTest, TechniqueResolutionAndCapture) {
    DriveEdits edits;
    edits.technique = "as-printed";
    edits.resolution = {{320, 240}};
    edits.capture_all = true;
    const Drive drive = read(minimal, edits);
    EXPECT_EQ(drive.technique, "as-printed");
    EXPECT_EQ(drive.views[0].width_px, 320);
    EXPECT_EQ(drive.views[0].height_px, 240);
    EXPECT_EQ(drive.views[1].width_px, 200) << "the map keeps its own";
    EXPECT_TRUE(drive.capture.all);
    EXPECT_EQ(read(minimal).technique, "photometric");
    for (const auto& bad : {std::pair{0, 10}, {10, -1}, {16385, 10}}) {
        edits.resolution = bad;
        EXPECT_THAT(refusal(minimal, edits), HasSubstr("sides from 1 to 16384 pixels"));
    }
}

} // namespace
} // namespace fernlicht
