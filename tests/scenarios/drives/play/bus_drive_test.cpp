// Drives by a bus: what a recording makes of them, and that tick by tick it is the same.
#include "scenarios/can/candump_log.h"
#include "scenarios/drives/play/bus_drive.h"
#include "scenarios/drives/play/bus_recording.h"
#include "scenarios/drives/play/bus_report.h"
#include "tests/scenarios/drives/drive_fixture.h"
#include "tests/scenarios/drives/play/staged_drive.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::Contains, testing::HasSubstr;

const std::filesystem::path shipped = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/drives/s-bend-can.yaml";

void expect_same(const Moment& a, const Moment& b) {
    EXPECT_EQ(a.time_s, b.time_s);
    EXPECT_EQ(a.distance_m, b.distance_m) << "at " << a.time_s << " s";
    EXPECT_EQ(a.speed_mps, b.speed_mps) << "at " << a.time_s << " s";
    EXPECT_EQ(a.ego, b.ego) << "at " << a.time_s << " s";
    ASSERT_EQ(a.lamps.size(), b.lamps.size());
    for (std::size_t i = 0; i < a.lamps.size(); ++i) {
        EXPECT_EQ(a.lamps[i].pose, b.lamps[i].pose) << a.lamps[i].name << " at " << a.time_s << " s";
        EXPECT_EQ(a.lamps[i].intensity_factor, b.lamps[i].intensity_factor) << a.lamps[i].name << " at " << a.time_s << " s";
    }
}

class BusDriveTest : public DriveFixture {
  protected:
    /// A car at 36 km/h on a library road with these keys of `can`.
    static std::string on(const char* road, const char* duration_s, const std::string& keys) {
        return fmt::format("fernlicht: 1\nroad: {0}/scenarios/library/roads/{1}.xodr\nspeed_kmh: 36\nduration_s: {2}\nstep_s: 0.1\n"
                           "lamp_sets: {{one: {{file: low.ies}}}}\ncan:\n  databases: {0}/scenarios/library/can/mock-up.dbc\n"
                           "  log: bus.log\n  inputs: {3}\n",
                           FERNLICHT_SOURCE_DIR, road, duration_s, keys);
    }
    Drive scripted() { return read_drive(shipped, DriveEdits{.can_log = std::filesystem::path()}); }
    /// The shipped drive by these frames.
    Drive played_by(const std::vector<CanFrame>& frames, const BusMapping* mapping = nullptr) {
        std::string text;
        for (const CanFrame& frame : frames)
            text += candump_line(frame) + '\n';
        write_file(folder / "bus.log", text);
        Drive drive = read_drive(shipped, DriveEdits{.can_log = folder / "bus.log"});
        if (mapping) {
            BusMapping with = *mapping;
            with.log = folder / "bus.log";
            with.scripted = false;
            drive.can = std::make_shared<const BusMapping>(with);
        }
        return drive;
    }
    /// Speed, yaw rate and wheels in doubles.
    static BusMapping exact(const Drive& drive) {
        BusMapping mapping = *drive.can;
        for (BusInput& input : mapping.inputs) {
            input.also.reset();
            for (const auto& [name, signal] :
                 {std::pair{"ego.speed_mps", "Speed"}, {"ego.yaw_rate_rad_s", "YawRate"}, {"ego.steering_rad", "RoadWheelAngle"}})
                if (input.name == name)
                    input.source = {"Exact", signal};
        }
        return mapping;
    }
    static std::vector<CanFrame> recording_of(const StagedDrive& script) {
        FilesRead opened;
        std::vector<std::string> notes;
        return recorded_inputs(script.drive, script.route, script.drive.lamp_sets[1], opened, notes);
    }
};

TEST_F(BusDriveTest, SignalsThatSayTheSameAsTheScriptMakeTheSameMoments) {
    Drive drive = scripted();
    drive.can = std::make_shared<const BusMapping>(exact(drive));
    const StagedDrive script(drive), bus(played_by(recording_of(script), script.drive.can.get()));
    ASSERT_TRUE(bus.drive.bus_motion);
    ASSERT_EQ(tick_count(bus.drive), tick_count(script.drive));
    double place_m = 0.0, turn_rad = 0.0;
    for (int tick = 0; tick < tick_count(script.drive); ++tick) {
        if (script.at_tick(tick, 1).time_s <= 20.0) { // a constant speed is the same profile
            expect_same(script.at_tick(tick, 1), bus.at_tick(tick, 1));
            expect_same(script.at_tick(tick, 0), bus.at_tick(tick, 0));
        }
        place_m = std::max(place_m, std::abs(script.at_tick(tick, 1).distance_m - bus.at_tick(tick, 1).distance_m));
        turn_rad = std::max(turn_rad, std::abs(swivel_rad(script.at_tick(tick, 1), 0) - swivel_rad(bus.at_tick(tick, 1), 0)));
    }
    // A ramp in pieces of 20 ms is the same ramp but for the rounding of its sums.
    EXPECT_LT(place_m, 1e-9);
    EXPECT_LT(turn_rad, 1e-9);
    EXPECT_EQ(script.drive.lamp_sets[1].motion->control->rows.size(), bus.drive.lamp_sets[1].motion->control->rows.size());
}

TEST_F(BusDriveTest, QuantisedSignalsMoveThingsAsFarAsTheirSteps) {
    const StagedDrive script(scripted()), bus(read_drive(shipped));
    double place_m = 0.0, turn_rad = 0.0;
    for (int tick = 0; tick < tick_count(script.drive); ++tick) {
        const Moment a = script.at_tick(tick, 1), b = bus.at_tick(tick, 1);
        if (a.time_s <= 20.0) {
            EXPECT_EQ(a.ego, b.ego) << "64.40 km/h is a value of the signal";
        }
        EXPECT_EQ(a.lamps[0].intensity_factor, b.lamps[0].intensity_factor);
        place_m = std::max(place_m, std::abs(a.distance_m - b.distance_m));
        turn_rad = std::max(turn_rad, std::abs(swivel_rad(a, 0) - swivel_rad(b, 0)));
    }
    EXPECT_LT(place_m, 8.0 * 0.005 / 3.6) << "half a step of 0.01 km/h for 8 s";
    EXPECT_GT(place_m, 0.0);
    // Half a step of 0.005 degrees a second, and what the other place makes of the bend: 0.75 s of it; the actuator overshoots little.
    EXPECT_LT(turn_rad, 1.2 * 0.75 * radians(0.0025) + 1e-3 * place_m);
    EXPECT_GT(turn_rad, 0.0);
    for (const BusRecordOfInput& record : bus.drive.bus->records) {
        EXPECT_GT(record.frames, 500U);
        EXPECT_EQ(record.ticks[0], bus.drive.bus->ticks.size()) << "always fresh";
    }
}

TEST_F(BusDriveTest, TickByTickIsTheSameAsBeforehand) {
    FilesRead opened;
    std::vector<CanFrame> frames = read_candump(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/can/s-bend.log", opened);
    // Half a second without any frame, and yaw rates that two messages tell differently.
    std::erase_if(frames, [&](const CanFrame& frame) {
        const std::int64_t since = frame.time_ns - frames.front().time_ns;
        return since > 3'100'000'000 && since < 3'600'000'000;
    });
    for (CanFrame& frame : frames)
        if (frame.id == 288 && frame.time_ns - frames.front().time_ns > 6'000'000'000)
            frame.data[0] ^= 0x01;
    const StagedDrive before(played_by(frames));
    EXPECT_GT(before.drive.bus->records[1].ticks[static_cast<std::size_t>(BusState::stale)], 10U);
    EXPECT_GT(before.drive.bus->records[1].ticks[static_cast<std::size_t>(BusState::contradictory)], 1000U);

    Drive live_drive = played_by(frames);
    live_drive.live = true;
    StagedDrive live(std::move(live_drive));
    BusDrive drive(live.drive, live.route, 1);
    std::vector<CanFrame> sent;
    std::vector<Moment> moments;
    std::size_t next = 0;
    while (!drive.done()) {
        for (; next < frames.size() && frames[next].time_ns - frames.front().time_ns <= drive.next_tick_ns(); ++next) {
            CanFrame frame = frames[next];
            frame.time_ns -= frames.front().time_ns;
            drive.take(frame);
        }
        for (const CanFrame& frame : drive.step())
            sent.push_back(frame);
        for (const CanFrame& frame : drive.send_until(drive.next_tick_ns() - 1))
            sent.push_back(frame);
        while (static_cast<int>(moments.size()) < drive.moments())
            moments.push_back(drive.moment(static_cast<int>(moments.size())));
    }
    EXPECT_GT(moments.size(), 270U) << "most of them while it happened";
    drive.finish();
    while (static_cast<int>(moments.size()) < drive.moments())
        moments.push_back(drive.moment(static_cast<int>(moments.size())));
    ASSERT_EQ(static_cast<int>(moments.size()), tick_count(before.drive));
    for (int tick = 0; tick < tick_count(before.drive); ++tick)
        expect_same(before.at_tick(tick, 1), moments[static_cast<std::size_t>(tick)]);
    const Motion& motion = *before.drive.lamp_sets[1].motion;
    ASSERT_EQ(sent.size(), motion.sent.size());
    EXPECT_TRUE(sent == motion.sent);
    ASSERT_EQ(live.drive.lamp_sets[1].motion->control->rows.size(), motion.control->rows.size());
    for (std::size_t row = 0; row < motion.control->rows.size(); ++row)
        for (std::size_t place = 0; place < motion.control->rows[row].size(); ++place) {
            const double a = motion.control->rows[row][place], b = live.drive.lamp_sets[1].motion->control->rows[row][place];
            EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << motion.control->signals[place] << " in row " << row;
        }
    EXPECT_EQ(live.drive.duration_s, before.drive.duration_s);
}

TEST_F(BusDriveTest, APlaceFromTheBusIsWhereTheCarIs) {
    const std::string yaml = on("straight", "2", "{ego.speed_mps: Travel.Speed, ego.distance_m: Travel.Distance}");
    // 36.00 km/h = 0x0e10; 5.000 m = 0x1388, 7.000 m = 0x1b58 after 1 s, and then nothing: both lost after 60 ms.
    write_file(folder / "bus.log", "(100.000000) can0 110#100E881300000000\n(101.000000) can0 110#100E581B00000000\n");
    const StagedDrive played(read(yaml));
    EXPECT_EQ(played.at_tick(0, 0).distance_m, 5.0);
    EXPECT_NEAR(played.at_tick(5, 0).distance_m, 5.0 + 22 * 0.2, 1e-12) << "on with 10 m/s from the tick of 80 ms";
    EXPECT_EQ(played.at_tick(10, 0).distance_m, 7.0);
    EXPECT_NEAR(played.at_tick(15, 0).distance_m, 7.0 + 22 * 0.2, 1e-12);
    EXPECT_EQ(played.at_tick(15, 0).speed_mps, 10.0) << "the last that was known";
    EXPECT_THAT(played.drive.notes, Contains(HasSubstr("the recording ends at 1.000 s of the drive's 2.000 s")));
    EXPECT_THAT(played.drive.notes, Contains(HasSubstr("speed was lost at 92 ticks")));
}

/// The same database with cycle times and without: there the last value holds for ever, whatever its policy, and that is told.
TEST_F(BusDriveTest, WithoutACycleTimeNothingGoesStale) {
    std::string dbc;
    for (const bool cyclic : {true, false}) {
        if (!cyclic) {
            std::ifstream in(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/can/mock-up.dbc");
            for (std::string line; std::getline(in, line);)
                dbc += line.starts_with("BA_ \"GenMsgCycleTime\"") ? "" : line + '\n';
            write_file(folder / "no-cycles.dbc", dbc);
        }
        std::string yaml =
            on("straight", "2", "{ego.speed_mps: {signal: Travel.Speed, stale: default, default: 20}, ego.indicator: Switches.Indicator}");
        if (!cyclic)
            yaml.replace(yaml.find("  databases: ") + 13, yaml.find("\n  log") - yaml.find("  databases: ") - 13, "no-cycles.dbc");
        write_file(folder / "bus.log", "(100.000000) can0 110#100E881300000000\n"); // 36 km/h
        const StagedDrive played(read(yaml));
        EXPECT_EQ(played.at_tick(10, 0).speed_mps, cyclic ? 20.0 : 10.0);
        const std::string ends = "the recording ends at 0.000 s of the drive's 2.000 s; from then on the policies of stale signals hold";
        const std::string never = "; these never go stale and keep their last value: ego.speed_mps, ego.indicator";
        EXPECT_THAT(played.drive.notes, Contains(testing::EndsWith(cyclic ? ends : ends + never)));
        const auto warned =
            Contains(HasSubstr("`stale: default` of ego.speed_mps never acts, its last value holds for ever: nothing says when "
                               "Travel.Speed is stale (stale_after_s, or a cycle time in the database)"));
        const std::vector<std::string> warnings = bus_warnings(played.drive);
        if (cyclic)
            EXPECT_THAT(warnings, testing::Not(warned));
        else
            EXPECT_THAT(warnings, warned);
    }
}

TEST_F(BusDriveTest, TheRouteEndsTheDrive) {
    const std::string yaml = on("s-bend", "100", "{ego.speed_mps: {signal: Travel.Speed, stale: hold}}");
    write_file(folder / "bus.log", "(0.000000) can0 110#409C000000000000\n"); // 400 km/h = 111.1 m/s
    const StagedDrive before(read(yaml));
    const double room_m = before.route.length_m() - before.drive.bumper_m;
    EXPECT_EQ(tick_count(before.drive), static_cast<int>(room_m / (400.0 / 3.6 * 0.1)) + 1);
    EXPECT_THAT(before.drive.notes, Contains(HasSubstr("can: the car comes to the end of the route")));
    Drive live_drive = read(yaml);
    live_drive.live = true;
    StagedDrive live(std::move(live_drive));
    BusDrive drive(live.drive, live.route);
    drive.take(parse_candump_line("(0.000000) can0 110#409C000000000000", {}).frame);
    while (!drive.done())
        drive.step();
    drive.finish();
    EXPECT_EQ(live.drive.duration_s, before.drive.duration_s);
    EXPECT_EQ(drive.moments(), tick_count(before.drive));
    EXPECT_EQ(live.drive.lamp_sets[0].motion->control->ticks, before.drive.lamp_sets[0].motion->control->ticks);
}

TEST_F(BusDriveTest, CommandsLevelsAndMeasuredAnglesReachTheLamps) {
    const std::string yaml = on("straight", "2",
                                "{lamp.left.swivel_command_rad: {signal: LampCommand.SwivelLeft, stale: hold}, "
                                "lamp.left.level: {signal: LampCommand.LevelLeft, stale: hold}, "
                                "lamp.right.swivel_rad: {signal: LampMeasured.SwivelRight, stale: hold}, "
                                "'lamp.*.switch': {signal: Switches.LowBeam, stale: hold}}");
    // Left: 10.00 degrees = 0x03e8, level 50 %; right measured at -5.00 = 0xfe0c. The switch goes off at 1.5 s.
    write_file(folder / "bus.log", "(0.500000) can0 200#0003E80000640000\n(0.500000) can0 220#00000CFE\n(0.500000) can0 100#01000000\n"
                                   "(0.000000) can0 100#01000000\n(1.500000) can0 100#00000000\n");
    const StagedDrive played(read(yaml, DriveEdits{.can_start_ns = 0}));
    EXPECT_EQ(swivel_rad(played.at_tick(4, 0), 0), 0.0) << "not asked yet";
    EXPECT_NEAR(swivel_rad(played.at_tick(14, 0), 0), radians(10.0), 1e-3) << "an actuator has followed";
    EXPECT_LT(swivel_rad(played.at_tick(5, 0), 0), radians(9.0)) << "which takes its time";
    EXPECT_NEAR(swivel_rad(played.at_tick(5, 0), 1), radians(-5.0), 1e-12) << "where it was measured";
    EXPECT_EQ(played.at_tick(4, 0).lamps[0].intensity_factor, 1.0);
    EXPECT_EQ(played.at_tick(5, 0).lamps[0].intensity_factor, 0.5);
    EXPECT_EQ(played.at_tick(5, 0).lamps[1].intensity_factor, 1.0);
    EXPECT_EQ(played.at_tick(15, 0).lamps[0].intensity_factor, 0.0);
    EXPECT_EQ(played.at_tick(15, 0).lamps[1].intensity_factor, 0.0);
}

TEST(BusWriter, ALampThatIsNamedGoesByItsOwnLineWhateverTheOrder) {
    BusMapping mapping;
    for (const char* const name : {"lamp.left.switch", "lamp.*.switch"})
        mapping.inputs.emplace_back().name = name;
    EXPECT_THAT(BusWriter(mapping, {"left", "right"}).names(), testing::ElementsAre("lamp.left.switch", "lamp.right.switch"));
    std::swap(mapping.inputs.front(), mapping.inputs.back());
    const BusWriter writer(mapping, {"left", "right"});
    EXPECT_THAT(writer.names(), testing::ElementsAre("lamp.right.switch", "lamp.left.switch"));
}

} // namespace
} // namespace fernlicht
