// Rows of lamps along the route: where they hang, where they shine, and how much.
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/place_street_lamps.h"
#include "scenarios/light/light.h"
#include "scenarios/values/errors.h"
#include "tests/shipped.h"
#include "tests/trial.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <stdexcept>

namespace fernlicht {
namespace {

/// Our street lamp, on a row of its own or on these objects.
StreetLampRow row_of(const std::string& name, const std::vector<std::string>& on_objects = {}) {
    StreetLampRow row;
    row.name = name;
    row.file = std::make_shared<LampFile>(read_lamp(shipped_library / "lamps/street-6000lm.ies", {.type_c_axis = TypeCAxis::nadir}));
    row.on_objects = on_objects;
    return row;
}

/// The straight, with our street lamp to the right of it.
struct LitStraight {
    RoadNetwork network = read_opendrive(shipped_library / "roads/straight.xodr");
    Route route{network, {}, {}};
    Drive drive;
    Moment moment;

    explicit LitStraight(double beside_m = -4.0) {
        StreetLampRow row = row_of("row");
        row.first_m = 10.0;
        row.last_m = 320.0;
        row.beside_m = beside_m;
        drive.street_lamps = {row};
        moment.distance_m = 100.0;
        add_street_lamps(drive, route, 200.0, moment);
    }
};

TEST(StreetLamps, StandEveryThirtyMetresWithTheirAxisDown) {
    const LitStraight lit;
    ASSERT_EQ(lit.moment.other_lamps.size(), 10U); // 10, 40 .. 280 m of 10 .. 310, those within 200 m of 100
    const LitLamp& first = lit.moment.other_lamps[0];
    EXPECT_EQ(first.body, -2);
    const Pose lane = lit.route.pose(10.0, -4.0);
    EXPECT_NEAR(first.pose.position_m.z - lane.position_m.z, 8.0, 1e-9);
    EXPECT_NEAR(glm::dot(first.pose.position_m - lane.position_m, lane.left()), 1.0, 1e-9) << "an arm of 1 m towards the lane";
    /// Down, C 0 (lamp space's right) along the road, C 90 (its up) towards the lane, from either side.
    for (const double beside_m : {-4.0, 6.0}) {
        const LitStraight beside(beside_m);
        const Pose& pose = beside.moment.other_lamps[0].pose;
        const Pose along = beside.route.pose(10.0, 0.0);
        EXPECT_NEAR(pose.forward().z, -1.0, 1e-12);
        EXPECT_NEAR(std::abs(glm::dot(pose.left(), along.forward())), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(pose.up(), along.left()) * beside_m, -std::abs(beside_m), 1e-9);
        EXPECT_NEAR(glm::dot(glm::cross(pose.forward(), pose.left()), pose.up()), 1.0, 1e-12);
    }
}

/// 6000 lm, by its own sum; below it 1349.5 cd / 64 m2 = 21 lx, where street lamps are said to give 20; more to the lane than behind.
TEST(StreetLamps, GiveTheRoadItsTwentyLux) {
    const LitStraight lit;
    LitLamp lamp = lit.moment.other_lamps[0];
    Moment alone{.lamps = {lamp}};
    const glm::dvec3 below = lamp.pose.position_m - glm::dvec3(0.0, 0.0, 8.0), across = lamp.pose.up();
    EXPECT_NEAR(surface_illuminance_lx(alone, below, {0.0, 0.0, 1.0}), 1349.5 / 64.0, 0.01);
    EXPECT_GT(surface_illuminance_lx(alone, below + 8.0 * across, {0.0, 0.0, 1.0}),
              1.4 * surface_illuminance_lx(alone, below - 8.0 * across, {0.0, 0.0, 1.0}));
    double flux = 0.0;
    constexpr int n = 180, m = 360;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < m; ++k) {
            const double down = radians(90.0 * (i + 0.5) / n), turn = radians(360.0 * (k + 0.5) / m);
            const glm::dvec3 direction =
                lamp.pose.axes * glm::dvec3(std::cos(down), std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn));
            flux += intensity_towards_cd(lamp, lamp.pose.position_m + direction) * std::sin(down) * radians(90.0 / n) * radians(360.0 / m);
        }
    EXPECT_NEAR(flux, 6000.0, 60.0);
}

TEST(StreetLamps, HavePoles) {
    const LitStraight lit;
    Scene scene;
    add_street_lamp_poles(lit.drive, lit.route, scene);
    ASSERT_EQ(scene.meshes.size(), 11U);
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_EQ(mesh.indices.size(), 3U * 36U);
        for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) { // counter-clockwise triangles face their normals
            const Vertex &a = mesh.vertices[mesh.indices[k]], &b = mesh.vertices[mesh.indices[k + 1]],
                         &c = mesh.vertices[mesh.indices[k + 2]];
            EXPECT_GT(glm::dot(glm::cross(b.position_m - a.position_m, c.position_m - a.position_m), a.normal), 0.0F);
        }
    }
    Drive without;
    Scene empty;
    add_street_lamp_poles(without, lit.route, empty);
    EXPECT_TRUE(empty.meshes.empty() && empty.materials.empty());
}

/// Our village, with lamps on its posts.
struct LitVillage {
    RoadNetwork network = read_opendrive(shipped_library / "roads/village.xodr");
    Route route{network, {}, {}};
    Drive drive;

    explicit LitVillage(const std::string& word, double height_m = 0.0, double arm_m = 1.0) {
        StreetLampRow row = row_of("posts", {word});
        row.height_m = height_m;
        row.arm_m = arm_m;
        drive.file = "village.yaml";
        drive.road_file = "village.xodr";
        drive.street_lamps = {row};
        find_street_lamps(drive, network);
    }
    std::vector<LitLamp> around(const glm::dvec3& place_m, double within_m) const {
        Moment moment;
        moment.ego.position_m = place_m;
        add_street_lamps(drive, route, within_m, moment);
        return moment.other_lamps;
    }
};

/// Objects 170 to 178: posts of 6 m on the kerb (z offset 0.12 m), 3.7 m to the left of the reference line.
TEST(StreetLamps, HangOnThePolesOfTheRoadsFile) {
    const LitVillage lit("LAMP");
    ASSERT_EQ(lit.drive.street_lamps[0].found->size(), 9U);
    const Road& street = *lit.network.find(lit.network.roads.front().id);
    const Pose foot = surface_pose(lit.network, street, 20.0, 3.7);
    const std::vector<LitLamp> near = lit.around(foot.position_m, 1.0);
    ASSERT_EQ(near.size(), 1U);
    EXPECT_EQ(near[0].body, -2);
    EXPECT_NE(near[0].name.find("object 170 (lamp post)"), std::string::npos) << near[0].name;
    EXPECT_NEAR(near[0].pose.position_m.z - foot.position_m.z, 0.12 + 6.0 - 0.1, 1e-9);
    const glm::dvec3 arm = near[0].pose.position_m - foot.position_m;
    EXPECT_NEAR(glm::dot(arm, foot.left()), -1.0, 1e-3) << "towards the reference line";
    EXPECT_NEAR(near[0].pose.forward().z, -1.0, 1e-12);
    EXPECT_EQ(lit.around(foot.position_m, 45.0).size(), 2U); // the next stands 40 m on
    EXPECT_GE(LitVillage("Pole").drive.street_lamps[0].found->size(), 9U) << "by type";
    EXPECT_NEAR(LitVillage("lamp", 7.5).around(foot.position_m, 1.0).at(0).pose.position_m.z - foot.position_m.z, 0.12 + 7.5, 1e-9);
}

/// Arm and head, and only where the lamp hangs higher than the post a pole of its own; without arm the lamp stands on the post.
TEST(StreetLamps, OnPolesOfTheRoadAddWhatIsMissing) {
    const auto indices = [](const LitVillage& lit) {
        Scene scene;
        add_street_lamp_poles(lit.drive, lit.route, scene);
        EXPECT_EQ(scene.meshes.size(), 9U);
        return scene.meshes.front().indices.size();
    };
    EXPECT_EQ(indices(LitVillage("lamp post")), 2U * 36U);
    EXPECT_EQ(indices(LitVillage("lamp post", 7.5)), 3U * 36U);
    const LitVillage on_top("lamp post", 0.0, 0.0);
    EXPECT_EQ(indices(on_top), 36U);
    EXPECT_GT(on_top.drive.street_lamps[0].found->front().height_m, 6.0);
}

/// A lamp without arm must not stand in its own pole, which would take all of its light.
TEST(StreetLamps, StandBesideTheirPoleAndSayWhatStandsThere) {
    LitStraight lit;
    lit.drive.street_lamps[0].arm_m = 0.0;
    Scene scene;
    add_street_lamp_poles(lit.drive, lit.route, scene);
    for (const Mesh& mesh : scene.meshes)
        for (const Vertex& vertex : mesh.vertices)
            EXPECT_GT(std::abs(static_cast<double>(vertex.position_m.z) - 8.0), 0.015);
    const std::string text = tests::refusal_of([] { const LitVillage none("lantern"); });
    for (const char* part : {"village.yaml", "street_lamps.posts.on_objects", "village.xodr", "'lamp post'"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    LitVillage unknown("lamp post");
    unknown.drive.street_lamps[0].found.reset();
    EXPECT_THROW(unknown.around({}, 100.0), std::logic_error);
}

} // namespace
} // namespace fernlicht
