#include "scenarios/dressing/dressing.h"

#include "scenarios/dressing/dressed_object.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "tests/scenarios/roads/opendrive_text.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

struct Shape {
    const char* name;
    DressedObject object;
    glm::dvec3 low_m, high_m; ///< of the plain shape
};

std::vector<Shape> shapes(std::uint64_t seed, Detail detail) {
    const Dice dice(seed, "shape");
    return {{"house", dressed_house({12.0, 10.0, 7.0, 0.5, true}, dice, detail), {-6, -5, 0}, {6, 5, 7}},
            {"tall house", dressed_house({16.0, 9.0, 14.0, 0.0, false}, dice, detail), {-8, -4.5, 0}, {8, 4.5, 14}},
            {"tree", dressed_tree(14.0, 2.6, dice, detail), {-2.6, -2.6, 0}, {2.6, 2.6, 14}},
            {"bush", dressed_bush(1.5, 0.8, dice), {-0.8, -0.8, 0}, {0.8, 0.8, 1.5}},
            {"hedge", dressed_hedge(9.0, 0.8, 1.2, 0.4, dice), {-4.5, -0.5, -0.4}, {4.5, 0.5, 1.2}},
            {"fence", dressed_fence(9.0, 1.0, 0.3), {-4.5, -0.05, -0.3}, {4.5, 0.05, 1.0}},
            {"field fence", dressed_field_fence(3.0), {-1.5, -0.05, -0.4}, {1.5, 0.075, 1.15}},
            {"rail", dressed_guard_rail(4.0, 0.08, 0.31, true), {-2, -0.04, 0}, {2, 0.04, 0.31}},
            {"rail", dressed_guard_rail(4.0, 0.08, 0.31, false), {-2, -0.04, 0}, {2, 0.04, 0.31}},
            {"low house", dressed_house({8.0, 6.0, 1.5 + lowest_house_m, 1.5, true}, dice, detail), {-4, -3, 0}, {4, 3, 6}}};
}

std::vector<std::array<SoupVertex, 3>> all_triangles(const DressedObject& object) {
    std::vector<std::array<SoupVertex, 3>> out;
    for (const TriangleSoup* soup : {&object.low, &object.high})
        for (const SoupTriangle& t : soup->triangles)
            out.push_back({soup->vertices.at(t.corners[0]), soup->vertices.at(t.corners[1]), soup->vertices.at(t.corners[2])});
    return out;
}

glm::dvec3 cross_of(const std::array<SoupVertex, 3>& t) {
    return glm::cross(t[1].position_m - t[0].position_m, t[2].position_m - t[0].position_m);
}

TEST(DressedShapes, StayInThePlainShapesBoxAndFaceTheirNormals) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
        for (const Detail detail : {Detail::near, Detail::far})
            for (const Shape& shape : shapes(seed, detail)) {
                const auto triangles = all_triangles(shape.object);
                ASSERT_GE(triangles.size(), 10U) << shape.name;
                std::size_t against = 0;
                for (const auto& t : triangles) {
                    ASSERT_GT(glm::length(cross_of(t)), 0.0) << shape.name;
                    for (const SoupVertex& v : t) {
                        for (int axis = 0; axis < 3; ++axis) {
                            ASSERT_GE(v.position_m[axis], shape.low_m[axis] - 1e-9) << shape.name << ", seed " << seed;
                            ASSERT_LE(v.position_m[axis], shape.high_m[axis] + 1e-9) << shape.name << ", seed " << seed;
                        }
                        ASSERT_NEAR(glm::length(v.normal), 1.0, 1e-9) << shape.name;
                        against += glm::dot(v.normal, cross_of(t)) < 0.0 ? 1U : 0U;
                    }
                }
                EXPECT_LE(against, 3 * triangles.size() / 50) << shape.name << ": corners whose normal looks away, of leaves alone";
            }
}

/// From far away in any direction the nearest hit shows its lit side.
TEST(DressedShapes, AreLitFromOutside) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
        for (const Detail detail : {Detail::near, Detail::far})
            for (const Shape& shape : shapes(seed, detail)) {
                if (std::string_view(shape.name) == "rail")
                    continue; // a sheet with open ends
                const auto triangles = all_triangles(shape.object);
                const glm::dvec3 centre = 0.5 * (shape.low_m + shape.high_m), size = shape.high_m - shape.low_m;
                int hits = 0, backs = 0;
                for (int i = 0; i < 200; ++i) {
                    const double angle = 0.7 + 2.39996 * i, up = 0.02 + 0.6 * (i % 20) / 20.0;
                    const glm::dvec3 from = centre + 60.0 * glm::dvec3(std::cos(angle), std::sin(angle), up),
                                     to = centre +
                                          size * glm::dvec3(0.35 * std::sin(7.1 * i), 0.3 * std::sin(3.3 * i), 0.3 * std::sin(5.7 * i)),
                                     d = glm::normalize(to - from);
                    double nearest = 1e9;
                    bool back = false;
                    for (const auto& t : triangles) {
                        const glm::dvec3 &a = t[0].position_m, &b = t[1].position_m, &c = t[2].position_m, n = cross_of(t);
                        const double along = glm::dot(n, d), at = glm::dot(a - from, n) / along;
                        const glm::dvec3 p = from + at * d;
                        if (along != 0.0 && at < nearest && glm::dot(glm::cross(b - a, p - a), n) >= 0.0 &&
                            glm::dot(glm::cross(c - b, p - b), n) >= 0.0 && glm::dot(glm::cross(a - c, p - c), n) >= 0.0) {
                            nearest = at;
                            back = along > 0.0;
                        }
                    }
                    hits += nearest < 1e8 ? 1 : 0;
                    backs += nearest < 1e8 && back ? 1 : 0;
                }
                EXPECT_GT(hits, 20) << shape.name;
                EXPECT_LE(backs, hits / 20) << shape.name << ", seed " << seed << ": of " << hits;
            }
}

/// Of a point from a triangle.
double distance_m(const glm::dvec3& p, const std::array<SoupVertex, 3>& t) {
    const glm::dvec3 &a = t[0].position_m, &b = t[1].position_m, &c = t[2].position_m, n = glm::normalize(cross_of(t));
    const glm::dvec3 on = p - glm::dot(p - a, n) * n;
    if (glm::dot(glm::cross(b - a, on - a), n) >= 0.0 && glm::dot(glm::cross(c - b, on - b), n) >= 0.0 &&
        glm::dot(glm::cross(a - c, on - c), n) >= 0.0)
        return std::abs(glm::dot(p - a, n));
    double least = 1e9;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        const double share = std::clamp(glm::dot(p - from, to - from) / glm::dot(to - from, to - from), 0.0, 1.0);
        least = std::min(least, glm::length(p - from - share * (to - from)));
    }
    return least;
}

TEST(DressedShapes, FarOnesKeepTheirErrorBound) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const std::vector<Shape> near = shapes(seed, Detail::near), far = shapes(seed, Detail::far);
        for (const std::size_t i : {0U, 1U, 2U}) {
            const double bound_m = i < 2 ? far_house_error_m : far_tree_error * 2.6;
            const auto fine = all_triangles(near[i].object), coarse = all_triangles(far[i].object);
            EXPECT_LT(coarse.size(), fine.size()) << near[i].name;
            double worst_m = 0.0;
            for (const auto& t : fine)
                for (const SoupVertex& v : t) {
                    double least_m = 1e9;
                    for (const auto& other : coarse)
                        if (least_m > 1e-6)
                            least_m = std::min(least_m, distance_m(v.position_m, other));
                    worst_m = std::max(worst_m, least_m);
                }
            EXPECT_LE(worst_m, bound_m) << near[i].name << ", seed " << seed;
        }
    }
}

TEST(DressedShapes, HousesTooLowForARoofStayBoxes) {
    RoadObject house;
    house.type = "building";
    house.length_m = 8.0;
    house.width_m = 6.0;
    house.height_m = 4.6;
    EXPECT_TRUE(is_dressed(house));
    house.height_m = 4.2;
    EXPECT_FALSE(is_dressed(house));
    house.height_m = 5.7;
    house.z_offset_m = -1.5; // sunk: 4.2 m above the ground
    EXPECT_FALSE(is_dressed(house));
}

double luminance(const glm::vec3& c) { return glm::dot(glm::dvec3(c), glm::dvec3(0.2126, 0.7152, 0.0722)); }

TEST(DressingMaterials, ReflectNoMoreThanAllAndKeepTheirMeansUnderPictures) {
    const std::vector<Material> plain = dressing_materials();
    Scene scene;
    const std::uint32_t first = add_dressing_materials(scene, true, 3);
    ASSERT_EQ(plain.size(), scene.materials.size() - first);
    for (std::size_t i = 0; i < plain.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(plain[i].albedo[c], 0.0F) << plain[i].name;
            EXPECT_LE(plain[i].albedo[c], 0.8F) << plain[i].name;
        }
        const Material& dressed = scene.materials[first + i];
        if (dressed.texture < 0)
            continue;
        const glm::dvec3 mean = mean_reflectance(scene.textures[static_cast<std::size_t>(dressed.texture)], dressed.texture_mode,
                                                 glm::dvec3(dressed.albedo), glm::dvec3(0.0));
        EXPECT_NEAR(luminance(glm::vec3(mean)), luminance(plain[i].albedo), 1e-6) << plain[i].name;
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(dressed.albedo[c], 1.0F) << plain[i].name;
    }
    // A lit room is what 100 lx on walls of 0.5 give through glass of 0.8; the colour has luminance 1.
    EXPECT_NEAR(luminance(plain[index_of(Stuff::room)].emission_cdm2), 100.0 * 0.5 / pi * 0.8, 0.1);
}

Scene dressed(const RoadNetwork& network, const Route& route, std::uint64_t seed) {
    RoadMeshOptions options;
    options.leave_out = is_dressed;
    Scene scene = build_scene(network, options);
    add_dressing(scene, network, route, {.seed = seed});
    return scene;
}

bool same(const Scene& a, const Scene& b) {
    return a.materials == b.materials && std::ranges::equal(a.meshes, b.meshes, [](const Mesh& x, const Mesh& y) {
               return x.name == y.name && x.origin_m == y.origin_m && x.indices == y.indices &&
                      std::ranges::equal(x.vertices, y.vertices, [](const Vertex& v, const Vertex& w) {
                          return v.position_m == w.position_m && v.normal == w.normal && v.uv == w.uv;
                      });
           });
}

TEST(Dressing, IsTheSameForTheSameSeedAndLeavesRoadAndGroundAlone) {
    for (const char* name : {"village.xodr", "country.xodr"}) {
        const RoadNetwork network = opendrive_text::library_road(name);
        const Route route(network, {});
        const Scene plain = build_scene(network), a = dressed(network, route, 1);
        EXPECT_TRUE(same(a, dressed(network, route, 1))) << name;
        EXPECT_FALSE(same(a, dressed(network, route, 2))) << name;
        std::size_t ground = 0;
        for (const Mesh& mesh : plain.meshes) {
            if (!mesh.name.starts_with("road ") && mesh.name.find("of road") == std::string::npos)
                continue;
            const auto there = std::ranges::find(a.meshes, mesh.name, &Mesh::name);
            ASSERT_NE(there, a.meshes.end()) << mesh.name;
            EXPECT_EQ(there->indices, mesh.indices) << mesh.name;
            ++ground;
        }
        EXPECT_GT(ground, 10U);
    }
}

TEST(Dressing, StandsBesideWhatVehiclesUse) {
    const RoadNetwork network = opendrive_text::library_road("village.xodr");
    const Route route(network, {});
    const Scene scene = dressed(network, route, 1);
    std::vector<Pose> along;
    for (double at = 0.0; at < route.length_m(); at += 2.0)
        along.push_back(route.pose(at));
    std::size_t hedges = 0, people = 0, houses = 0, cars = 0;
    for (const Mesh& mesh : scene.meshes) {
        hedges += mesh.name.starts_with("hedge") || mesh.name.starts_with("fence") ? 1U : 0U;
        people += mesh.name.starts_with("pedestrian") ? 1U : 0U;
        houses += mesh.name.starts_with("house") ? 1U : 0U;
        cars += mesh.name.starts_with("parked car") ? 1U : 0U;
        if (!mesh.name.starts_with("hedge") && !mesh.name.starts_with("fence") && !mesh.name.starts_with("pedestrian"))
            continue;
        for (const Vertex& v : mesh.vertices) {
            const glm::dvec3 p = mesh.origin_m + glm::dvec3(v.position_m);
            for (const Pose& pose : along) {
                const glm::dvec3 place = to_local(pose, p);
                if (std::abs(place.x) < 1.5) {
                    ASSERT_GT(std::abs(place.y - 1.5), 3.0) << mesh.name << " on a driving lane"; // both lanes lie -1.5 .. 4.5 m left
                }
            }
        }
    }
    EXPECT_GE(hedges, 8U);
    EXPECT_GE(people, 8U);
    EXPECT_GE(houses, 20U);
    EXPECT_EQ(cars, 10U);
}

TEST(Dressing, NobodyStandsInALongObjectOrAJunction) {
    RoadNetwork network = opendrive_text::library_road("village.xodr");
    const Route route(network, {});
    Road& road = network.roads.front(); // straight, along x from 0 to 385 m
    const auto people_on_its_left = [&] {
        std::size_t count = 0;
        const Scene scene = dressed(network, route, 1);
        for (const Mesh& mesh : scene.meshes) {
            EXPECT_FALSE(mesh.name.starts_with("pedestrian, road 1") && !mesh.name.starts_with("pedestrian, road 1 ")) << mesh.name;
            if (mesh.name.starts_with("pedestrian, road 1 ") && mesh.origin_m.y > 0.0 && mesh.origin_m.x > 45.0 && mesh.origin_m.x < 335.0)
                ++count;
        }
        return count;
    };
    EXPECT_GT(people_on_its_left(), 2U);
    RoadObject wall;
    wall.type = "wall";
    wall.s_m = 190.0;
    const LaneSection& section = section_at(road, wall.s_m);
    wall.t_m = lane_edges(road, section, section.lanes.front().id, wall.s_m).outer_t_m - 1.0;
    wall.length_m = 300.0;
    wall.width_m = 10.0;
    wall.height_m = 2.0;
    road.objects.push_back(wall);
    EXPECT_EQ(people_on_its_left(), 0U);
}

TEST(Dressing, CarsOfThreeShapesFillTheirBoxes) {
    for (std::uint32_t draw = 0; draw < 3; ++draw) {
        const BodySize size{{4.4, 1.8, 1.3}, -0.88, glm::vec3(0.3F), true, draw};
        const Model car = car_body(size);
        EXPECT_NEAR(car.low_m.x, -0.88, 0.02) << draw;
        EXPECT_NEAR(car.high_m.x, 3.52, 0.02) << draw;
        EXPECT_NEAR(car.high_m.y, 0.9, 0.02) << draw;
        EXPECT_NEAR(car.high_m.z, 1.3, 0.02) << draw;
        EXPECT_LE(car.triangles(), 1500U) << draw;
        EXPECT_TRUE(std::ranges::any_of(car.materials, [](const Material& m) { return m.name == "headlamp" && m.retro_rl > 0.0F; }));
    }
}

} // namespace
} // namespace fernlicht
