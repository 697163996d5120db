#include "scenarios/models/free_way.h"

#include "scenarios/models/triangle_soup.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// A street of 8 m between rows of houses, 120 m along y at x from 0 to 8, houses 10 m deep on both sides; what lies under the houses is
/// ground too. A van stands across it, 75 m from its beginning.
Scene street_with_van(const std::string& ground = "ground") {
    Model model;
    model.materials = {{.name = ground}, {.name = "wall"}, {.name = "roof"}};
    TriangleSoup soup;
    append_box(soup, {-10, 0, -1}, {18, 120, 0}, 0);
    append_box(soup, {-10, 0, 0}, {0, 120, 6}, 1);
    append_box(soup, {8, 0, 0}, {18, 120, 6}, 1);
    append_box(soup, {1, 75, 0.2}, {7, 77, 2.4}, 1);
    append_box(soup, {0, 100, 4}, {8, 120, 5}, 2); // a bridge between the houses, above what a car takes
    add_meshes(model, soup);
    Scene scene;
    add_model(scene, model, {}, 1.0, SurfaceKind::object);
    return scene;
}

TEST(FreeWay, ACarComesAsFarAsTheNextThingInItsWay) {
    const SceneGround ground(street_with_van());
    EXPECT_DOUBLE_EQ(ground.height_m(4.0, 50.0).value(), 0.0);
    EXPECT_DOUBLE_EQ(ground.height_m(4.0, 110.0).value(), 0.0) << "the street, not the bridge";
    EXPECT_FALSE(ground.height_m(30.0, 50.0));
    EXPECT_NEAR(ground.free_way_m(4.0, 10.0, 0.5 * pi), 65.0, 1.0) << "to the van";
    EXPECT_NEAR(ground.free_way_m(4.0, 90.0, 0.5 * pi), 30.0, 1.0) << "under the bridge, to the edge";
    EXPECT_NEAR(ground.free_way_m(4.0, 60.0, 0.0), 4.0, 1.0) << "to the wall";
    EXPECT_EQ(ground.free_way_m(7.5, 60.0, 0.5 * pi), 0.0) << "half a metre from a wall there is no room";
}

TEST(FreeWay, TheLongestWayLiesAlongTheStreet) {
    const SceneGround ground(street_with_van());
    const std::optional<Pose> car = ground.longest_free_way();
    ASSERT_TRUE(car);
    EXPECT_GT(std::abs(car->forward().y), 0.99);
    EXPECT_GT(ground.free_way_m(car->position_m.x, car->position_m.y, std::atan2(car->forward().y, car->forward().x)), 70.0);
    EXPECT_LT(car->position_m.y, 77.0);
}

TEST(FreeWay, GroundStandsInMapsAndHousesDoNot) {
    Scene scene = street_with_van();
    const SceneGround ground(scene);
    ground.mark_ground(scene);
    std::size_t ground_triangles = 0, others = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const Batch& batch : mesh.batches)
            (scene.materials[batch.material].kind == SurfaceKind::terrain ? ground_triangles : others) += batch.count / 3;
    EXPECT_EQ(ground_triangles, 2U) << "the upper face of the ground";
    EXPECT_EQ(others, 5U * 12U - 2U);
}

TEST(FreeWay, ACarStandsOnASlopeAsItIs) {
    Scene scene;
    Mesh mesh;
    for (const glm::vec3& p : {glm::vec3(0, 0, 0), glm::vec3(100, 0, 10), glm::vec3(100, 100, 10), glm::vec3(0, 100, 0)})
        mesh.vertices.push_back({p, {0, 0, 1}});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.batches = {{0, 0, 6}};
    scene.meshes = {mesh};
    scene.materials = {{.name = "Main Street"}};
    const SceneGround ground(scene);
    const Pose car = ground.car_at(50.0, 50.0, 0.0).value();
    EXPECT_NEAR(car.position_m.z, 5.0, 0.05) << "half a cell of 0.5 m";
    EXPECT_NEAR(car.forward().z / car.forward().x, 0.1, 0.02);
    EXPECT_GT(ground.free_way_m(5.0, 50.0, 0.0), 90.0);
}

TEST(FreeWay, NowhereToStand) {
    EXPECT_FALSE(SceneGround(Scene{}).longest_free_way());
    EXPECT_FALSE(SceneGround(Scene{}).height_m(0.0, 0.0));
}

} // namespace
} // namespace fernlicht
