#include "scenarios/roads/mesh/mesh_terrain.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace fernlicht {
namespace {

Scene hill() {
    Scene scene;
    scene.materials.push_back({});
    Mesh mesh{"hill", {1000.0, -200.0, 30.0}, {}, {}, {}};
    mesh.vertices = {
        {{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}}, {{50.0F, 0.0F, 4.0F}, {0.0F, 0.0F, 1.0F}}, {{0.0F, 50.0F, -2.0F}, {0.0F, 0.0F, 1.0F}}};
    mesh.indices = {0, 1, 2};
    mesh.batches = {{0, 0, 3}};
    scene.meshes.push_back(mesh);
    return scene;
}

TEST(FarGround, ReachesFartherThanAllElseAndBelowIt) {
    Scene scene = hill();
    add_far_ground(scene);
    ASSERT_GT(scene.meshes.size(), 1U);
    double west = std::numeric_limits<double>::infinity(), east = -west, area = 0.0;
    for (std::size_t i = 1; i < scene.meshes.size(); ++i) {
        const Mesh& tile = scene.meshes[i];
        EXPECT_FALSE(tile.casts);
        ASSERT_EQ(tile.indices.size(), 6U);
        EXPECT_EQ(scene.materials[tile.batches.at(0).material].kind, SurfaceKind::object) << "maps would show it";
        EXPECT_EQ(scene.materials[tile.batches.at(0).material].name, "far ground");
        for (const Vertex& vertex : tile.vertices) {
            EXPECT_NEAR(tile.origin_m.z + static_cast<double>(vertex.position_m.z), 27.5, 1e-4);
            west = std::min(west, tile.origin_m.x + static_cast<double>(vertex.position_m.x));
            east = std::max(east, tile.origin_m.x + static_cast<double>(vertex.position_m.x));
        }
        const double width = static_cast<double>(tile.vertices[1].position_m.x - tile.vertices[0].position_m.x);
        area += width * width;
    }
    EXPECT_LE(west, 1000.0 - 2499.0);
    EXPECT_GE(east, 1050.0 + 2499.0);
    EXPECT_GE(area, 5050.0 * 5050.0);
}

TEST(FarGround, IsNotUnderNothing) {
    Scene scene;
    add_far_ground(scene);
    EXPECT_TRUE(scene.meshes.empty() && scene.materials.empty());
}

} // namespace
} // namespace fernlicht
