// The key `can` of a drive: what is read is written back, what is wrong is refused at its place.
#include "scenarios/can/bus_mapping.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/edits/mirrored_drive.h"
#include "scenarios/drives/keys/bus_keys.h"
#include "tests/scenarios/drives/drive_fixture.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

class BusKeys : public DriveFixture {
  protected:
    BusKeys() {
        write_file(folder / "bus.dbc", "VERSION \"\"\n");
        write_file(folder / "bus.log", "(1.000000) can0 123#\n");
    }
    std::string with(const std::string& can, const DriveEdits& edits = {}) {
        return refusal(minimal + "can: {databases: bus.dbc, " + can + "}\n", edits);
    }
    std::string with_input(const std::string& input) { return with("inputs: {" + input + "}"); }
};

/// A line for many: the number goes into each name.
TEST_F(BusKeys, ARangeOfNumbersIsASignalEach) {
    const Drive drive =
        read(minimal + "can: {databases: bus.dbc, inputs: {'others[2:4].left_rad': {signal: Object#.Left, also: Also.Left#, "
                       "opposite: true}, 'others[9].valid': A.B}}\n");
    const std::vector<BusInput>& inputs = drive.can->inputs;
    ASSERT_EQ(inputs.size(), 4U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(inputs[i].name, fmt::format("others[{}].left_rad", i + 2));
        EXPECT_EQ(inputs[i].source.text(), fmt::format("Object{}.Left", i + 2));
        EXPECT_EQ(inputs[i].also->text(), fmt::format("Also.Left{}", i + 2));
        EXPECT_TRUE(inputs[i].opposite);
    }
    EXPECT_EQ(write_drive(read(write_drive(drive))), write_drive(drive));
    EXPECT_THAT(with_input("'others[1:3].valid': Object.Valid"), HasSubstr("one signal for others[1:3].valid, expected # for the number"));
    for (const char* range : {"0:3", "3:3", "4:3", "1:", ":3", "1:x", "1:5000"})
        EXPECT_THAT(with_input(fmt::format("'others[{}].valid': Object#.Valid", range)),
                    HasSubstr("[FIRST:LAST], whole numbers from 1 on"));
    EXPECT_THAT(with_input("'others[1:600].valid': O#.V, 'others[1:600].left_rad': O#.L"), HasSubstr("1200 inputs, expected at most 1000"));
}

TEST_F(BusKeys, ResolvedDrivesReadBackToTheSame) {
    const Drive drive = read(minimal + R"(can:
  databases: [bus.dbc]
  channel: can1
  log: bus.log
  start: 1436509052.2497131
  inputs:
    ego.speed_mps: {signal: A.B, also: C.D, tolerance: 0.5, factor: -2, offset: 1.5, stale_after_s: 0.25, stale: hold, missing: fail, out_of_range: default, contradictory: fail, default: 3}
    "lamp.*.switch": {signal: "A.With space", values: {"on and off": 1, 2.5: 0.5}}
    lamp.left.swivel_command_rad: A.C
  outputs:
    A.B: ego.speed_mps
    C.E: {signal: lamp.left.level, values: {off: 0, full: 1}, cycle_s: 0.04}
)");
    ASSERT_NE(drive.can, nullptr);
    EXPECT_EQ(drive.can->start_ns, 1436509052249713100);
    const BusInput& speed = drive.can->inputs[0];
    EXPECT_EQ(speed.source.text(), "A.B");
    EXPECT_EQ(speed.also->text(), "C.D");
    EXPECT_EQ(speed.policy(BusState::stale), BusPolicy::hold);
    EXPECT_EQ(speed.policy(BusState::missing), BusPolicy::fail);
    EXPECT_EQ(speed.policy(BusState::out_of_range), BusPolicy::fallback);
    EXPECT_EQ(speed.policy(BusState::contradictory), BusPolicy::fail);
    EXPECT_EQ(drive.can->inputs[2].policy(BusState::stale), BusPolicy::lost);
    EXPECT_EQ(drive.can->inputs[1].values, (std::vector<std::pair<std::string, double>>{{"on and off", 1.0}, {"2.5", 0.5}}));
    EXPECT_EQ(drive.can->outputs[1].cycle_s, 0.04);
    ASSERT_NE(drive.lamp_sets[0].control, nullptr) << "without laws, so that switches reach the lamps";
    EXPECT_TRUE(*drive.lamp_sets[0].control == ControlParameters{});
    const std::string written = write_drive(drive);
    const Drive again = read(written);
    EXPECT_EQ(write_drive(again), written);
    EXPECT_EQ(again.can->start_ns, drive.can->start_ns);
    EXPECT_EQ(again.can->inputs[1].values, drive.can->inputs[1].values);
}

TEST_F(BusKeys, FlagsTakeAnotherRecordingOrNone) {
    const std::string yaml = minimal + "can: {databases: bus.dbc, log: bus.log, start: 1, inputs: {ego.speed_mps: A.B}}\n";
    DriveEdits edits;
    edits.can_log = folder / "other.log";
    Drive drive = read(yaml, edits);
    EXPECT_EQ(drive.can->log, folder / "other.log");
    EXPECT_FALSE(drive.can->start_ns) << "that was of the other one";
    edits.can_start_ns = 7;
    edits.can_channel = "can9";
    drive = read(yaml, edits);
    EXPECT_EQ(drive.can->start_ns, 7);
    EXPECT_EQ(drive.can->channel, "can9");
    edits.can_log = std::filesystem::path();
    EXPECT_THAT(refusal(yaml, edits), HasSubstr("--can-start: found a start of a drive that is played without a recording"));
    edits.can_start_ns.reset();
    drive = read(yaml, edits);
    EXPECT_TRUE(drive.can->scripted);
    EXPECT_THAT(write_drive(drive), HasSubstr("\n  log: none\n"));
    EXPECT_THAT(refusal(minimal, edits), HasSubstr("found a drive without `can`"));
}

TEST_F(BusKeys, WhatIsWrongIsRefusedAtItsPlace) {
    EXPECT_EQ(with_input("ego.speed_mps: A.B"), "not refused");
    EXPECT_THAT(with_input("ego.sped_mps: A.B"), HasSubstr("drive.yaml:7:50: can.inputs.ego.sped_mps: no signal 'ego.sped_mps', expected "
                                                           "'ego.speed_mps', the nearest signal"));
    EXPECT_THAT(with_input("control.mode: A.B"), HasSubstr("control.mode, which the laws write"));
    EXPECT_THAT(with_input("time_s: A.B"), HasSubstr("time_s, which the drive write"));
    EXPECT_THAT(with_input("lamp.left.swivel_stuck: A.B"), HasSubstr("which the laws write"));
    EXPECT_THAT(with_input("lamp.middle.switch: A.B"), HasSubstr("no signal 'lamp.middle.switch'"));
    EXPECT_THAT(with_input("ego.speed_mps: Speed"), HasSubstr("Message.Signal, as the database names them"));
    EXPECT_THAT(with_input("ego.speed_mps: {signal: A.B, stale: keep}"), HasSubstr("one of hold, default, lost, fail"));
    EXPECT_THAT(with_input("ego.speed_mps: {signal: A.B, stale: default}"),
                HasSubstr("'default' without a value, expected default: NUMBER"));
    EXPECT_THAT(with_input("ego.speed_mps: {signal: A.B, default: 1000}"), HasSubstr("a number from -60 to 150"));
    EXPECT_THAT(with_input("ego.speed_mps: {signal: A.B, tolerance: 1}"), HasSubstr("a tolerance without a second signal"));
    EXPECT_THAT(with_input("ego.speed_mps: {signal: A.B, contradictory: hold}"), HasSubstr("without a second one"));
    EXPECT_THAT(with_input("ego.speed_mps: {signal: A.B, factor: 0}"), HasSubstr("a number that is not 0"));
    EXPECT_THAT(with_input("ego.speed_mps: {signal: A.B, factor: 2, values: {a: 1}}"), HasSubstr("values beside factor or offset"));
    EXPECT_THAT(with_input("ego.speed_mps: {signal: A.B, stales: hold}"), HasSubstr("'stale', the nearest known key"));
    EXPECT_THAT(with("outputs: {A.B: ego.sped}"), HasSubstr("no signal 'ego.sped'"));
    EXPECT_THAT(with("outputs: {A.B: lamp.*.level}"), HasSubstr("a star"));
    EXPECT_THAT(with("outputs: {A: ego.speed_mps}"), HasSubstr("'A', expected Message.Signal"));
    EXPECT_THAT(with("log: absent.log, inputs: {ego.speed_mps: A.B}"), HasSubstr("there is no file"));
    EXPECT_THAT(with("start: 3, inputs: {ego.speed_mps: A.B}"), HasSubstr("a start without a recording"));
    EXPECT_THAT(with("log: bus.log, start: later, inputs: {ego.speed_mps: A.B}"), HasSubstr("a stamp of the recording in seconds"));
    EXPECT_THAT(with("channel: can0"), HasSubstr("a bus without signals, expected inputs, outputs or both"));
    EXPECT_THAT(refusal(minimal + "can: {inputs: {ego.speed_mps: A.B}}\n"), HasSubstr("can.databases"));
    EXPECT_THAT(refusal(minimal + "can: {databases: absent.dbc, inputs: {ego.speed_mps: A.B}}\n"), HasSubstr("there is no file"));
    const std::string two = "fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\nlamp_sets:\n"
                            "  one: {file: low.ies, control: {period_s: 0.01}}\n  two: {file: low.ies, control: {period_s: 0.02}}\n";
    EXPECT_THAT(refusal(two + "can: {databases: bus.dbc, inputs: {ego.speed_mps: A.B}}\n"),
                HasSubstr("found 0.01 s and 0.02 s, expected the same for all lamp sets"));
}

TEST_F(BusKeys, InAMirrorSignalsPointToTheOtherSide) {
    Drive drive =
        read(minimal + "can: {databases: bus.dbc, inputs: {ego.yaw_rate_rad_s: {signal: A.B, default: 0.5}, lamp.left.switch: A.C, "
                       "ego.speed_mps: A.D}, outputs: {A.E: lamp.right.swivel_rad, A.F: {signal: ego.indicator, opposite: true}}}\n");
    mirror_traffic(drive, true);
    const BusMapping& mapping = *drive.can;
    EXPECT_TRUE(mapping.inputs[0].opposite);
    EXPECT_EQ(mapping.inputs[0].fallback, -0.5);
    EXPECT_EQ(mapping.inputs[1].name, "lamp.right.switch");
    EXPECT_FALSE(mapping.inputs[1].opposite);
    EXPECT_FALSE(mapping.inputs[2].opposite);
    EXPECT_EQ(mapping.outputs[0].name, "lamp.left.swivel_rad");
    EXPECT_TRUE(mapping.outputs[0].opposite);
    EXPECT_FALSE(mapping.outputs[1].opposite);
}

TEST_F(BusKeys, StampsAreExact) {
    EXPECT_EQ(stamp_from_text("1436509052.249713"), 1436509052249713000);
    EXPECT_EQ(stamp_from_text("0"), 0);
    EXPECT_EQ(stamp_from_text("12.000000001"), 12000000001);
    for (const char* const wrong : {"", ".", "1.", ".5", "-1", "1e3", "1.0000000001", "12345678901", "1,5"})
        EXPECT_FALSE(stamp_from_text(wrong)) << wrong;
}

} // namespace
} // namespace fernlicht
