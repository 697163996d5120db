// Lamps at a model's mounts: where they are, where they look, on the own car and on others, turned and scaled.
#include "scenarios/drives/keys/lamp_mounts.h"

#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/place_traffic.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/models/model.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/traffic/road_user_mesh.h"
#include "tests/scenarios/drives/drive_fixture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// A car whose left low beam squints 4 degrees to the left and 1 up, and a fog lamp.
Model squinting_car() {
    Model model = car_body({});
    for (Mount& mount : model.mounts)
        if (mount.name == "lamp.low.left")
            mount.pose.axes = axes_from_angles(radians(4.0), radians(1.0), 0.0);
    model.mounts.push_back({"lamp.fog.centre", {{3.6, 0.0, 0.3}, glm::dmat3(1.0)}});
    return model;
}

class LampMounts : public DriveFixture {
  protected:
    LampMounts() { write_file(folder / "car.glb", glb_of(squinting_car(), {})); }
};

double deg_left(const Pose& pose) { return degrees(std::atan2(pose.forward().y, pose.forward().x)); }
double deg_up(const Pose& pose) { return degrees(std::asin(pose.forward().z)); }

TEST(Turn, AnglesGiveTheAxesBack) {
    for (const auto& [yaw, pitch, roll] : {std::array{0.0, 0.0, 0.0}, {0.1, -0.02, 0.3}, {3.1, 0.4, -2.0}, {-1.5, -1.2, 0.0}}) {
        const Turn turn = turn_of(axes_from_angles(yaw, pitch, roll));
        EXPECT_NEAR(turn.yaw_rad, yaw, 1e-12);
        EXPECT_NEAR(turn.pitch_rad, pitch, 1e-12);
        EXPECT_NEAR(turn.roll_rad, roll, 1e-12);
    }
    for (const double pitch : {0.5 * pi, -0.5 * pi}) { // straight up and down
        const glm::dmat3 axes = axes_from_angles(0.7, pitch, 0.2), again = turn_of(axes).axes();
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(glm::length(axes[k] - again[k]), 1e-8) << pitch;
    }
}

TEST_F(LampMounts, OfTheOwnCarTurnItsLampsAndAimsAddToThem) {
    const Drive drive = read(minimal + "  two: {file: low.ies, aim: {pitch_deg: -0.5, yaw_deg: 1}}\ncar: {model: car.glb}\n");
    ASSERT_EQ(drive.lamp_sets[0].lamps.size(), 2U) << "one for each low beam";
    const MountedLamp& left = drive.lamp_sets[0].lamps[0];
    EXPECT_EQ(left.name, "left");
    EXPECT_NEAR(deg_left(left.pose()), 4.0, 1e-5);
    EXPECT_NEAR(deg_up(left.pose()), 1.0, 1e-5);
    EXPECT_NEAR(deg_left(drive.lamp_sets[0].lamps[1].pose()), 0.0, 1e-9);
    EXPECT_NEAR(deg_left(drive.lamp_sets[1].lamps[0].pose()), 5.0, 1e-3);
    EXPECT_NEAR(deg_up(drive.lamp_sets[1].lamps[0].pose()), 0.5, 1e-3);
    EXPECT_NEAR(left.position_m.x, 3.604, 1e-5);
    EXPECT_NEAR(drive.bumper_m, 3.61, 0.02) << "where the model ends";
    EXPECT_TRUE(std::ranges::any_of(drive.opened, [&](const FileRead& file) { return file.path == folder / "car.glb"; }));
    const std::string written = write_drive(drive);
    const Drive again = read(written);
    EXPECT_EQ(write_drive(again), written);
    EXPECT_EQ(again.lamp_sets[1].lamps[0].pose(), drive.lamp_sets[1].lamps[0].pose()) << "to the bit";
}

TEST_F(LampMounts, CanBeNamedAndReplacedInTheDrive) {
    const Drive drive =
        read("fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\ncar: {model: car.glb, bumper_x_m: 3.5, mounts: {left: "
             "{position_m: [3.3, 0.7, 0.6], yaw_deg: -2}}}\nlamp_sets: {one: {lamps: {left: low.ies, fog-centre: low.ies, spare: "
             "{file: low.ies, position_m: [3, 0, 1], mount_turn: {roll_deg: 10}}}}}\n");
    const std::vector<MountedLamp>& lamps = drive.lamp_sets[0].lamps;
    EXPECT_EQ(drive.bumper_m, 3.5);
    EXPECT_NEAR(deg_left(lamps[0].pose()), -2.0, 1e-9);
    EXPECT_EQ(lamps[0].position_m.x, 3.3);
    EXPECT_NEAR(lamps[1].position_m.z, 0.3, 1e-6);
    EXPECT_NEAR(lamps[2].pose().left().z, std::sin(radians(10.0)), 1e-12);
    const std::string start = minimal + "car: ";
    EXPECT_THAT(refusal(start + "{yaw_deg: 3}\n"), HasSubstr("expected model beside it"));
    EXPECT_THAT(refusal(start + "{model: none.glb}\n"), HasSubstr("there is no file"));
    EXPECT_THAT(refusal("fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\ncar: {lamps: {left: {file: low.ies, mount_turn: "
                        "{yaw_deg: 1}}}}\n"),
                HasSubstr("mount_turn without position_m"));
}

TEST_F(LampMounts, OfOthersTurnAndScaleWithTheirModel) {
    const std::string road = FERNLICHT_SOURCE_DIR "/scenarios/library/roads/straight.xodr";
    Drive drive = read("fernlicht: 1\nroad: " + road +
                       "\nspeed_kmh: 72\nduration_s: 3\nlamp_sets: {one: {file: low.ies}}\n"
                       "traffic: {other: {model: car.glb, yaw_deg: 180, scale: 2, ahead: {gap_m: 40}, speed_mps: 0, file: low.ies, "
                       "tail_cd: 5}}\n");
    const std::string written = write_drive(drive);
    EXPECT_EQ(write_drive(read(written)), written);
    const RoadNetwork network = read_opendrive(drive.road_file);
    const Route route(network, drive.start, drive.via);
    place_traffic(drive, network, route);
    ASSERT_EQ(drive.traffic.size(), 1U);
    const RoadUser& other = drive.traffic[0];
    EXPECT_NEAR(other.size_m.x, 2.0 * 4.508, 0.05);
    EXPECT_NEAR(other.rear_m, -7.21, 0.03) << "turned round, its front is behind";
    ASSERT_EQ(other.lamps.size(), 6U);
    EXPECT_NEAR(other.lamps[0].lamp.position_m.x, -2.0 * 3.604, 1e-4);
    EXPECT_NEAR(std::abs(deg_left(other.lamps[0].lamp.pose())), 176.0, 1e-4) << "looks back, and squints";
    for (std::size_t i = 2; i < 6; ++i) { // tail and brake lamps at the model's, which now look forward
        EXPECT_GT(other.lamps[i].lamp.position_m.x, 0.0);
        EXPECT_NEAR(other.lamps[i].lamp.pose().forward().x, 1.0, 1e-9);
    }
    Scene scene;
    FilesRead opened;
    add_road_users(scene, drive.traffic, opened);
    double front = 0.0, rear = 0.0;
    for (const Mesh& mesh : scene.meshes)
        for (const Vertex& vertex : mesh.vertices) {
            front = std::max(front, mesh.origin_m.x + static_cast<double>(vertex.position_m.x));
            rear = std::min(rear, mesh.origin_m.x + static_cast<double>(vertex.position_m.x));
        }
    EXPECT_NEAR(rear, other.rear_m, 1e-4);
    EXPECT_NEAR(front - rear, other.size_m.x, 1e-4);
}

TEST_F(LampMounts, TheOwnBodyIsWhatTheDriverSeesOfIt) {
    Drive drive = read(minimal + "car: {model: car.glb}\n");
    Scene scene;
    add_own_car(scene, drive);
    ASSERT_EQ(scene.meshes.size(), 1U);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.body, 0);
    EXPECT_FALSE(mesh.casts);
    const glm::dvec3 eye = drive.views.front().position_m;
    double front = 0.0;
    for (const std::uint32_t i : mesh.indices) {
        const glm::dvec3 at = mesh.origin_m + glm::dvec3(mesh.vertices[i].position_m);
        EXPECT_LT(at.z, eye.z);
        front = std::max(front, at.x);
    }
    EXPECT_GT(mesh.indices.size(), 30U);
    EXPECT_NEAR(front, 3.6, 0.1);
    scene = {};
    drive.own_car.reset();
    add_own_car(scene, drive);
    EXPECT_TRUE(scene.meshes.empty() && scene.materials.empty());
}

} // namespace
} // namespace fernlicht
