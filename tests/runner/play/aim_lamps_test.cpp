// Drives whose lamps are aimed by their cut-offs when they are staged.
#include "runner/play/aim_lamps.h"

#include "metrics/regulation/installed_aim.h"
#include "runner/play/stage.h"
#include "scenarios/drives/edits/mirrored_drive.h"
#include "tests/lamps.h"
#include "tests/metrics/changed_lamps.h"
#include "tests/shipped.h"
#include "tests/trial.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::ElementsAre, testing::HasSubstr;

std::shared_ptr<const LampFile> shifted_file(double right_deg, double up_deg) {
    return tests::file_of(aimed(shipped("halogen-low"), right_deg, up_deg));
}

/// The straight with one lamp set, whose lamps have this file and an automatic aim.
Drive straight_with(const std::shared_ptr<const LampFile>& file) {
    Drive drive = read_drive(shipped_drives / "straight.yaml");
    drive.lamp_sets.resize(1);
    for (MountedLamp& lamp : drive.lamp_sets[0].lamps) {
        lamp.file = file;
        lamp.aim_rule = BeamAim::automatic;
    }
    return drive;
}

std::vector<LampAim> staged_aims(const Drive& drive) { return lamp_aims(Stage(drive).drive.lamp_sets[0]); }

TEST(AimLamps, PutsTheCutOffWhereTheDriveAsksForIt) {
    for (const auto& [right, up] : {std::pair(0.0, 0.0), {0.0, 0.57}, {0.0, 0.3}, {-0.5, 0.0}})
        for (const double percent : {-1.0, -0.6}) {
            SCOPED_TRACE(testing::Message() << right << ", " << up << " to " << percent);
            Drive drive = straight_with(shifted_file(right, up));
            for (MountedLamp& lamp : drive.lamp_sets[0].lamps)
                lamp.cut_off_percent = percent;
            const std::vector<LampAim> aims = staged_aims(drive);
            ASSERT_EQ(aims.size(), 2U);
            for (const LampAim& aim : aims) {
                EXPECT_TRUE(aim.automatic);
                EXPECT_NEAR(aim.percent.value(), percent, 1e-9);
                EXPECT_NEAR(aim.right_deg.value(), 0.0, 1e-9);
                EXPECT_NEAR(aim.file_up_deg.value(), -0.575 + up, 0.01); // the shipped file's, where regulations.md has it: 0.58 D
                EXPECT_NEAR(aim.file_right_deg.value(), -0.033 + right, 0.01);
                EXPECT_NEAR(aim.turned_up_deg, degrees(std::atan(percent / 100.0)) - *aim.file_up_deg, 1e-4);
                EXPECT_NEAR(aim.turned_right_deg, -*aim.file_right_deg, 1e-3);
                EXPECT_EQ(aim.warning, "");
            }
        }
}

TEST(AimLamps, AnglesOfTheAimCountFromThere) {
    Drive drive = straight_with(shifted_file(0.3, 0.3));
    for (MountedLamp& lamp : drive.lamp_sets[0].lamps)
        lamp.pitch_rad = radians(0.2), lamp.yaw_rad = radians(-1.5);
    for (const LampAim& aim : staged_aims(drive)) {
        EXPECT_NEAR(aim.percent.value(), 100.0 * std::tan(std::atan(-0.01) + radians(0.2)), 1e-6);
        EXPECT_NEAR(aim.right_deg.value(), 1.5, 1e-6);
    }
}

TEST(AimLamps, AWrittenDrivePlaysTheSame) {
    Drive drive = read_drive(shipped_drives / "straight.yaml");
    for (LampSet& lamp_set : drive.lamp_sets)
        for (MountedLamp& lamp : lamp_set.lamps)
            lamp.aim_rule = BeamAim::automatic;
    const Stage first(drive), again(first.drive), written(read_drive(tests::written("written.yaml", write_drive(first.drive))));
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            const Pose pose = first.drive.lamp_sets[i].lamps[k].pose();
            EXPECT_NE(pose, drive.lamp_sets[i].lamps[k].pose()) << "the file's own cut-off is not to the digit at 1 %";
            EXPECT_EQ(again.drive.lamp_sets[i].lamps[k].pose(), pose) << "to the bit";
            EXPECT_EQ(written.drive.lamp_sets[i].lamps[k].pose(), pose) << "to the bit";
        }
    EXPECT_EQ(write_drive(first.drive), write_drive(written.drive));
    const Drive as_is = read_drive(shipped_drives / "straight.yaml");
    const Stage filed(as_is);
    EXPECT_EQ(filed.drive.lamp_sets[0].lamps[0].pose(), as_is.lamp_sets[0].lamps[0].pose()) << "as-is stays, to the bit";
}

TEST(AimLamps, OfAMirroredDriveAreTheMirrorImage) {
    Drive drive = read_drive(shipped_drives / "straight.yaml");
    drive.lamp_sets.resize(1);
    for (MountedLamp& lamp : drive.lamp_sets[0].lamps)
        lamp.aim_rule = BeamAim::automatic;
    Drive mirrored_lamps = drive, abroad = drive;
    mirror_traffic(mirrored_lamps, true);
    mirror_traffic(abroad, false);
    const Turn here = Stage(drive).drive.lamp_sets[0].lamps[0].aligned;
    const Turn there = Stage(mirrored_lamps).drive.lamp_sets[0].lamps[0].aligned;
    EXPECT_NE(here.yaw_rad, 0.0);
    EXPECT_NEAR(there.yaw_rad, -here.yaw_rad, 1e-12);
    EXPECT_NEAR(there.pitch_rad, here.pitch_rad, 1e-12);
    EXPECT_EQ(Stage(abroad).drive.lamp_sets[0].lamps[0].aligned, here) << "a right-hand lamp abroad is aimed as at home";
}

TEST(AimLamps, HighBeamsPointAheadAndMoveWithTheCutOff) {
    Drive drive = straight_with(shifted_file(0.0, 0.57));
    for (MountedLamp& lamp : drive.lamp_sets[0].lamps) {
        lamp.name = "high-" + lamp.name;
        lamp.file = tests::file_of(aimed(shipped("halogen-high"), 0.4, 0.6));
    }
    for (const LampAim& aim : staged_aims(drive)) {
        EXPECT_TRUE(aim.high_beam);
        EXPECT_NEAR(aim.percent.value(), 0.0, 1e-9);
        EXPECT_NEAR(aim.turned_up_deg, -0.6 + 0.08, 0.02) << "its middle lies 0.08 degrees below H-H";
        EXPECT_NEAR(aim.turned_right_deg, -0.4, 0.02);
        EXPECT_FALSE(aim.band_lowest_percent) << "R48 has none for high beams";
    }
}

TEST(AimLamps, AFileThatAChangeGivesIsAimedByItsOwnCutOff) {
    Drive drive = straight_with(shifted_file(0.0, 0.0));
    const auto low = shifted_file(0.0, 0.57), high = tests::file_of(shipped("halogen-high"));
    for (const auto& [at_s, file] : {std::pair(1.0, low), {2.0, high}}) {
        LampChange change;
        change.time_s = at_s;
        change.lamp = "left";
        change.file = file;
        drive.lamp_sets[0].changes.push_back(change);
    }
    const Stage stage(drive);
    const LampSet& lamp_set = stage.drive.lamp_sets[0];
    ASSERT_TRUE(lamp_set.changes[0].aligned);
    EXPECT_NEAR(lamp_set.changes[0].aligned->pitch_rad, lamp_set.lamps[0].aligned.pitch_rad - radians(0.57), 1e-6);
    EXPECT_FALSE(lamp_set.changes[1].aligned) << "without a cut-off it stays in the lamp as that was aimed";
    const std::vector<LampAim> aims = lamp_aims(lamp_set);
    ASSERT_EQ(aims.size(), 4U) << "left with three files, and right";
    EXPECT_NEAR(aims[1].percent.value(), -1.0, 1e-9);
    EXPECT_EQ(aims[1].from_s, 1.0);
    EXPECT_FALSE(aims[2].percent);
    EXPECT_NE(aims[2].why_not, "");
    EXPECT_NEAR(aims[2].turned_up_deg, aims[1].turned_up_deg, 1e-12);
}

TEST(AimLamps, OfOtherRoadUsersAreAimedToo) {
    Drive drive = read_drive(shipped_drives / "oncoming.yaml");
    ASSERT_FALSE(drive.traffic_rows.empty());
    const auto shifted = shifted_file(0.0, 0.57);
    for (MountedLamp& lamp : drive.traffic_rows[0].lamps) {
        lamp.file = shifted;
        lamp.aim_rule = BeamAim::automatic;
    }
    const Stage stage(drive);
    const MountedLamp& lamp = stage.drive.traffic.front().lamps.front().lamp;
    EXPECT_NEAR(mark_on_car(lamp, aim_mark(shifted->table, false).place()).percent, -1.0, 1e-9);
}

TEST(AimLamps, RefuseALampWithoutACutOff) {
    const std::string even = (shipped_library / "lamps/even-0.33lx.csv").string();
    const std::string text = fmt::format("fernlicht: 1\nroad: {}\nspeed_kmh: 72\nduration_s: 1\nlamp_sets:\n"
                                         "  one: {{lamps: {{left: {{file: {}, aim: auto}}}}}}\n",
                                         (shipped_library / "roads/straight.xodr").string(), even);
    const Drive drive = read_drive(tests::written("even.yaml", text));
    const std::string refusal = tests::refusal_of([&] { const Stage stage(drive); });
    EXPECT_THAT(refusal, HasSubstr("even.yaml: lamp_sets.one.lamps.left.aim: found auto, and nothing to aim by in " + even + ": "));
    EXPECT_THAT(refusal, HasSubstr("expected as-is, or the file of a beam with a cut-off"));
}

TEST(AimLamps, OutsideTheBandOfR48AreWarnedOf) {
    const auto warnings = [](double cut_off_percent, double height_m) {
        Drive drive = straight_with(shifted_file(0.0, 0.57));
        for (MountedLamp& lamp : drive.lamp_sets[0].lamps) {
            lamp.cut_off_percent = cut_off_percent;
            lamp.position_m.z = height_m;
        }
        return aim_warnings("halogen", staged_aims(drive));
    };
    EXPECT_THAT(warnings(-0.3, 0.65), ElementsAre("halogen, left and right: the cut-off lies at -0.30 %, and UN R48 (09 series, "
                                                  "6.2.6.1.2) has it between -0.50 and -1.85 % for lamps 0.65 m over the road"));
    EXPECT_THAT(warnings(-0.498, 0.65), ElementsAre(HasSubstr("the cut-off lies at -0.498 %, and UN R48"))) << "not -0.50 above -0.50";
    EXPECT_THAT(warnings(-1.8512, 0.65), ElementsAre(HasSubstr("the cut-off lies at -1.851 %, and UN R48")));
    EXPECT_THAT(warnings(-1.0, 0.65), ElementsAre());
    EXPECT_THAT(warnings(-2.0, 0.65), ElementsAre(HasSubstr("at -2.00 %")));
    EXPECT_THAT(warnings(-2.0, 0.85), ElementsAre()) << "-2.05 % is allowed there";
    EXPECT_THAT(warnings(-0.3, 1.1), ElementsAre(HasSubstr("between -0.94 and -2.54 % for lamps 1.10 m over the road")));
    EXPECT_THAT(warnings(-0.3, 1.3), ElementsAre()) << "no band is known there";
    Drive filed = straight_with(shifted_file(0.0, 0.57));
    for (MountedLamp& lamp : filed.lamp_sets[0].lamps)
        lamp.aim_rule = BeamAim::as_is;
    EXPECT_THAT(aim_warnings("halogen", staged_aims(filed)),
                ElementsAre(HasSubstr("between -0.50 and -1.85 % for lamps 0.65 m over the road; `aim: auto` would aim it")))
        << "a file with its cut-off on H-H, taken as it is";
}

} // namespace
} // namespace fernlicht
