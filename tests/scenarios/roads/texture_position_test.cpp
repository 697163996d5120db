// Where in its texture a vertex lies: by hand, across meshes, and on whole roads.
#include "scenarios/roads/mesh/mesh_builder.h"
#include "tests/scenarios/roads/mesh_checks.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

namespace fernlicht {
namespace {

glm::vec2 at(const glm::dvec3& origin, const glm::vec3& position, const glm::vec3& normal) {
    return texture_position(origin, {position, normal});
}

void expect_uv(const glm::vec2& found, float u, float v) {
    EXPECT_EQ(found.x, u);
    EXPECT_EQ(found.y, v);
}

RoadNetwork shipped_road(const char* name) {
    return read_opendrive(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/roads" / name);
}

/// 0: seen from the side along x, 1: along y, 2: from above.
int axis_of(const glm::vec3& n) {
    const glm::vec3 a = glm::abs(n);
    return a.z >= std::max(a.x, a.y) ? 2 : a.x >= a.y ? 0 : 1;
}

TEST(TexturePosition, FromAboveByHand) {
    // 8 m a repetition: 100 m is 12 of them and 4 m, -3 m is -1 of them and 5 m.
    expect_uv(at({100.0, -3.0, 5.0}, {1.5F, 0.25F, 0.0F}, {0.0F, 0.0F, 1.0F}), 5.5F / 8.0F, 5.25F / 8.0F);
    expect_uv(at({0.0, 0.0, 0.0}, {-2.0F, 12.0F, 0.0F}, {0.1F, 0.2F, 0.97F}), -0.25F, 1.5F);
}

TEST(TexturePosition, UprightRunsToTheRightAndUp) {
    const glm::vec3 p(1.0F, 2.0F, 4.0F);
    expect_uv(at({}, p, {1.0F, 0.0F, 0.0F}), 0.25F, 0.5F);   // from the east, north is to the right
    expect_uv(at({}, p, {-1.0F, 0.0F, 0.0F}), -0.25F, 0.5F); // from the west, south
    expect_uv(at({}, p, {0.0F, 1.0F, 0.0F}), -0.125F, 0.5F); // from the north, west
    expect_uv(at({}, p, {0.0F, -1.0F, 0.0F}), 0.125F, 0.5F); // from the south, east
}

TEST(TexturePosition, MeshesAgreeExactlyApartFromWholeRepetitions) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> near(-100.0, 100.0);
    const std::array<glm::vec3, 3> normals{glm::vec3(0.0F, 0.0F, 1.0F), glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, -1.0F, 0.0F)};
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 a(680000.0, 5400000.0, 300.0), b = a + glm::round(glm::dvec3(near(random), near(random), near(random)));
        const glm::dvec3 world = on_lattice(a + glm::dvec3(near(random), near(random), near(random)));
        const glm::vec3& normal = normals[static_cast<std::size_t>(i % 3)];
        const glm::dvec2 uv_a(at(a, glm::vec3(world - a), normal)), uv_b(at(b, glm::vec3(world - b), normal));
        const glm::dvec2 apart = uv_a - uv_b;
        EXPECT_EQ(apart, glm::round(apart));
    }
}

TEST(TexturePosition, RoadMeshesHaveTheirTexturesInTrueSize) {
    RoadMeshOptions options;
    options.textures = true;
    for (const char* name : {"country.xodr", "village.xodr"}) {
        SCOPED_TRACE(name);
        const Scene scene = build_scene(shipped_road(name), options);
        std::size_t checked = 0;
        for (const Mesh& mesh : scene.meshes)
            for (const Batch& batch : mesh.batches) {
                if (scene.materials[batch.material].texture < 0)
                    continue;
                for (std::uint32_t k = batch.first; k < batch.first + batch.count; k += 3)
                    for (std::uint32_t side = 0; side < 3; ++side) {
                        const Vertex& a = mesh.vertices[mesh.indices[k + side]];
                        const Vertex& b = mesh.vertices[mesh.indices[k + (side + 1) % 3]];
                        ASSERT_EQ(axis_of(a.normal), axis_of(b.normal)) << mesh.name << ": a triangle seen from two sides";
                        const glm::vec3 d = 0.125F * (b.position_m - a.position_m);
                        const glm::vec2 uv = b.uv - a.uv;
                        const int axis = axis_of(a.normal);
                        ASSERT_EQ(std::abs(uv.x), std::abs(axis == 0 ? d.y : d.x)) << mesh.name;
                        ASSERT_EQ(std::abs(uv.y), std::abs(axis == 2 ? d.y : d.z)) << mesh.name;
                        ++checked;
                    }
            }
        EXPECT_GT(checked, 10000U);
    }
}

TEST(TexturePosition, RoadsHaveTexturesOnlyWhenAsked) {
    const RoadNetwork network = shipped_road("village.xodr");
    RoadMeshOptions with, without;
    with.textures = true;
    without.textures = false;
    const Scene plain = build_scene(network, without), textured = build_scene(network, with);
    EXPECT_TRUE(plain.textures.empty());
    EXPECT_EQ(plain.materials, road_materials());
    for (const Material& material : plain.materials)
        EXPECT_EQ(material.texture, -1);
    EXPECT_EQ(textured.textures.size(), 4U);
    for (const Material& material : textured.materials)
        EXPECT_LT(material.texture, 4);
    ASSERT_EQ(plain.meshes.size(), textured.meshes.size());
    for (std::size_t i = 0; i < plain.meshes.size(); ++i)
        EXPECT_EQ(plain.meshes[i].indices, textured.meshes[i].indices);
}

} // namespace
} // namespace fernlicht
