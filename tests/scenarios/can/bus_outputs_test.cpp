// What lamp control sends: when, with which bytes, and what happens to values that do not fit.
#include "scenarios/can/bus_outputs.h"
#include "scenarios/can/candump_log.h"
#include "scenarios/values/errors.h"
#include "tests/trial.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::ElementsAre, testing::HasSubstr, testing::IsEmpty;

constexpr std::int64_t a_millisecond_ns = 1'000'000;

CanSignal signal_of(const char* name, std::uint16_t start, std::uint16_t length, double factor, const char* unit) {
    return {.name = name, .start_bit = start, .length = length, .factor = factor, .unit = unit};
}

/// Status, every 50 ms: multiplexed by Lamp; Level on both pages. State, no cycle: Mode with labels.
CanDatabase lamps() {
    CanMessage status{.id = 0x210, .name = "Status", .length = 4, .cycle_s = 0.05};
    CanSignal lamp = signal_of("Lamp", 0, 8, 1.0, "");
    lamp.multiplexor = true;
    CanSignal left = signal_of("Left", 8, 16, 0.01, "deg");
    left.is_signed = true;
    left.minimum = -15.0;
    left.maximum = 15.0;
    left.multiplexed_by = "Lamp";
    left.multiplexed_when = {{0, 0}};
    CanSignal right = left;
    right.name = "Right";
    right.multiplexed_when = {{3, 3}};
    CanSignal level = signal_of("Level", 24, 8, 0.5, "%");
    level.start_value = 20.0;
    status.signals = {lamp, left, right, level};
    CanMessage state{.id = 0x18ff2011, .extended = true, .name = "State", .length = 1};
    CanSignal mode = signal_of("Mode", 0, 8, 1.0, "");
    mode.labels = {{7, "country"}, {9, "town"}};
    state.signals = {mode};
    return CanDatabase{.file = "lamps.dbc", .messages = {status, state}};
}

BusOutput output(const char* message, const char* signal, const char* name) {
    return {.target = {message, signal}, .name = name, .where = {"drive.yaml", 9, 5, std::string("can.outputs.") + message + "." + signal}};
}

std::vector<std::string> lines(const std::vector<CanFrame>& frames) {
    std::vector<std::string> lines;
    for (const CanFrame& frame : frames)
        lines.push_back(candump_line(frame));
    return lines;
}

TEST(BusOutputs, SendEachMessageAtItsCycleWithWhatHeldThen) {
    SignalTable table({"left", "right"});
    BusMapping mapping{.outputs = {output("Status", "Left", "lamp.left.swivel_rad"), output("Status", "Right", "lamp.right.swivel_rad"),
                                   output("Status", "Level", "lamp.left.level")},
                       .channel = "vcan0"};
    BusOutputs outputs(mapping, {lamps()}, table);
    EXPECT_EQ(outputs.next_ns(), 0);
    table.of(0, lamp_signal::swivel) = 0.017453292519943295 * 1.5;  // 150 = 0x0096
    table.of(1, lamp_signal::swivel) = 0.017453292519943295 * -2.0; // -200 = 0xff38
    outputs.set(table);
    EXPECT_THAT(lines(outputs.due(0)), ElementsAre("(0000000000.000000) vcan0 210#009600C8", "(0000000000.000000) vcan0 210#0338FFC8"));
    EXPECT_EQ(outputs.next_ns(), 50 * a_millisecond_ns);
    EXPECT_THAT(outputs.due(49 * a_millisecond_ns), IsEmpty());
    table.of(0, lamp_signal::level) = 0.5; // 50 % is 100 = 0x64
    EXPECT_EQ(lines(outputs.due(50 * a_millisecond_ns)).front(), "(0000000000.050000) vcan0 210#009600C8") << "not told yet";
    outputs.set(table);
    const std::vector<std::string> later = lines(outputs.due(150 * a_millisecond_ns));
    EXPECT_EQ(later.size(), 4U);
    EXPECT_EQ(later.back(), "(0000000000.150000) vcan0 210#0338FF64");
    EXPECT_THAT(outputs.notes(), IsEmpty());
}

TEST(BusOutputs, CutsWhatDoesNotFitAndKeepsWhatIsLost) {
    SignalTable table({"left", "right"});
    BusMapping mapping{.outputs = {output("Status", "Left", "lamp.left.swivel_rad"), output("Status", "Level", "lamp.left.level")}};
    BusOutputs outputs(mapping, {lamps()}, table);
    EXPECT_EQ(lines(outputs.due(0)).front(), "(0000000000.000000) can0 210#00000014") << "start values before anything is known";
    table.of(0, lamp_signal::swivel) = 1.0; // 57 degrees of at most 15
    table.of(0, lamp_signal::level) = std::nan("");
    outputs.set(table);
    EXPECT_EQ(lines(outputs.due(50 * a_millisecond_ns)).front(), "(0000000000.050000) can0 210#00DC0514");
    EXPECT_THAT(outputs.notes(),
                ElementsAre("Status.Left of lamp.left.swivel_rad was beyond -15 to 15 in 1 frames of those sent, and cut to that",
                            "Status.Level of lamp.left.level was lost in 1 frames of those sent, which repeat what was sent before"));
}

TEST(BusOutputs, SendLabelsOfTheNearestValue) {
    SignalTable table({"left"});
    BusMapping mapping{.outputs = {output("State", "Mode", "control.mode")}};
    mapping.outputs.front().values = {{"country", 0.0}, {"town", 1.0}};
    mapping.outputs.front().cycle_s = 0.1;
    BusOutputs outputs(mapping, {lamps()}, table);
    outputs.set(table);
    EXPECT_EQ(lines(outputs.due(0)).front(), "(0000000000.000000) can0 18FF2011#07");
    table[signal::control_mode] = 1.0;
    outputs.set(table);
    EXPECT_EQ(lines(outputs.due(100 * a_millisecond_ns)).front(), "(0000000000.100000) can0 18FF2011#09");
}

TEST(BusOutputs, AreRefusedWhereNothingSaysHow) {
    const SignalTable table({"left"});
    const auto refused = [&](std::vector<BusOutput> wanted) {
        BusMapping mapping{.outputs = std::move(wanted)};
        return tests::refusal_of([&] { BusOutputs(mapping, {lamps()}, table); });
    };
    EXPECT_EQ(refused({output("State", "Mode", "control.mode")}), "drive.yaml:9:5: can.outputs.State.Mode: message 'State' without a cycle "
                                                                  "time, expected GenMsgCycleTime in its database, or cycle_s");
    EXPECT_THAT(refused({output("Status", "Lamp", "control.mode")}), HasSubstr("multiplexor 'Status.Lamp'"));
    EXPECT_THAT(refused({output("Status", "Level", "lamp.left.swivel_rad")}),
                HasSubstr("unit '%' of signal 'Level', expected one that fits 'rad'"));
    EXPECT_THAT(refused({output("Status", "Level", "lamp.middle.level")}), HasSubstr("no signal 'lamp.middle.level'"));
    EXPECT_THAT(refused({output("Statos", "Level", "lamp.left.level")}), HasSubstr("nearest: 'Status'"));
    BusOutput quick = output("Status", "Level", "lamp.left.level"), slow = output("Status", "Left", "lamp.left.swivel_rad");
    quick.cycle_s = 0.01;
    slow.cycle_s = 0.02;
    EXPECT_THAT(refused({quick, slow}), HasSubstr("another cycle of message 'Status' than before"));
}

TEST(BusOutputs, OfAMessageThatIsReadAreRefused) {
    const SignalTable table({"left", "right"});
    BusMapping mapping{.outputs = {output("Status", "Level", "lamp.left.level")}};
    BusInput input{.name = "lamp.left.switch", .source = {"Status", "Level"}};
    mapping.inputs = {input};
    EXPECT_EQ(tests::refusal_of([&] { BusOutputs(mapping, {lamps()}, table); }),
              "drive.yaml:9:5: can.outputs.Status.Level: an output of message 'Status', which lamp.left.switch is read "
              "from, expected a message that nobody else sends");
    mapping.inputs.front().source = {"State", "Mode"};
    EXPECT_NO_THROW(BusOutputs(mapping, {lamps()}, table));
}

} // namespace
} // namespace fernlicht
