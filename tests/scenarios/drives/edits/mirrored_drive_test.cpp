#include "scenarios/drives/edits/mirrored_drive.h"
#include "tests/trial.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <tuple>

namespace fernlicht {
namespace {

TEST(MirroredDrive, NamesChangeSidesByWholeWords) {
    EXPECT_EQ(other_side("left"), "right");
    EXPECT_EQ(other_side("high-right"), "high-left");
    EXPECT_EQ(other_side("reach_5lx_road_left_1_m"), "reach_5lx_road_right_1_m");
    EXPECT_EQ(other_side("bright"), "bright");
    EXPECT_EQ(other_side("leftover right"), "leftover left");
}

TEST(MirroredDrive, AnFmuKeepsItsSidesMappedOrNot) {
    ControlParameters control{.plugins = {{"law.fmu", "", {"left"}}}};
    control.plugins[0].outputs = {{"angle", "lamp.left.level"}};
    const PluginParameters turned = mirrored(control).plugins[0];
    EXPECT_EQ(turned.outputs, control.plugins[0].outputs);
    EXPECT_EQ(turned.lamps, std::vector<std::string>{"right"});
}

/// Every key of a drive, some of them to one side.
Drive example_drive() {
    Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/drive.example.yaml");
    drive.lamp_sets.front().lamps.front().yaw_rad = 0.01;
    return drive;
}

TEST(MirroredDrive, TwiceIsTheDriveAsItWas) {
    Drive drive = example_drive();
    const std::string before = write_drive(drive);
    mirror_traffic(drive, true);
    const std::string once = write_drive(drive);
    EXPECT_NE(once, before);
    EXPECT_THAT(once, testing::HasSubstr("mirrored_road: true"));
    EXPECT_THAT(once, testing::Not(testing::HasSubstr("-0,")));
    mirror_traffic(drive, true);
    EXPECT_EQ(write_drive(drive), before);
}

TEST(MirroredDrive, TolerancesAsideChangeSides) {
    Drive drive;
    ToleranceParameters& tolerances = drive.seeing.tolerances.emplace();
    tolerances.yaw_deg = Tolerance{.from = -0.3, .to = 0.1, .source = {}};
    tolerances.roll_deg = Tolerance{.sigma = 0.1, .mean = 0.05, .from = {}, .to = {}, .source = {}};
    tolerances.pitch_deg = Tolerance{.sigma = 0.1, .mean = 0.05, .from = {}, .to = {}, .source = {}};
    tolerances.limits = {{"reach_5lx_target_own_right_edge_m", 58.0, {}}};
    mirror_traffic(drive, true);
    const ToleranceParameters& turned = *drive.seeing.tolerances;
    EXPECT_EQ(turned.yaw_deg->from, -0.1);
    EXPECT_EQ(turned.yaw_deg->to, 0.3);
    EXPECT_EQ(turned.roll_deg->mean, -0.05);
    EXPECT_EQ(turned.pitch_deg->mean, 0.05);
    EXPECT_EQ(turned.limits.front().reading, "reach_5lx_target_own_left_edge_m");
}

TEST(MirroredDrive, IsWrittenAndReadBack) {
    Drive drive = example_drive();
    mirror_traffic(drive, true);
    const Drive back = read_drive(tests::written("mirrored.yaml", write_drive(drive)));
    EXPECT_EQ(write_drive(back), write_drive(drive));
    EXPECT_TRUE(back.mirrored_road);
    for (std::size_t v = 0; v < back.lamp_sets.size(); ++v)
        for (std::size_t i = 0; i < back.lamp_sets[v].lamps.size(); ++i)
            EXPECT_EQ(back.lamp_sets[v].lamps[i].file->table, drive.lamp_sets[v].lamps[i].file->table);
}

TEST(MirroredDrive, MirrorsLampsOnlyWhereAsked) {
    const Drive drive = example_drive();
    Drive all = drive, road = drive;
    mirror_traffic(all, true);
    mirror_traffic(road, false);
    const MountedLamp &lamp = drive.lamp_sets[0].lamps[0], &turned = all.lamp_sets[0].lamps[0], &kept = road.lamp_sets[0].lamps[0];
    EXPECT_EQ(turned.name, other_side(lamp.name));
    EXPECT_EQ(turned.position_m.y, -lamp.position_m.y);
    EXPECT_EQ(turned.yaw_rad, -0.01);
    EXPECT_EQ(turned.file->table, mirrored(lamp.file->table));
    EXPECT_EQ(std::tuple(kept.name, kept.file, kept.position_m), std::tuple(lamp.name, lamp.file, lamp.position_m));
    EXPECT_TRUE(road.mirrored_road);
    EXPECT_EQ(road.views[0].position_m.y, -drive.views[0].position_m.y) << "the driver changes seats";
}

} // namespace
} // namespace fernlicht
