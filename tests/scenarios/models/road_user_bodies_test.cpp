#include "scenarios/models/road_user_bodies.h"

#include "scenarios/models/triangle_soup.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <map>
#include <set>

namespace fernlicht {
namespace {

/// Six times the volume that triangles enclose, positive when they face outwards.
double signed_volume(const TriangleSoup& soup) {
    double sum = 0.0;
    for (const SoupTriangle& t : soup.triangles)
        sum += glm::dot(soup.vertices[t.corners[0]].position_m,
                        glm::cross(soup.vertices[t.corners[1]].position_m, soup.vertices[t.corners[2]].position_m));
    return sum / 6.0;
}

TEST(BodyShapes, FaceOutwardsAndHaveTheirVolume) {
    TriangleSoup box;
    append_box(box, {1, 2, 3}, {3, 5, 4}, 0);
    EXPECT_NEAR(signed_volume(box), 6.0, 1e-12);

    TriangleSoup wheel;
    append_wheel(wheel, {5, 0, 0.3}, 0.3, 0.2, 0.6, 96, 0, 1);
    // The rims are hollow: two cones of 20 % of half the width.
    const double full = pi * 0.09 * 0.2, hollow = 2.0 / 3.0 * pi * 0.18 * 0.18 * 0.02;
    EXPECT_NEAR(signed_volume(wheel), full - hollow, 1e-4);

    TriangleSoup limb;
    append_limb(limb, {0, 0, 0}, {0, 3, 4}, 0.5, 0.5, 64, 0);
    EXPECT_GT(signed_volume(limb), pi * 0.25 * 5.0 * 0.99);
    EXPECT_LT(signed_volume(limb), pi * 0.25 * 5.0 + 4.0 / 3.0 * pi * 0.125);
}

TEST(BodyShapes, SmoothingKeepsEdgesAndRoundsWhatIsRound) {
    TriangleSoup box;
    append_box(box, {0, 0, 0}, {1, 1, 1}, 0);
    smooth(box, radians(38.0));
    EXPECT_EQ(box.vertices.size(), 24U);
    TriangleSoup limb;
    append_limb(limb, {0, 0, 0}, {0, 0, 1}, 0.1, 0.1, 24, 0);
    const std::size_t before = limb.vertices.size();
    smooth(limb, radians(50.0));
    EXPECT_LT(limb.vertices.size(), before / 4);
    for (const SoupVertex& v : limb.vertices)
        if (v.position_m.z > 0.01 && v.position_m.z < 0.99) {
            EXPECT_NEAR(v.normal.z, 0.0, 1e-9);
        }
}

struct Kind {
    const char* name;
    Model (*make)(const BodySize&);
    BodySize size;
    double within_m; ///< of the box
};

const Kind kinds[] = {{"car", car_body, {{4.5, 1.8, 1.45}, -0.9, glm::vec3(0.3F)}, 0.02},
                      {"van", van_body, {{5.5, 2.0, 2.3}, -1.1, glm::vec3(0.3F)}, 0.03},
                      {"truck", truck_body, {{9.0, 2.5, 3.6}, -2.0, glm::vec3(0.3F)}, 0.03},
                      {"bus", bus_body, {{12.0, 2.55, 3.1}, -3.2, glm::vec3(0.3F)}, 0.03},
                      {"motorcycle", motorcycle_body, {{2.2, 0.8, 1.6}, -0.4, glm::vec3(0.3F)}, 0.2},
                      {"bicycle", bicycle_body, {{1.8, 0.6, 1.7}, -0.4, glm::vec3(0.3F)}, 0.2},
                      {"pedestrian", pedestrian_body, {{0.5, 0.6, 1.75}, -0.25, glm::vec3(0.3F)}, 0.1}};

TEST(RoadUserBodies, FillTheirBoxAndNoMore) {
    for (const Kind& kind : kinds) {
        const Model model = kind.make(kind.size);
        ASSERT_EQ(model.meshes.size(), 1U) << kind.name;
        const glm::dvec3 low(kind.size.rear_m, -0.5 * kind.size.size_m.y, 0.0), high = low + kind.size.size_m;
        EXPECT_NEAR(model.low_m.x, low.x, kind.within_m) << kind.name;
        EXPECT_NEAR(model.high_m.x, high.x, kind.within_m) << kind.name;
        EXPECT_NEAR(model.high_m.y, high.y, kind.within_m) << kind.name;
        EXPECT_NEAR(model.low_m.y, -model.high_m.y, 0.01) << kind.name;
        EXPECT_NEAR(model.high_m.z, high.z, kind.within_m) << kind.name;
        EXPECT_NEAR(model.low_m.z, 0.0, 0.03) << kind.name << " stands on the road";
        EXPECT_GE(model.triangles(), 100U) << kind.name;
        EXPECT_LE(model.triangles(), 2000U) << kind.name;
        for (const Vertex& v : model.meshes[0].vertices)
            ASSERT_NEAR(glm::length(v.normal), 1.0F, 1e-5F) << kind.name;
    }
}

/// Light from outside must find the lit side: from far away in any direction the nearest hit faces the observer.
TEST(RoadUserBodies, AreLitFromOutside) {
    for (const Kind& kind : kinds) {
        const Model model = kind.make(kind.size);
        const Mesh& mesh = model.meshes[0];
        const glm::dvec3 centre = 0.5 * (model.low_m + model.high_m);
        int hits = 0, backs = 0;
        for (int i = 0; i < 400; ++i) { // rays towards points of the box's middle, from a ring of directions
            const double angle = 0.7 + 2.39996 * i, up = 0.05 + 0.9 * (i % 20) / 20.0;
            const glm::dvec3 from = centre + 30.0 * glm::dvec3(std::cos(angle), std::sin(angle), up), size = model.high_m - model.low_m;
            const glm::dvec3 target =
                centre + size * glm::dvec3(0.35 * std::sin(7.1 * i), 0.3 * std::sin(3.3 * i), 0.3 * std::sin(5.7 * i));
            const glm::dvec3 d = glm::normalize(target - from);
            double nearest = 1e9;
            bool back = false;
            for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
                const glm::dvec3 a = mesh.vertices[mesh.indices[k]].position_m, b = mesh.vertices[mesh.indices[k + 1]].position_m,
                                 c = mesh.vertices[mesh.indices[k + 2]].position_m, n = glm::cross(b - a, c - a);
                const double along = glm::dot(n, d), t = glm::dot(a - from, n) / along;
                const glm::dvec3 p = from + t * d;
                if (along != 0.0 && t < nearest && glm::dot(glm::cross(b - a, p - a), n) >= 0.0 &&
                    glm::dot(glm::cross(c - b, p - b), n) >= 0.0 && glm::dot(glm::cross(a - c, p - c), n) >= 0.0) {
                    nearest = t;
                    back = along > 0.0;
                }
            }
            hits += nearest < 1e8 ? 1 : 0;
            backs += nearest < 1e8 && back ? 1 : 0;
        }
        EXPECT_GT(hits, 60) << kind.name;
        EXPECT_LE(backs, hits / 50) << kind.name << ": of " << hits; // plates that stand free have one side
    }
}

TEST(RoadUserBodies, TapeOfALorryStandsProudOfItsSides) {
    BodySize size = kinds[2].size;
    size.dressed = true;
    const Model lorry = truck_body(size);
    const Mesh& mesh = lorry.meshes[0];
    std::map<std::string, double> farthest_m; ///< to the left, by material, of what stands upright along the side
    for (const Batch& batch : mesh.batches)
        for (std::uint32_t k = batch.first; k < batch.first + batch.count; ++k)
            if (const Vertex& v = mesh.vertices[mesh.indices[k]]; v.normal.y > 0.99F && v.position_m.z > 1.2F) {
                double& most = farthest_m[lorry.materials[batch.material].name];
                most = std::max(most, static_cast<double>(v.position_m.y));
            }
    ASSERT_TRUE(farthest_m.contains("white tape"));
    for (const auto& [name, y_m] : farthest_m)
        if (name != "white tape") {
            EXPECT_LT(y_m + 0.002, farthest_m["white tape"]) << name;
        }
    EXPECT_LE(farthest_m["white tape"], 0.5 * size.size_m.y);
}

TEST(RoadUserBodies, CarryTheirMounts) {
    const auto names = [](const Model& model) {
        std::set<std::string> all;
        for (const Mount& mount : model.mounts)
            all.insert(mount.name);
        return all;
    };
    const Model car = car_body(kinds[0].size);
    for (const char* name : {"lamp.low.left", "lamp.low.right", "lamp.high.left", "lamp.tail.right", "lamp.brake.left"})
        EXPECT_TRUE(names(car).contains(name)) << name;
    for (const Mount& mount : car.mounts) {
        const bool rear = mount.pose.position_m.x < 0.0;
        EXPECT_NEAR(mount.pose.forward().x, rear ? -1.0 : 1.0, 1e-12) << mount.name;
        EXPECT_EQ(mount.name.ends_with("left"), mount.pose.position_m.y > 0.0);
        // UN R48: low beams stand at 500 to 1200 mm, tail lamps at 350 to 1500 mm.
        EXPECT_GE(mount.pose.position_m.z, rear ? 0.35 : 0.5) << mount.name;
        EXPECT_LE(mount.pose.position_m.z, rear ? 1.5 : 1.2) << mount.name;
    }
    EXPECT_TRUE(names(motorcycle_body(kinds[4].size)).contains("lamp.low.centre"));
    EXPECT_TRUE(pedestrian_body(kinds[6].size).mounts.empty());
}

TEST(RoadUserBodies, ReflectorsReturnWhatTheirRegulationAsks) {
    const Model car = car_body(kinds[0].size);
    for (const Material& m : car.materials) {
        const auto at_deg = [&](double degrees_of_observation) {
            return static_cast<double>(m.retro_rl) *
                   std::exp(-(radians(degrees_of_observation) - static_cast<double>(m.retro_reference_rad)) /
                            static_cast<double>(m.retro_falloff_rad));
        };
        if (m.name == "reflector") { // UN R3, IA: millicandela per lux of 25 cm2
            EXPECT_NEAR(at_deg(20.0 / 60.0) * 25e-4 * 1e3, 300.0, 0.1);
            EXPECT_NEAR(at_deg(1.5) * 25e-4 * 1e3, 5.0, 0.01);
        } else if (m.name == "number plate") { // EN 12899-1, RA1
            EXPECT_NEAR(at_deg(20.0 / 60.0), 50.0, 0.01);
            EXPECT_NEAR(at_deg(2.0), 5.0, 0.01);
        }
    }
}

} // namespace
} // namespace fernlicht
