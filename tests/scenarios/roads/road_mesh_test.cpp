// Invariants of the road mesh on our own roads and on every real file at hand.
#include "scenarios/roads/mesh_builder.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/roads/mesh_checks.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace fernlicht {
namespace {

using namespace mesh_checks;

std::vector<std::filesystem::path> roads_under(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.path().extension() == ".xodr")
                files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void expect_well_formed(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        SCOPED_TRACE(mesh.name);
        std::size_t covered = 0;
        for (const Batch& batch : mesh.batches) {
            EXPECT_LT(batch.material, scene.materials.size());
            EXPECT_EQ(batch.first, covered) << "batches follow one another";
            covered += batch.count;
        }
        EXPECT_EQ(covered, mesh.indices.size());
        for (const std::uint32_t index : mesh.indices)
            ASSERT_LT(index, mesh.vertices.size());
        for (const Vertex& vertex : mesh.vertices) {
            ASSERT_TRUE(finite(vertex.position_m) && finite(vertex.normal));
            ASSERT_NEAR(glm::length(vertex.normal), 1.0F, 1e-5F);
            const glm::dvec3 world = mesh.origin_m + glm::dvec3(vertex.position_m);
            ASSERT_EQ(on_lattice(world), world) << "neighbouring meshes agree only on the lattice";
        }
    }
}

bool is_face(const Triangle& triangle) { return triangle.material == index_of(RoadMaterial::kerb); }

/// Counts of what must not be on a road's surface.
struct Faults {
    std::size_t downward = 0, turned = 0, without_area = 0;
};

Faults faults(const std::vector<Triangle>& surface) {
    Faults found;
    for (const Triangle& triangle : surface) {
        const glm::dvec3 across = triangle.cross();
        if (triangle.area() < 1e-7) { // 0.1 mm by 2 mm
            ++found.without_area;
            continue;
        }
        found.downward += !is_face(triangle) && across.z < -0.01 * glm::length(across) ? 1U : 0U;
        for (const glm::dvec3& normal : triangle.normals)
            if (glm::dot(across, normal) < 0.0) {
                ++found.turned;
                break;
            }
    }
    return found;
}

void expect_sound(const RoadNetwork& network, const Scene& scene) {
    for (const Road& road : network.roads) {
        SCOPED_TRACE("road " + road.id);
        const std::vector<Triangle> surface = triangles(scene, "road " + road.id + " s ");
        const Topology found = topology(surface);
        EXPECT_EQ(found.crowded_edges, 0U);
        EXPECT_EQ(found.euler, static_cast<std::int64_t>(found.parts)) << "a crack or a T-junction";
        const Faults wrong = faults(surface);
        EXPECT_EQ(wrong.downward, 0U);
        EXPECT_EQ(wrong.turned, 0U);
        EXPECT_EQ(wrong.without_area, 0U);
    }
}

TEST(RoadMesh, LibraryRoadsAreSound) {
    const auto files = roads_under(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/roads");
    ASSERT_GE(files.size(), 5U);
    for (const auto& file : files) {
        SCOPED_TRACE(file.filename());
        const RoadNetwork network = read_opendrive(file);
        EXPECT_TRUE(network.warnings.empty()) << network.warnings.front();
        const Scene scene = build_scene(network);
        expect_well_formed(scene);
        expect_sound(network, scene);
    }
}

} // namespace
} // namespace fernlicht
