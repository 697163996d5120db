// The car on its road, and its lamps at a moment.
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/place_traffic.h"
#include "scenarios/models/model.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/traffic/road_user_mesh.h"
#include "scenarios/values/errors.h"
#include "tests/trial.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

constexpr double wheelbase_m = 2.7;

/// One road of 500 m with one lane, right of its reference line, 3.5 m wide.
RoadNetwork network(PlanElement plan, std::vector<Cubic> elevation = {}, std::vector<Cubic> superelevation = {}) {
    plan.length_m = 500.0;
    Lane lane{.id = -1, .widths = {{0.0, 3.5, 0.0, 0.0, 0.0}}};
    LaneSection section{.end_m = 500.0, .lanes = {Lane{}, lane}};
    section.lanes[0].type = "none";
    Road road;
    road.id = "1";
    road.length_m = 500.0;
    road.plan = {plan};
    road.elevation = std::move(elevation);
    road.superelevation = std::move(superelevation);
    road.sections = {section};
    return RoadNetwork{.roads = {road}};
}

PlanElement straight() { return {}; }
PlanElement bend(double radius_m) { return {.shape = Arc{1.0 / radius_m}}; }

double pitch_rad(const Pose& pose) { return std::atan2(pose.forward().z, std::hypot(pose.forward().x, pose.forward().y)); }
double roll_rad(const Pose& pose) { return std::atan2(pose.left().z, pose.up().z); }

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(EgoPose, GradeIsPitchAndBankIsRoll) {
    for (const auto& [grade, bank] : {std::pair(0.0, 0.0), std::pair(0.06, 0.0), std::pair(0.0, 0.05)}) {
        const RoadNetwork roads = network(straight(), {{0.0, 0.0, grade, 0.0, 0.0}}, {{0.0, bank, 0.0, 0.0, 0.0}});
        const Pose ego = ego_pose(Route(roads, {}), 100.0, wheelbase_m);
        EXPECT_NEAR(pitch_rad(ego), std::atan(grade), 1e-9);
        EXPECT_NEAR(roll_rad(ego), bank, 1e-9);
        EXPECT_NEAR(std::atan2(ego.forward().y, ego.forward().x), 0.0, 1e-12);
    }
    const RoadNetwork flat = network(straight());
    expect_near(ego_pose(Route(flat, {}), 100.0, wheelbase_m).position_m, {100.0, -1.75, 0.0}, 1e-9);
}

/// Distance along the route, which runs over hill and dale, at which the road's own s is reached.
double distance_at(const Route& route, double s_m) {
    double before = 0.0, after = route.length_m();
    for (int i = 0; i < 60; ++i)
        (route.place((before + after) / 2.0).second < s_m ? before : after) = (before + after) / 2.0;
    return before;
}

TEST(EgoPose, OverACrestBothAxlesDecide) {
    // z = -0.005 (s - 100)^2: with one axle on each side of the top, equally far, the car is level though the rear stands on a slope.
    const RoadNetwork roads = network(straight(), {{0.0, -0.5, 0.0, 0.0, 0.0}, {90.0, -0.5, 0.1, -0.005, 0.0}});
    const Route route(roads, {});
    const double half_m = wheelbase_m / 2.0;
    EXPECT_NEAR(pitch_rad(ego_pose(route, distance_at(route, 100.0 - half_m), wheelbase_m)), 0.0, 1e-5);
    EXPECT_NEAR(pitch_rad(route.pose(distance_at(route, 100.0 - half_m))), std::atan(0.01 * half_m), 1e-6);
    // Of a parabola the chord's slope is that in its middle. The wheelbase lies along the slope: 2 mm shorter seen from above.
    EXPECT_NEAR(pitch_rad(ego_pose(route, distance_at(route, 103.0), wheelbase_m)), std::atan(-0.01 * (3.0 + half_m)), 3e-5);
}

TEST(EgoPose, HeadingIsTheLanesAtTheRearAxle) {
    const RoadNetwork roads = network(bend(150.0));
    const Route route(roads, {});
    const Pose ego = ego_pose(route, 200.0, wheelbase_m);
    expect_near(ego.forward(), route.pose(200.0).forward(), 1e-9);
    expect_near(ego.position_m, route.pose(200.0).position_m, 1e-12);
    expect_near(ego.up(), {0.0, 0.0, 1.0}, 1e-9);
}

TEST(EgoPose, IsAFrameEverywhereAndContinuousToTheEnd) {
    const RoadNetwork roads = network(bend(-60.0), {{0.0, 0.0, 0.01, 1e-4, -1e-6}}, {{0.0, 0.0, 1e-4, 0.0, 0.0}});
    const Route route(roads, {});
    Pose before = ego_pose(route, 0.0, wheelbase_m);
    for (double s = 0.05; s <= route.length_m(); s += 0.05) {
        const Pose ego = ego_pose(route, s, wheelbase_m);
        const glm::dmat3 product = glm::transpose(ego.axes) * ego.axes;
        for (int i = 0; i < 3; ++i)
            expect_near(product[i], glm::dmat3(1.0)[i], 1e-12);
        EXPECT_GT(glm::dot(glm::cross(ego.forward(), ego.left()), ego.up()), 0.999) << s;
        EXPECT_LT(glm::length(ego.forward() - before.forward()), 0.05 / 60.0 * 1.5 + 5e-4) << s;
        before = ego;
    }
}

struct MomentTest : testing::Test {
    MomentTest() {
        drive.speed = {{0.0, 10.0}};
        drive.step_s = 1.0 / 30.0;
        drive.duration_s = 10.0;
        drive.daylight = {"moon", 0.2};
        MountedLamp lamp{
            .name = "left", .file = std::make_shared<const LampFile>(), .position_m = {3.4, 0.6, 0.65}, .pitch_rad = radians(-1.0)};
        lamp_set.lamps = {lamp, lamp};
        lamp_set.lamps[1].name = "right";
        lamp_set.lamps[1].position_m.y = -0.6;
    }
    Moment at(int tick) {
        return moment_at({tick, tick * drive.step_s, distance_m(drive.speed, tick * drive.step_s), 10.0}, drive, route, lamp_set);
    }

    RoadNetwork roads = network(straight(), {{0.0, 0.0, 0.02, 0.0, 0.0}});
    Route route{roads, {}};
    Drive drive;
    LampSet lamp_set{"v", {}, {}};
};

TEST_F(MomentTest, LampsRideOnTheCar) {
    const Moment moment = at(60);
    EXPECT_EQ(moment.tick, 60);
    EXPECT_DOUBLE_EQ(moment.distance_m, 20.0);
    EXPECT_EQ(moment.daylight.name, "moon");
    ASSERT_EQ(moment.lamps.size(), 2U);
    expect_near(to_local(moment.ego, moment.lamps[0].pose.position_m), {3.4, 0.6, 0.65}, 1e-12);
    expect_near(to_local(moment.ego, moment.lamps[1].pose.position_m), {3.4, -0.6, 0.65}, 1e-12);
    EXPECT_NEAR(pitch_rad(moment.lamps[0].pose), std::atan(0.02) + radians(-1.0), 1e-9);
    EXPECT_EQ(moment.lamps[0].intensity_factor, 1.0);
}

TEST_F(MomentTest, ChangesHoldFromTheirMomentOn) {
    const auto other = std::make_shared<const LampFile>();
    for (int second = 1; second <= 9; ++second) {
        LampChange dip{static_cast<double>(second), "left", second * 0.1, {}, {}, {}, nullptr, {}, {}};
        if (second == 5)
            dip.file = other;
        if (second == 6)
            dip.pitch_rad = radians(-2.0);
        lamp_set.changes.push_back(dip);
    }
    for (int second = 1; second <= 9; ++second) {
        // On the tick itself: 30 * second * (1 / 30) s may lie a rounding error before the second.
        EXPECT_DOUBLE_EQ(at(30 * second).lamps[0].intensity_factor, second * 0.1) << second;
        EXPECT_DOUBLE_EQ(at(30 * second - 1).lamps[0].intensity_factor, second == 1 ? 1.0 : (second - 1) * 0.1) << second;
        EXPECT_EQ(at(30 * second).lamps[1].intensity_factor, 1.0) << "the right lamp was not named";
    }
    EXPECT_EQ(at(149).lamps[0].file, lamp_set.lamps[0].file);
    EXPECT_EQ(at(150).lamps[0].file, other);
    EXPECT_NEAR(pitch_rad(at(179).lamps[0].pose), std::atan(0.02) + radians(-1.0), 1e-9);
    EXPECT_NEAR(pitch_rad(at(299).lamps[0].pose), std::atan(0.02) + radians(-2.0), 1e-9);
}

TEST_F(MomentTest, AShortRouteCutsTheDriveAndBeyondItsEndIsRefused) {
    drive.duration_s = 100.0;
    drive.bumper_m = 3.6;
    fit_to_route(drive, route);
    const double last_m = distance_m(drive.speed, (tick_count(drive) - 1) * drive.step_s);
    EXPECT_LE(last_m + drive.bumper_m, route.length_m());
    EXPECT_GT(last_m + drive.bumper_m + 10.0 * drive.step_s, route.length_m());
    ASSERT_EQ(drive.notes.size(), 1U);
    EXPECT_THAT(drive.notes[0], HasSubstr("instead of 100 s"));
    const Drive once = drive;
    fit_to_route(drive, route);
    EXPECT_EQ(drive.duration_s, once.duration_s) << "a drive that fits is left alone";
    EXPECT_EQ(drive.notes.size(), 1U);
    drive.bumper_m = 501.0;
    EXPECT_THROW(fit_to_route(drive, route), InputError);
}

// Time and distance of a drive: exact, and a function of the tick alone.

Drive with_speed(std::vector<SpeedPoint> profile, double step_s, double duration_s) {
    Drive drive;
    drive.speed = std::move(profile);
    drive.step_s = step_s;
    drive.duration_s = duration_s;
    return drive;
}

TEST(Advance, ConstantSpeedWithoutDriftInTicksThatFillTheDuration) {
    const Drive drive = with_speed({{0.0, 20.0}}, 0.5, 10.0);
    State state = start(drive);
    EXPECT_EQ(state, (State{0, 0.0, 0.0, 20.0}));
    for (int i = 0; i < 7; ++i)
        state = advance(state, drive);
    EXPECT_EQ(state, (State{7, 3.5, 70.0, 20.0}));
    const Drive other_drive = with_speed({{0.0, 30.0}}, 1.0 / 30.0, 1.0e5);
    State other_state = start(other_drive);
    for (int i = 0; i < 1'000'000; ++i)
        other_state = advance(other_state, other_drive);
    EXPECT_NEAR(other_state.distance_m, 1.0e6, 1e-9) << "adding up 1/30 s gives an error a million times larger";
    EXPECT_EQ(other_state, advance({999'999, 0.0, 0.0, 0.0}, other_drive)) << "only the tick counts";
    EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 1.0 / 30.0, 12.0)), 360);
    EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 0.1, 0.3)), 3) << "0.3 / 0.1 is 2.9999999999999996";
    EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 0.1, 0.31)), 4);
    EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 1.0, 0.1)), 1);
    for (const int rate : {7, 24, 25, 29, 30, 50, 60, 90, 120})
        for (const int seconds : {1, 3, 10, 3600})
            EXPECT_EQ(tick_count(with_speed({{0.0, 1.0}}, 1.0 / rate, seconds)), rate * seconds) << rate << " Hz, " << seconds << " s";
}

TEST(Advance, DistanceIsTheIntegralOfThePiecewiseLinearSpeed) {
    // 10 m/s until 1 s, up to 20 m/s at 3 s, down to a stop at 8 s: 10 + 30 + 50 = 90 m.
    const std::vector<SpeedPoint> profile{{1.0, 10.0}, {3.0, 20.0}, {8.0, 0.0}};
    EXPECT_EQ(distance_m(profile, 0.0), 0.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 0.5), 5.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 1.0), 10.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 2.0), 10.0 + 12.5);
    EXPECT_DOUBLE_EQ(distance_m(profile, 3.0), 40.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 8.0), 90.0);
    EXPECT_DOUBLE_EQ(distance_m(profile, 100.0), 90.0) << "stands after the last point";
    EXPECT_DOUBLE_EQ(speed_mps(profile, 0.2), 10.0);
    EXPECT_DOUBLE_EQ(speed_mps(profile, 5.5), 10.0);
    EXPECT_DOUBLE_EQ(speed_mps(profile, 9.0), 0.0);
    double sum = 0.0;
    constexpr double dt = 1.0e-4;
    for (int i = 0; i < 60'000; ++i)
        sum += dt * speed_mps(profile, (i + 0.5) * dt);
    EXPECT_NEAR(sum, distance_m(profile, 6.0), 1e-9);
}

// Rows of a drive file as road users on the road: the shipped straight, 3.5 m wide lanes.

class PlacedTraffic : public testing::Test {
  protected:
    Drive read(const std::string& traffic) {
        return read_drive(tests::written("traffic.yaml", "fernlicht: 1\nroad: " FERNLICHT_SOURCE_DIR
                                                         "/scenarios/library/roads/straight.xodr\nspeed_mps: 20\nduration_s: 4\n"
                                                         "lamp_sets: {one: {file: " +
                                                             std::string(lamp) + "}}\n" + traffic));
    }
    Moment moment(Drive& drive, double time_s) {
        const RoadNetwork network = read_opendrive(drive.road_file);
        const Route route(network, drive.start, drive.via);
        drive.traffic.clear();
        place_traffic(drive, network, route);
        return moment_at({0, time_s, distance_m(drive.speed, time_s), 20.0}, drive, route, drive.lamp_sets[0]);
    }
    std::string row(const std::string& keys) { return "traffic: {other: {file: " + std::string(lamp) + ", " + keys + "}}\n"; }

    static constexpr const char* lamp = FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/halogen-low.ies";
};

TEST_F(PlacedTraffic, OncomingCarsComeOnTheOtherLaneAndShineBack) {
    Drive drive = read(row("oncoming: {gap_m: 150}, speed_mps: 10, tail_cd: 0, brake_cd: 0"));
    const Moment now = moment(drive, 2.0);
    ASSERT_EQ(now.bodies.size(), 1U);
    const glm::dvec3 at = to_local(now.ego, now.bodies[0].pose.position_m);
    EXPECT_NEAR(at.x, 150.0 - 40.0 - 20.0, 0.01);
    EXPECT_NEAR(at.y, 3.5, 0.3);
    EXPECT_NEAR(glm::dot(now.bodies[0].pose.forward(), now.ego.forward()), -1.0, 1e-6);
    ASSERT_EQ(now.other_lamps.size(), 2U);
    for (const LitLamp& shining : now.other_lamps) {
        EXPECT_EQ(shining.body, 0);
        EXPECT_NEAR(to_local(now.ego, shining.pose.position_m).x, at.x - 3.62, 0.02);
        EXPECT_LT(glm::dot(shining.pose.forward(), now.ego.forward()), -0.99);
    }
    EXPECT_EQ(now.lamps.size(), 2U) << "the own lamps stay apart";
}

TEST_F(PlacedTraffic, ARowGoesAheadAndBrakesInRed) {
    Drive drive = read(row("ahead: {gap_m: 30}, speed: [{at_s: 0, speed_mps: 20}, {at_s: 1, speed_mps: 20}, {at_s: 2, speed_mps: 15}], "
                           "repeat: {count: 3, every_m: 20}"));
    const Moment before = moment(drive, 0.0), braking = moment(drive, 1.5), after = moment(drive, 2.5);
    ASSERT_EQ(before.bodies.size(), 3U);
    EXPECT_NEAR(to_local(before.ego, before.bodies[2].pose.position_m).x, 70.0, 0.01);
    EXPECT_EQ(before.other_lamps.size(), 3U * 4U);
    EXPECT_EQ(braking.other_lamps.size(), 3U * 6U);
    EXPECT_EQ(after.other_lamps.size(), 3U * 4U);
}

TEST_F(PlacedTraffic, WhoLeavesTheRoadIsGoneAndNobodyHasNoPlace) {
    Drive drive = read(row("oncoming: {gap_m: 20}, speed_mps: 40"));
    EXPECT_TRUE(moment(drive, 0.0).bodies[0].visible);
    const Moment later = moment(drive, 3.0);
    EXPECT_FALSE(later.bodies[0].visible);
    EXPECT_TRUE(later.other_lamps.empty());
    Drive far = read(row("oncoming: {gap_m: 90000}, speed_mps: 10"));
    EXPECT_THROW(moment(far, 0.0), InputError);
    EXPECT_THROW(read(row("speed_mps: 10")), InputError);
    EXPECT_THROW(read(row("oncoming: {gap_m: 10}, ahead: {gap_m: 3}, speed_mps: 10")), InputError);
    EXPECT_THROW(read(row("oncoming: {gap_m: 10}, speed_mps: 10, colour_of_car: red")), InputError);
}

TEST_F(PlacedTraffic, AResolvedDriveReadsBackToTheSameTraffic) {
    const Drive drive = read("traffic_light: {min_lx: 0.05}\n" +
                             row("kind: van, size_m: [5, 1.9, 2], oncoming: {gap_m: 33.3}, speed_mps: 7, changes: [{at_s: 1, level: 0.3}], "
                                 "face_m: [0.2, 0.1], tail_cd: 5, brake_cd: 70, repeat: {count: 2, every_m: 11}") +
                             "");
    const std::string written = write_drive(drive);
    EXPECT_EQ(write_drive(read_drive(tests::written("again.yaml", written))), written);
    EXPECT_THAT(written, testing::HasSubstr("min_lx: 0.05"));
    EXPECT_EQ(write_drive(read("")).find("traffic:"), std::string::npos) << "a drive without traffic says nothing of it";
}

TEST_F(PlacedTraffic, PedestriansCarryNoLampsUnlessTheirRowGivesThem) {
    const auto lamps_of = [&](const std::string& keys) {
        Drive drive = read("traffic: {other: {ahead: {gap_m: 30}, speed_mps: 20, " + keys + "}}\n");
        const std::string written = write_drive(drive);
        EXPECT_EQ(write_drive(read_drive(tests::written("again.yaml", written))), written) << keys;
        moment(drive, 0.0);
        return drive.traffic.front().lamps.size();
    };
    EXPECT_EQ(lamps_of("kind: car"), 4U);
    EXPECT_EQ(lamps_of("kind: pedestrian"), 0U);
    EXPECT_GT(lamps_of("kind: pedestrian, tail_cd: 6"), 0U);
    EXPECT_EQ(lamps_of("kind: bicycle"), lamps_of("kind: bicycle, brake_cd: 0"));
    EXPECT_LT(lamps_of("kind: bicycle"), lamps_of("kind: bicycle, brake_cd: 80"));
}

TEST_F(PlacedTraffic, EachHasABodyInItsOwnFrame) {
    Drive drive = read(row("ahead: {gap_m: 30}, speed_mps: 20, repeat: {count: 2, every_m: 20}"));
    moment(drive, 0.0);
    Scene scene;
    FilesRead opened;
    add_road_users(scene, drive.traffic, opened);
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.meshes[1].body, 1);
    glm::dvec3 low(1e9), high(-1e9);
    for (const Vertex& vertex : scene.meshes[0].vertices) {
        low = glm::min(low, glm::dvec3(vertex.position_m) + scene.meshes[0].origin_m);
        high = glm::max(high, glm::dvec3(vertex.position_m) + scene.meshes[0].origin_m);
    }
    EXPECT_NEAR(high.x - low.x, 4.5, 0.02);
    EXPECT_NEAR(high.y - low.y, 1.8, 0.02);
    EXPECT_NEAR(high.z, 1.45, 0.01);
    EXPECT_NEAR(low.z, 0.0, 0.01);
}

TEST_F(PlacedTraffic, AModelBringsItsMeshAndItsMounts) {
    const Model car = car_body({{4.2, 1.7, 1.5}, -0.8, glm::vec3(0.3F)});
    const std::filesystem::path model = tests::new_folder() / "car.glb";
    write_file(model, glb_of(car));
    Drive drive = read(row("model: " + model.string() + ", ahead: {gap_m: 30}, speed_mps: 20"));
    moment(drive, 0.0);
    Scene scene;
    FilesRead opened;
    add_road_users(scene, drive.traffic, opened);
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.meshes[0].indices.size() / 3, car.triangles());
    EXPECT_EQ(opened.size(), 1U);
    for (const TrafficLamp& mounted : drive.traffic.at(0).lamps)
        for (const Mount& mount : car.mounts)
            if (mounted.function == LampFunction::low && mount.name == "lamp.low." + mounted.lamp.name) {
                EXPECT_LT(glm::length(mounted.lamp.position_m - mount.pose.position_m), 1e-5) << mount.name;
            }
    EXPECT_NE(write_drive(drive).find(model.string()), std::string::npos);
    std::filesystem::remove(model);
    EXPECT_THROW(read(row("model: absent.glb, ahead: {gap_m: 30}, speed_mps: 20")), InputError);
}

} // namespace
} // namespace fernlicht
