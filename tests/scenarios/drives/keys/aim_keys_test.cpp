// The aim of a lamp as drives give it: by angles from its file's axis, or by its cut-off.
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/values/pose.h"
#include "tests/scenarios/drives/drive_fixture.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

class AimKeys : public DriveFixture {
  protected:
    const std::string start = "fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\nlamp_sets:\n";
    MountedLamp lamp(const std::string& aim) {
        return read(start + "  one: {lamps: {left: {file: low.ies, aim: " + aim + "}}}\n").lamp_sets.at(0).lamps.at(0);
    }
    std::string refused(const std::string& aim) { return refusal(start + "  one: {lamps: {left: {file: low.ies, aim: " + aim + "}}}\n"); }
};

TEST_F(AimKeys, HaveAWordOrKeys) {
    const MountedLamp usual = lamp("as-is"), automatic = lamp("auto"), lower = lamp("{rule: auto, cut_off_percent: -1.3}"),
                      turned = lamp("{pitch_deg: 0.5, yaw_deg: -0.2}"), both = lamp("{rule: auto, pitch_deg: 0.2}");
    EXPECT_EQ(usual.aim_rule, BeamAim::as_is);
    EXPECT_EQ(automatic.aim_rule, BeamAim::automatic);
    EXPECT_EQ(automatic.cut_off_percent, -1.0) << "1 % down where nothing is said";
    EXPECT_EQ(lower.cut_off_percent, -1.3);
    EXPECT_EQ(turned.aim_rule, BeamAim::as_is);
    EXPECT_DOUBLE_EQ(turned.pitch_rad, radians(0.5));
    EXPECT_DOUBLE_EQ(turned.yaw_rad, radians(-0.2));
    EXPECT_EQ(both.aim_rule, BeamAim::automatic);
    EXPECT_DOUBLE_EQ(both.pitch_rad, radians(0.2)) << "from where the rule puts the beam";
}

TEST_F(AimKeys, OfALampSetHoldForLampsThatGiveNone) {
    const Drive drive = read(start + "  one: {file: low.ies, aim: auto}\n"
                                     "  two:\n    file: low.ies\n    aim: auto\n    lamps: {left: {aim: as-is}, right: {}}\n");
    for (const MountedLamp& one : drive.lamp_sets[0].lamps)
        EXPECT_EQ(one.aim_rule, BeamAim::automatic);
    EXPECT_EQ(drive.lamp_sets[1].lamps[0].aim_rule, BeamAim::as_is);
    EXPECT_EQ(drive.lamp_sets[1].lamps[1].aim_rule, BeamAim::automatic);
}

TEST_F(AimKeys, AreWrittenAndReadAgain) {
    const Drive drive = read(start + "  one: {lamps: {left: {file: low.ies, aim: {rule: auto, cut_off_percent: -1.3, yaw_deg: 0.1}}, "
                                     "right: low.ies}}\n");
    const std::string text = write_drive(drive);
    EXPECT_THAT(text, HasSubstr("aim: {rule: auto, cut_off_percent: -1.3, pitch_deg: 0, yaw_deg: 0.1, roll_deg: 0}"));
    EXPECT_THAT(text, HasSubstr("aim: {pitch_deg: 0, yaw_deg: 0, roll_deg: 0}")) << "as-is says nothing of a rule";
    const Drive again = read(text);
    EXPECT_EQ(write_drive(again), text);
    EXPECT_EQ(again.lamp_sets[0].lamps[0].cut_off_percent, -1.3);
    Drive found = drive;
    found.lamp_sets[0].lamps[0].aligned.pitch_rad = 0.01;
    EXPECT_EQ(write_drive(found), text) << "what was found is no part of a file";
    EXPECT_EQ(drive_bits(found), drive_bits(drive));
    found.lamp_sets[0].lamps[0].cut_off_percent = -1.4;
    EXPECT_NE(drive_bits(found), drive_bits(drive)) << "what was asked for decides results";
}

TEST_F(AimKeys, RefuseInOneSentence) {
    EXPECT_EQ(refused("atuo"),
              "drive.yaml:6:44: lamp_sets.one.lamps.left.aim: found 'atuo', expected one of as-is, auto (nearest: 'auto')");
    EXPECT_THAT(refused("{cut_off_percent: -1.2}"), HasSubstr("aim.cut_off_percent: cut_off_percent without rule: auto"));
    for (const char* const outside : {"1.3", "0", "-5.1", "-12"})
        EXPECT_THAT(
            refused(fmt::format("{{rule: auto, cut_off_percent: {}}}", outside)),
            HasSubstr(fmt::format("aim.cut_off_percent: found '{}', expected a number from -5 to -0.1: a low beam's cut-off lies below "
                                  "the horizon",
                                  outside)));
    EXPECT_THAT(refused("{percent_down: 1, pitch_deg: 1}"), HasSubstr("percent_down beside a pitch"));
    EXPECT_THAT(refusal(start + "  one: {file: low.ies, changes: [{at_s: 1, aim: {rule: auto}}]}\n"), HasSubstr("rule"))
        << "a change turns the lamp, its rule stays";
}

} // namespace
} // namespace fernlicht
