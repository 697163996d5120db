// A drive with a vehicle: its moments follow the simulated motion, whatever the frame rate.
#include "scenarios/values/errors.h"
#include "tests/scenarios/drives/drive_fixture.h"
#include "tests/scenarios/drives/play/staged_drive.h"
#include "tests/shipped.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

double climb_rad(const Pose& pose) { return std::atan2(pose.forward().z, std::hypot(pose.forward().x, pose.forward().y)); }

TEST(Motion, RunsOnRailsWithoutAVehicleWhichMustBeSimulatedFirst) {
    const StagedDrive played(read_drive(shipped_drives / "straight.yaml"));
    EXPECT_EQ(played.drive.lamp_sets[0].motion, nullptr);
    EXPECT_EQ(played.at(3.0).ego, ego_pose(played.route, distance_m(played.drive.speed, 3.0), played.drive.wheelbase_m));
    const Drive drive = read_drive(shipped_drives / "braking.yaml");
    const RoadNetwork network = read_opendrive(drive.road_file);
    EXPECT_THROW(moment_at(start(drive), drive, Route(network, drive.start), drive.lamp_sets[0]), std::logic_error);
}

TEST(Motion, BrakingDipsTheLampsAndLevellingLiftsThem) {
    const StagedDrive played(read_drive(shipped_drives / "braking.yaml"));
    EXPECT_NEAR(climb_rad(played.at(1.0).ego), 0.0, 2e-3) << "steady speed: only the drag pitches";
    const Moment fixed = played.at(4.5), levelled = played.at(4.5, 1);
    EXPECT_LT(climb_rad(fixed.ego), radians(-1.2));
    EXPECT_EQ(fixed.ego, levelled.ego) << "lamps do not act on the car";
    EXPECT_NEAR(climb_rad(fixed.lamps[0].pose), climb_rad(fixed.ego), 1e-12);
    // Levelling knows the springs, not the tyres, whose part is a tenth.
    EXPECT_NEAR(climb_rad(levelled.lamps[0].pose), 0.15 * climb_rad(fixed.ego), 0.1 * -climb_rad(fixed.ego));
    EXPECT_NEAR(fixed.speed_mps, speed_mps(played.drive.speed, 4.5), 0.6);
    EXPECT_THAT(played.drive.notes, testing::Contains(HasSubstr("vehicle: dormand-prince for")));
    EXPECT_THAT(played.drive.notes, testing::Not(testing::Contains(HasSubstr("levelling")))) << "they would stand under both lamp sets";
    EXPECT_THAT(played.drive.lamp_sets[0].motion->notes, testing::IsEmpty());
    EXPECT_THAT(played.drive.lamp_sets[1].motion->notes, testing::ElementsAre(testing::StartsWith("levelling: dormand-prince for")));
}

TEST(Motion, DoesNotKnowTheFrameRate) {
    Drive drive = read_drive(shipped_drives / "braking.yaml");
    const StagedDrive coarse(drive);
    drive.step_s = 1.0e-6;
    const StagedDrive fine(drive);
    drive.step_s = 10.0;
    const StagedDrive very_coarse(drive);
    for (double time_s = 0.0; time_s < 12.0; time_s += 0.173)
        for (const std::size_t lamp_set : {0U, 1U}) {
            EXPECT_EQ(coarse.at(time_s, lamp_set).ego, fine.at(time_s, lamp_set).ego);
            EXPECT_EQ(coarse.at(time_s, lamp_set).lamps[0].pose, very_coarse.at(time_s, lamp_set).lamps[0].pose);
        }
}

TEST(Motion, FollowsTheCountryRoad) {
    Drive drive = read_drive(shipped_drives / "country.yaml");
    drive.vehicle = VehicleParameters{};
    drive.lamp_sets[0].swivel = SwivelParameters{};
    const StagedDrive played(drive);
    double furthest_m = 0.0, max_rad = 0.0;
    for (double time_s = 0.0; time_s < played.drive.duration_s; time_s += 0.1) {
        const Moment moment = played.at(time_s);
        const glm::dvec3 beside = to_local(played.route.pose(moment.distance_m), moment.ego.position_m);
        furthest_m = std::max(furthest_m, std::abs(beside.y));
        EXPECT_NEAR(beside.z, 0.0, 0.02) << "the springs move little on a smooth road";
        max_rad = std::max(max_rad, std::abs(played.drive.lamp_sets[0].motion->swivel->angle_rad(time_s)));
    }
    EXPECT_LT(furthest_m, 0.25);
    // The tightest bend is 180 m: half of 19.4 m/s * 1.5 s / 180 m.
    EXPECT_NEAR(max_rad, 0.5 * 19.44 * 1.5 / 180.0, 0.012);
}

TEST(Motion, AStepInTheRoadIsFeltByEachAxleInTurn) {
    Drive drive = read_drive(shipped_drives / "straight.yaml");
    drive.vehicle = VehicleParameters{};
    drive.vehicle->road_steps = {{60.0, 0.03}, {120.0, -0.03}};
    drive.vehicle->tolerance = 1.0e-9;
    const StagedDrive played(drive);
    const CarRun& car = *played.drive.lamp_sets[0].motion->car;
    EXPECT_EQ(car.work().events, 4U);
    // When the front axle comes to the step: by the car's own distance. Before it nothing has happened, just after it the wheel is 3 cm
    // low.
    const auto time_at = [&](double distance) {
        double before_s = 0.0, after_s = 10.0;
        for (int i = 0; i < 60; ++i)
            (car.at((before_s + after_s) / 2.0).distance_m < distance ? before_s : after_s) = (before_s + after_s) / 2.0;
        return before_s;
    };
    const double front_s = time_at(60.0 - drive.wheelbase_m), rear_s = time_at(60.0);
    EXPECT_NEAR(rear_s - front_s, drive.wheelbase_m / 17.89, 0.002);
    EXPECT_NEAR(car.at(front_s - 1e-6).spring_pitch_rad, car.at(front_s - 0.01).spring_pitch_rad, 1e-5);
    EXPECT_NEAR(car.at(front_s + 1e-6).pitch_rad - car.at(front_s - 1e-6).pitch_rad, -0.03 / drive.wheelbase_m, 1e-6)
        << "the road under the front axle is higher at once, the body is not";
    EXPECT_NEAR(car.at(rear_s + 1e-6).rear_lift_m - car.at(rear_s - 1e-6).rear_lift_m, -0.03, 1e-6);
    EXPECT_GT(car.at(front_s + 0.15).pitch_rad, car.at(front_s + 1e-6).pitch_rad + 0.005) << "and then the springs lift it";
    EXPECT_NEAR(car.at(time_at(115.0)).rear_lift_m, 0.0, 2e-3);
}

TEST(Motion, ACarThatCannotBrakeIsCutAtTheRoutesEnd) {
    // To rest in 2 s from 50 m/s, 2.5 g: by plan it stops 10 m before the end.
    Drive drive = read_drive(shipped_drives / "straight.yaml");
    drive.start.s_m = 930.0 - drive.bumper_m;
    drive.speed = {{0.0, 50.0}, {0.2, 50.0}, {2.2, 0.0}};
    drive.vehicle = VehicleParameters{};
    const StagedDrive played(drive);
    EXPECT_LT(played.drive.duration_s, 9.0);
    const double last_m = played.at((tick_count(played.drive) - 1) * played.drive.step_s).distance_m;
    EXPECT_LE(last_m + drive.bumper_m, played.route.length_m());
    EXPECT_THAT(played.drive.notes, testing::Contains(HasSubstr("sooner than planned")));
}

/// What simulate() says of the braking drive with this car; "" where it plays.
std::string refusal(const VehicleParameters& car, std::vector<SpeedPoint> speed = {}) {
    Drive drive = read_drive(shipped_drives / "braking.yaml");
    drive.vehicle = car;
    if (!speed.empty())
        drive.speed = std::move(speed);
    return tests::refusal_of([&] { const StagedDrive played(std::move(drive)); }, "");
}

TEST(Motion, RefusesACarThatLeavesItsModel) {
    VehicleParameters car;
    EXPECT_EQ(refusal(car), "");
    // Braking with 7 m/s2, the rear axle rests on m g a / l - m 7 h / l: nothing from h = 0.45 l g / 7 = 1.7 m on.
    car.centre_of_gravity_height_m = 1.3;
    car.anti_pitch = 1.0; // the springs see nothing of it
    EXPECT_EQ(refusal(car), "");
    car.centre_of_gravity_height_m = 2.0;
    EXPECT_THAT(refusal(car),
                testing::AllOf(HasSubstr("braking.yaml: vehicle: the rear wheels are off the road for more than 0.2 s from 2."),
                               HasSubstr(", expected a car that keeps its wheels on the road")));
    // By docs/vehicle.md m a h / l^2 (1/k + 1/k + 2 / kt): 0.19 rad with springs a fifth as stiff.
    car = {};
    car.front.spring_n_per_m /= 5.0;
    car.rear.spring_n_per_m /= 5.0;
    car.anti_pitch = 0.0;
    EXPECT_THAT(refusal(car), testing::AllOf(HasSubstr("braking.yaml: vehicle: the body is pitched by -8."),
                                             HasSubstr(" degrees against the road at 2."), HasSubstr(", expected at most 8.6 degrees")));
}

TEST(Motion, WheelsThatHopOverAnEdgeAreANote) {
    Drive drive = read_drive(shipped_drives / "straight.yaml");
    drive.vehicle = VehicleParameters{};
    EXPECT_THAT(StagedDrive(drive).drive.notes, testing::Not(testing::Contains(HasSubstr("leave the road"))));
    // Tyres are pressed in by 20 mm at rest: behind an edge 50 mm lower the wheels hang in the air until the springs have pushed them down.
    drive.vehicle->road_steps = {{60.0, -0.05}};
    EXPECT_THAT(StagedDrive(drive).drive.notes, testing::Contains(HasSubstr("vehicle: wheels of an axle leave the road")));
}

TEST(Motion, ARoughRoadPitchesAndRollsTheLampsAndNotTheWheels) {
    Drive drive = read_drive(shipped_drives / "straight.yaml");
    drive.vehicle = VehicleParameters{};
    drive.vehicle->roll = RollParameters{};
    drive.vehicle->roughness = Roughness{RoadClass::C, 1};
    const StagedDrive played(drive);
    const CarRun& car = *played.drive.lamp_sets[0].motion->car;
    double steepest_rad = 0.0, most_rolled_rad = 0.0;
    for (double time_s = 2.0; time_s < played.drive.duration_s; time_s += 0.05) {
        const Moment moment = played.at(time_s);
        const CarPlace place = car.at(time_s);
        EXPECT_NEAR(climb_rad(moment.lamps[0].pose), place.pitch_rad, 1e-5);
        EXPECT_NEAR(std::asin(moment.lamps[0].pose.left().z), std::asin(std::cos(place.pitch_rad) * std::sin(place.roll_rad)), 1e-5);
        EXPECT_NEAR(moment.wheels.up().z, 1.0, 1e-12);
        // The body turns about an axis 0.1 m above the road.
        const glm::dvec3 in_wheels = to_local(moment.wheels, to_parent(moment.ego, {0.0, 0.0, place.roll_axis_m}));
        EXPECT_NEAR(in_wheels.y, 0.0, 1e-12);
        steepest_rad = std::max(steepest_rad, std::abs(place.pitch_rad));
        most_rolled_rad = std::max(most_rolled_rad, std::abs(place.roll_rad));
    }
    EXPECT_GT(degrees(steepest_rad), 0.3);
    EXPECT_LT(degrees(steepest_rad), 2.5);
    EXPECT_GT(degrees(most_rolled_rad), 0.1);
    EXPECT_LT(degrees(most_rolled_rad), 2.5);
    EXPECT_THAT(played.drive.notes, testing::Contains(HasSubstr("vehicle: the body's pitch has a standard deviation of 0.")));
    // As the seed has it, and another road by another.
    EXPECT_EQ(StagedDrive(drive).at(5.0).ego, played.at(5.0).ego);
    drive.vehicle->roughness->seed = 2;
    EXPECT_NE(StagedDrive(drive).at(5.0).ego, played.at(5.0).ego);
}

using VehicleKeys = DriveFixture;

TEST_F(VehicleKeys, AreReadWithTheirDefaults) {
    const Drive plain = read(minimal), words = read(minimal + "vehicle: single-track\nactuators: {levelling: static, swivel: true}\n");
    EXPECT_FALSE(plain.vehicle);
    EXPECT_EQ(words.vehicle, VehicleParameters{});
    EXPECT_EQ(words.lamp_sets[0].levelling->control, LevellingControl::slow);
    EXPECT_EQ(words.lamp_sets[0].swivel, SwivelParameters{});
    const Drive own = read(minimal + "vehicle: {mass_kg: 1800, rear: {spring_n_per_m: 5e4}, road_steps: [{at_m: 3, height_m: -0.01}], "
                                     "solver: rosenbrock}\nactuators: {levelling: {rate_limit_deg_s: 10, min_deg: -2}}\n");
    EXPECT_EQ(own.vehicle->mass_kg, 1800.0);
    EXPECT_EQ(own.vehicle->rear.spring_n_per_m, 5.0e4);
    EXPECT_EQ(own.vehicle->rear.damper_ns_per_m, VehicleParameters{}.rear.damper_ns_per_m);
    EXPECT_EQ(own.vehicle->road_steps, (std::vector<RoadStep>{{3.0, -0.01}}));
    EXPECT_EQ(own.vehicle->solver, Solver::rosenbrock);
    EXPECT_EQ(own.lamp_sets[0].levelling->actuator.rate_limit_rad_s, radians(10.0));
    EXPECT_EQ(own.lamp_sets[0].levelling->actuator.min_rad, radians(-2.0));
    EXPECT_FALSE(own.lamp_sets[0].swivel);
    EXPECT_FALSE(own.vehicle->roll || own.vehicle->roughness || read(minimal + "vehicle: {roll: false}\n").vehicle->roll);
    const Drive disturbed =
        read(minimal + "vehicle: {roll: true, roughness: E, load_steps: [{at_s: 1, rear_kg: 80}, {at_s: 2, front_kg: -20}]}\n");
    EXPECT_EQ(disturbed.vehicle->roll, RollParameters{});
    EXPECT_EQ(disturbed.vehicle->roughness, (Roughness{RoadClass::E, 1}));
    EXPECT_EQ(disturbed.vehicle->load_steps, (std::vector<LoadStep>{{1.0, 0.0, 80.0}, {2.0, -20.0, 0.0}}));
    EXPECT_FALSE(read(minimal + "vehicle: single-track\nactuators: {levelling: none, swivel: false}\n").lamp_sets[0].levelling);
}

TEST_F(VehicleKeys, ALampSetsActuatorsReplaceTheDrives) {
    const std::string drive =
        "fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\nvehicle: single-track\n"
        "actuators: {levelling: dynamic}\nlamp_sets:\n  one: {file: low.ies}\n  two: {file: low.ies, actuators: {}}\n";
    const Drive read_back = read(drive);
    EXPECT_TRUE(read_back.lamp_sets[0].levelling);
    EXPECT_FALSE(read_back.lamp_sets[1].levelling);
}

TEST_F(VehicleKeys, AreRefusedInASentence) {
    EXPECT_THAT(refusal(minimal + "vehicle: bicycle\n"), HasSubstr("vehicle: found 'bicycle'"));
    EXPECT_THAT(refusal(minimal + "vehicle:\ntitle: a\n"), testing::StartsWith("drive.yaml:7:1: vehicle: found nothing"));
    EXPECT_THAT(refusal(minimal + "vehicle: {mass: 3}\n"), HasSubstr("vehicle.mass: unknown key, expected 'mass_kg'"));
    EXPECT_THAT(refusal(minimal + "vehicle: {front: {spring: 3}}\n"), HasSubstr("vehicle.front.spring: unknown key"));
    EXPECT_THAT(refusal(minimal + "vehicle: {mass_kg: 100}\n"), HasSubstr("axles of 170 kg under a car of 100 kg"));
    // 9.81 (0.55 * 50000 - 90) / 41600 = 6.46 m; with defaults 9.81 (825 - 90) / k reaches 0.4 m at 18 026 N/m.
    EXPECT_THAT(
        refusal(minimal + "vehicle: {mass_kg: 50000}\n"),
        HasSubstr("drive.yaml:7:20: vehicle.mass_kg: front springs of 41600 N/m, which the car's 50000 kg press together by 6.5 m at "
                  "rest, expected at most 0.4 m"));
    EXPECT_THAT(refusal(minimal + "vehicle: {front: {spring_n_per_m: 18000}}\n"), HasSubstr("vehicle.front: front springs of 18000 N/m"));
    EXPECT_EQ(refusal(minimal + "vehicle: {front: {spring_n_per_m: 18050}}\n"), "not refused");
    EXPECT_THAT(refusal(minimal + "vehicle: {front_load: 0.5, rear: {spring_n_per_m: 1e3}}\n"), HasSubstr("vehicle.rear: rear springs"));
    EXPECT_THAT(refusal(minimal + "vehicle: {solver: euler}\n"), HasSubstr("vehicle.solver"));
    EXPECT_THAT(refusal(minimal + "vehicle: {tolerance: 0}\n"), HasSubstr("vehicle.tolerance"));
    EXPECT_THAT(refusal(minimal + "vehicle: {road_steps: [{at_m: 3, height_m: 0.1}, {at_m: 3, height_m: 0.1}]}\n"),
                HasSubstr("places that ascend"));
    EXPECT_THAT(refusal(minimal + "vehicle: {load_steps: [{at_s: 3, rear_kg: 80}, {at_s: 2, rear_kg: 80}]}\n"),
                HasSubstr("at_s 2 after 3, expected times that ascend"));
    EXPECT_THAT(refusal(minimal + "vehicle: {roughness: I}\n"), HasSubstr("vehicle.roughness"));
    EXPECT_THAT(refusal(minimal + "vehicle: {roll: {axis_height_m: 0.6}}\n"),
                HasSubstr("vehicle.roll: a roll axis at 0.6 m, above the body's centre of gravity, expected axis_height_m below"));
    // A body at (1500 * 3 - 170 * 0.31) / 1330 - 0.1 = 3.24 m above the axis: 42.3 kNm/rad.
    EXPECT_THAT(refusal(minimal + "vehicle: {centre_of_gravity_height_m: 3, roll: {front_bar_nm_per_rad: 0, rear_bar_nm_per_rad: 0, "
                                  "track_m: 1.2}}\n"),
                testing::AllOf(HasSubstr("while the leaning body's weight pulls with 4.23e+04, expected a car that does not fall over")));
    EXPECT_THAT(refusal(minimal + "actuators: {levelling: dynamic}\n"), HasSubstr("actuators in a drive without a vehicle"));
    EXPECT_THAT(refusal(minimal + "vehicle: single-track\nactuators: {levelling: {min_deg: 1}}\n"), HasSubstr("0 not outside"));
    EXPECT_THAT(refusal(minimal + "vehicle: single-track\nactuators: {lifting: dynamic}\n"), HasSubstr("actuators.lifting: unknown key"));
}

} // namespace
} // namespace fernlicht
