// What a bus says of a signal at each tick: every state with every policy, by frames made by hand.
#include "scenarios/can/bus_signals.h"
#include "tests/trial.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <tuple>

namespace fernlicht {
namespace {

using testing::ElementsAre, testing::HasSubstr, testing::Pair;

constexpr std::int64_t millisecond_ns = 1'000'000;

/// Speed: 16 bits Intel at byte 0, 0.01 km/h, 0 to 300. Turn: at byte 2, 8 bits, labels. Same speed again in another message.
CanDatabase cockpit() {
    CanSignal speed{.name = "Speed", .length = 16, .factor = 0.01, .maximum = 300.0, .unit = "km/h"};
    CanSignal turn{.name = "Turn", .start_bit = 16, .length = 8, .labels = {{0, "Off"}, {1, "Left"}, {2, "Right"}}};
    CanMessage cockpit{.id = 0x100, .name = "Cockpit", .length = 3, .cycle_s = 0.01, .signals = {speed, turn}};
    CanMessage brakes{.id = 0x18ff0000, .extended = true, .name = "Brakes", .length = 2, .cycle_s = 0.01, .signals = {speed}};
    CanSignal exact{.name = "YawRate", .length = 64, .kind = CanValueKind::float64, .unit = "rad/s"};
    CanMessage event{.id = 0x200, .name = "Event", .length = 8, .signals = {exact}};
    return CanDatabase{.file = "cockpit.dbc", .messages = {cockpit, brakes, event}};
}

CanFrame frame(std::int64_t time_ns, std::uint32_t id, std::initializer_list<int> bytes, bool extended = false) {
    CanFrame made{.time_ns = time_ns, .channel = "can0", .id = id, .extended = extended};
    for (const int byte : bytes)
        made.data[made.length++] = static_cast<std::uint8_t>(byte);
    return made;
}

/// 36 km/h = 10 m/s is 3600 = 0x0e10.
CanFrame ten_mps(std::int64_t time_ns) { return frame(time_ns, 0x100, {0x10, 0x0e, 0}); }

BusInput speed_input() {
    BusInput input{.name = "ego.speed_mps", .source = {"Cockpit", "Speed"}};
    input.policies.fill(BusPolicy::lost);
    input.where = {"drive.yaml", 7, 3, "can.inputs.ego.speed_mps"};
    return input;
}

BusMapping mapping_of(std::vector<BusInput> inputs) { return {.inputs = std::move(inputs)}; }

BusSignals bus_of(const BusInput& input) { return {mapping_of({input}), {cockpit()}}; }

TEST(BusSignals, AFreshSignalHasItsValueAgeAndLastChange) {
    BusSignals bus = bus_of(speed_input());
    bus.take(ten_mps(-5 * millisecond_ns));
    bus.take(ten_mps(4 * millisecond_ns));
    bus.take(frame(12 * millisecond_ns, 0x100, {0x20, 0x1c, 0})); // 72 km/h
    bus.take(frame(18 * millisecond_ns, 0x100, {0x20, 0x1c, 0}));
    const BusValue value = bus.at(20 * millisecond_ns).front();
    EXPECT_EQ(value.state, BusState::fresh);
    EXPECT_EQ(value.value, 72.0 / 3.6) << "exactly as a drive file's speed_kmh";
    EXPECT_DOUBLE_EQ(value.age_s, 0.002);
    EXPECT_DOUBLE_EQ(value.changed_s, 0.012);
    EXPECT_FALSE(value.policy_acted);
    EXPECT_EQ(bus.records().front().frames, 4U);
    EXPECT_EQ(bus.records().front().changes, 2U);
    EXPECT_EQ(bus.frames_used(), 4U);
}

TEST(BusSignals, OthersFramesAreLeftOut) {
    BusMapping mapping = mapping_of({speed_input()});
    mapping.channel = "can0";
    BusSignals bus(mapping, {cockpit()});
    bus.take(frame(0, 0x101, {0x10, 0x0e, 0}));       // another identifier
    bus.take(frame(0, 0x100, {0x10, 0x0e, 0}, true)); // the same, extended
    CanFrame other = ten_mps(0);
    other.channel = "can1";
    bus.take(other);
    other.channel = "can0";
    other.remote = true;
    bus.take(other);
    other.remote = false;
    other.error = true;
    bus.take(other);
    EXPECT_EQ(bus.frames_used(), 0U);
    bus.take(frame(0, 0x100, {0x10})); // too short for the signal
    EXPECT_EQ(bus.at(0).front().state, BusState::missing);
    EXPECT_TRUE(std::isinf(bus.at(0).front().age_s));
    EXPECT_TRUE(std::isnan(bus.at(0).front().value));
    EXPECT_TRUE(std::isnan(bus.at(0).front().changed_s));
    EXPECT_THAT(bus.identifiers(), ElementsAre(Pair(0x100U, false)));
}

struct Case {
    BusState state;
    BusPolicy policy;
    double value; ///< what lamp control gets after a fresh 10 m/s
};

class Policies : public testing::TestWithParam<Case> {};

/// 10 m/s at 0 and 10 ms, read fresh at the tick of 20 ms; then something happens until the tick of 60 ms.
TEST_P(Policies, HandOverWhatTheySay) {
    const Case& with = GetParam();
    BusInput input = speed_input();
    input.also = BusSource{"Brakes", "Speed"};
    input.tolerance = 1.0;
    input.fallback = 3.0;
    input.policies[static_cast<std::size_t>(with.state)] = with.policy;
    BusSignals bus = bus_of(input);
    if (with.state != BusState::missing) {
        for (const std::int64_t at : {0 * millisecond_ns, 10 * millisecond_ns}) {
            bus.take(ten_mps(at));
            bus.take(frame(at, 0x18ff0000, {0x10, 0x0e}, true));
        }
        EXPECT_EQ(bus.at(20 * millisecond_ns).front().value, 10.0);
    }
    if (with.state == BusState::out_of_range)
        bus.take(frame(55 * millisecond_ns, 0x100, {0xff, 0xff, 0})); // 655.35 km/h of at most 300
    if (with.state == BusState::contradictory) {
        bus.take(ten_mps(55 * millisecond_ns));
        bus.take(frame(55 * millisecond_ns, 0x18ff0000, {0x20, 0x1c}, true)); // 20 m/s
    }
    if (with.policy == BusPolicy::fail) {
        const char* const why[] = {
            "", "stale: no frame for 0.050 s at 0.060 s", "missing: no frame until 0.060 s",
            "out of range: 182.042 m/s (655.35 km/h on the bus) at 0.060 s",
            "contradictory: 10 m/s (36 km/h on the bus) beside 20 m/s (72 km/h on the bus) of Brakes.Speed at 0.060 s"};
        EXPECT_THAT(tests::refusal_of([&] { bus.at(60 * millisecond_ns); }),
                    testing::AllOf(HasSubstr("drive.yaml:7:3: can.inputs.ego.speed_mps: ego.speed_mps of Cockpit.Speed is "),
                                   HasSubstr(why[static_cast<std::size_t>(with.state)])));
        return;
    }
    const BusValue value = bus.at(60 * millisecond_ns).front();
    EXPECT_EQ(value.state, with.state);
    EXPECT_TRUE(value.policy_acted);
    if (std::isnan(with.value))
        EXPECT_TRUE(std::isnan(value.value)) << value.value;
    else
        EXPECT_EQ(value.value, with.value);
    const BusRecordOfInput& record = bus.records().front();
    EXPECT_EQ(record.ticks[static_cast<std::size_t>(with.state)], 1U);
    EXPECT_EQ(record.acted[static_cast<std::size_t>(with.state)], 1U);
    EXPECT_EQ(record.states.back(), (std::pair{0.06, with.state}));
}

constexpr double lost = std::numeric_limits<double>::quiet_NaN();
INSTANTIATE_TEST_SUITE_P(
    Each, Policies,
    testing::Values(Case{BusState::stale, BusPolicy::hold, 10.0}, Case{BusState::stale, BusPolicy::fallback, 3.0},
                    Case{BusState::stale, BusPolicy::lost, lost}, Case{BusState::stale, BusPolicy::fail, lost},
                    Case{BusState::missing, BusPolicy::hold, 3.0}, Case{BusState::missing, BusPolicy::fallback, 3.0},
                    Case{BusState::missing, BusPolicy::lost, lost}, Case{BusState::missing, BusPolicy::fail, lost},
                    Case{BusState::out_of_range, BusPolicy::hold, 10.0}, Case{BusState::out_of_range, BusPolicy::fallback, 3.0},
                    Case{BusState::out_of_range, BusPolicy::lost, lost}, Case{BusState::out_of_range, BusPolicy::fail, lost},
                    Case{BusState::contradictory, BusPolicy::hold, 10.0}, Case{BusState::contradictory, BusPolicy::fallback, 3.0},
                    Case{BusState::contradictory, BusPolicy::lost, lost}, Case{BusState::contradictory, BusPolicy::fail, lost}),
    [](const auto& tested) { return std::string(name_of(tested.param.state)) + "_" + std::string(name_of(tested.param.policy)); });

TEST(BusSignals, AreStaleAfterThreeCyclesOrWhatTheMappingSays) {
    BusSignals by_cycle = bus_of(speed_input()); // 10 ms
    by_cycle.take(ten_mps(0));
    EXPECT_EQ(by_cycle.at(30 * millisecond_ns).front().state, BusState::fresh) << "exactly three cycles old";
    EXPECT_EQ(by_cycle.at(31 * millisecond_ns).front().state, BusState::stale);
    BusInput patient = speed_input();
    patient.stale_after_s = 0.5;
    BusSignals by_mapping = bus_of(patient);
    by_mapping.take(ten_mps(0));
    EXPECT_EQ(by_mapping.at(500 * millisecond_ns).front().state, BusState::fresh);
    EXPECT_EQ(by_mapping.at(501 * millisecond_ns).front().state, BusState::stale);
    BusInput event = speed_input(); // a message without a cycle never is
    event.name = "ego.yaw_rate_rad_s";
    event.source = {"Event", "YawRate"};
    BusSignals never = bus_of(event);
    never.take(frame(0, 0x200, {0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(never.at(3'600'000 * millisecond_ns).front().state, BusState::fresh);
}

TEST(BusSignals, ASecondSourceThatIsNotFreshDoesNotContradict) {
    BusInput input = speed_input();
    input.also = BusSource{"Brakes", "Speed"};
    input.stale_after_s = 1.0;
    BusSignals bus = bus_of(input);
    bus.take(ten_mps(0));
    EXPECT_EQ(bus.at(0).front().state, BusState::fresh);
    EXPECT_EQ(bus.records().front().unchecked, 1U);
    bus.take(frame(1 * millisecond_ns, 0x18ff0000, {0x11, 0x0e}, true)); // 0.01 km/h more than no tolerance allows
    EXPECT_EQ(bus.at(20 * millisecond_ns).front().state, BusState::contradictory);
    EXPECT_DOUBLE_EQ(bus.at(20 * millisecond_ns).front().other, 36.01 / 3.6);
    bus.take(ten_mps(1100 * millisecond_ns));
    EXPECT_EQ(bus.at(1101 * millisecond_ns).front().state, BusState::fresh) << "the second is stale";
    EXPECT_EQ(bus.records().front().unchecked, 2U);
}

TEST(BusSignals, LabelsStandForValues) {
    BusInput input = speed_input();
    input.name = "ego.indicator";
    input.source = {"Cockpit", "Turn"};
    input.values = {{"Left", 1.0}, {"Right", -1.0}, {"0", 0.0}};
    BusSignals bus = bus_of(input);
    const auto said = [&](int raw) {
        bus.take(frame(0, 0x100, {0, 0, raw}));
        return bus.at(0).front();
    };
    EXPECT_EQ(said(1).value, 1.0);
    EXPECT_EQ(said(2).value, -1.0);
    EXPECT_EQ(said(0).value, 0.0);
    EXPECT_EQ(said(3).state, BusState::out_of_range) << "nobody said what 3 is";
}

TEST(BusSignals, OppositeSignsTurnRoundAndAFrameFromThePastCountsAsNow) {
    BusInput input = speed_input();
    input.opposite = true;
    BusSignals round = bus_of(input), bus = bus_of(speed_input());
    round.take(ten_mps(0));
    EXPECT_EQ(round.at(0).front().value, -10.0);
    bus.take(ten_mps(100 * millisecond_ns));
    bus.take(frame(90 * millisecond_ns, 0x100, {0x20, 0x1c, 0}));
    EXPECT_EQ(bus.at(100 * millisecond_ns).front().value, 20.0) << "the one taken last";
    EXPECT_EQ(bus.at(100 * millisecond_ns).front().age_s, 0.0);
}

TEST(BusSignals, DoublesThatAreNoNumbersAreOutOfRange) {
    BusInput input = speed_input();
    input.name = "ego.yaw_rate_rad_s";
    input.source = {"Event", "YawRate"};
    BusSignals bus = bus_of(input);
    const auto said = [&](double value) {
        CanFrame made = frame(0, 0x200, {0, 0, 0, 0, 0, 0, 0, 0});
        std::memcpy(made.data.data(), &value, sizeof value);
        bus.take(made);
        return bus.at(0).front();
    };
    EXPECT_EQ(said(0.125).value, 0.125);
    EXPECT_EQ(said(lost).state, BusState::out_of_range);
    EXPECT_EQ(said(7.0).state, BusState::out_of_range) << "no car turns so fast: beyond the signal table's range";
    EXPECT_EQ(said(-6.3).state, BusState::fresh);
}

std::string refused(const BusInput& input) {
    return tests::refusal_of([&] { bus_of(input); });
}

TEST(BusSignals, RefuseWhatTheDatabaseLacks) {
    const auto with = [](const std::string& message, const std::string& signal, const std::string& name = "ego.speed_mps") {
        BusInput input = speed_input();
        input.name = name;
        input.source = {message, signal};
        return refused(input);
    };
    EXPECT_EQ(with("Cokpit", "Speed"),
              "drive.yaml:7:3: can.inputs.ego.speed_mps: no message 'Cokpit' in cockpit.dbc, expected one of its 3 "
              "messages (nearest: 'Cockpit')");
    EXPECT_THAT(with("Cockpit", "Sped"),
                HasSubstr("no signal 'Sped' in message 'Cockpit', expected one of its 2 signals (nearest: 'Speed')"));
    EXPECT_THAT(with("Cockpit", "Speed", "ego.yaw_rate_rad_s"),
                HasSubstr("unit 'km/h' of signal 'Speed', expected one that fits 'rad/s' (rad/s, deg/s), or factor, offset or values"));
    BusInput input = speed_input();
    input.values = {{"Fast", 1.0}};
    EXPECT_THAT(refused(input), HasSubstr("'Fast', which signal 'Speed' has no label for"));
    input = speed_input();
    input.source = {"Event", "YawRate"};
    input.name = "ego.yaw_rate_rad_s";
    input.policies.fill(BusPolicy::fail);
    EXPECT_THAT(refused(input), HasSubstr("nothing says when 'Event.YawRate' would be there, expected stale_after_s"));
    input.policies.fill(BusPolicy::lost);
    EXPECT_EQ(refused(input), "not refused");
    input.policies[static_cast<std::size_t>(BusState::stale)] = BusPolicy::fail;
    EXPECT_THAT(refused(input), HasSubstr("stale: fail, and nothing says when 'Event.YawRate' would be stale, expected stale_after_s"));
    EXPECT_THAT(tests::refusal_of([] {
                    BusSignals(mapping_of({speed_input()}), {cockpit(), cockpit()});
                }),
                HasSubstr("message 'Cockpit' in more than one database"));
}

TEST(BusUnits, FitThoseOfTheTable) {
    const auto value = [](const char* written, const char* table, double physical) {
        const auto conversion = conversion_between(written, table);
        return conversion ? conversion->to_table(physical) : lost;
    };
    for (const auto& [written, table, physical, expected] :
         {std::tuple("km/h", "m/s", 36.0, 10.0), std::tuple("kph", "m/s", 36.0, 10.0), std::tuple("%", "1", 50.0, 0.5),
          std::tuple("", "1", 2.0, 2.0), std::tuple("m/s^2", "m/s2", 2.0, 2.0), std::tuple("m/s\xc2\xb2", "m/s2", 2.0, 2.0),
          std::tuple("klx", "lx", 2.0, 2000.0), std::tuple("ms", "s", 2.0, 0.002)})
        EXPECT_EQ(value(written, table, physical), expected) << written;
    EXPECT_DOUBLE_EQ(value("mph", "m/s", 100.0), 44.704);
    EXPECT_DOUBLE_EQ(value("\xc2\xb0/s", "rad/s", 180.0), 3.141592653589793);
    EXPECT_DOUBLE_EQ(value("deg", "rad", -90.0), -1.5707963267948966);
    EXPECT_DOUBLE_EQ(value("degrees", "rad", 90.0), 1.5707963267948966);
    EXPECT_TRUE(std::isnan(value("bar", "m/s", 2.0)) && std::isnan(value("%", "m/s", 2.0)));
    for (const char* const unit : {"km/h", "mph", "m/s"})
        EXPECT_DOUBLE_EQ(conversion_between(unit, "m/s")->to_physical(conversion_between(unit, "m/s")->to_table(42.0)), 42.0);
}

} // namespace
} // namespace fernlicht
