// Rows of a drive file as road users on the road: the shipped straight, 3.5 m wide lanes.
#include "scenarios/drives/play/place_traffic.h"

#include "scenarios/drives/play/advance.h"
#include "scenarios/models/glb_writer.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/traffic/road_user_mesh.h"
#include "scenarios/values/errors.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace fernlicht {
namespace {

class PlacedTraffic : public testing::Test {
  protected:
    PlacedTraffic() : file(std::filesystem::temp_directory_path() / fmt::format("fernlicht-traffic-{}.yaml", ::getpid())) {}
    ~PlacedTraffic() override { std::filesystem::remove(file); }

    Drive read(const std::string& traffic) {
        std::ofstream(file) << "fernlicht: 1\nroad: " FERNLICHT_SOURCE_DIR "/scenarios/library/roads/straight.xodr\nspeed_mps: 20\n"
                               "duration_s: 4\nvariants: {one: {file: "
                            << lamp << "}}\n"
                            << traffic;
        return read_drive(file);
    }
    Moment moment(Drive& drive, double time_s) {
        const RoadNetwork network = read_opendrive(drive.road_file);
        const Route route(network, drive.start, drive.via);
        drive.traffic.clear();
        place_traffic(drive, network, route);
        return moment_at({0, time_s, distance_m(drive.speed, time_s), 20.0}, drive, route, drive.variants[0]);
    }
    std::string row(const std::string& keys) { return "traffic: {other: {file: " + std::string(lamp) + ", " + keys + "}}\n"; }

    static constexpr const char* lamp = FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/halogen-low.ies";
    std::filesystem::path file;
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

TEST_F(PlacedTraffic, WhoLeavesTheRoadIsGone) {
    Drive drive = read(row("oncoming: {gap_m: 20}, speed_mps: 40"));
    EXPECT_TRUE(moment(drive, 0.0).bodies[0].visible);
    const Moment later = moment(drive, 3.0);
    EXPECT_FALSE(later.bodies[0].visible);
    EXPECT_TRUE(later.other_lamps.empty());
}

TEST_F(PlacedTraffic, AResolvedDriveReadsBackToTheSameTraffic) {
    const Drive drive = read("traffic_light: {least_lx: 0.05}\n" +
                             row("kind: van, size_m: [5, 1.9, 2], oncoming: {gap_m: 33.3}, speed_mps: 7, changes: [{at_s: 1, level: 0.3}], "
                                 "face_m: [0.2, 0.1], tail_cd: 5, brake_cd: 70, repeat: {count: 2, every_m: 11}") +
                             "");
    const std::string written = write_drive(drive);
    std::ofstream(file) << written;
    EXPECT_EQ(write_drive(read_drive(file)), written);
    EXPECT_THAT(written, testing::HasSubstr("least_lx: 0.05"));
    EXPECT_EQ(write_drive(read("")).find("traffic:"), std::string::npos) << "a drive without traffic says nothing of it";
}

TEST_F(PlacedTraffic, RefusesWhatHasNoPlace) {
    Drive far = read(row("oncoming: {gap_m: 90000}, speed_mps: 10"));
    EXPECT_THROW(moment(far, 0.0), InputError);
    EXPECT_THROW(read(row("speed_mps: 10")), InputError);
    EXPECT_THROW(read(row("oncoming: {gap_m: 10}, ahead: {gap_m: 3}, speed_mps: 10")), InputError);
    EXPECT_THROW(read(row("oncoming: {gap_m: 10}, speed_mps: 10, colour_of_car: red")), InputError);
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
    const std::filesystem::path model = file.parent_path() / (file.stem().string() + ".glb");
    write_file(model, glb_of(car));
    Drive drive = read(row("model: " + model.filename().string() + ", ahead: {gap_m: 30}, speed_mps: 20"));
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
