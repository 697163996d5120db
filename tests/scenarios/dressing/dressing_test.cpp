#include "scenarios/dressing/dressing.h"

#include "scenarios/dressing/dressed_object.h"
#include "scenarios/drives/play/staged_scene.h"
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

struct Met {
    int hits = 0, backs = 0;
};
/// What rays at places in a box meet first: from far away, not from below, and from a driver's eye, 1.2 m above its foot.
Met met_from_outside(const std::vector<std::array<SoupVertex, 3>>& triangles, const glm::dvec3& low_m, const glm::dvec3& high_m) {
    const glm::dvec3 centre = 0.5 * (low_m + high_m), size = high_m - low_m;
    Met met;
    for (int i = 0; i < 1200; ++i) {
        const double angle = 0.7 + 2.39996 * i, up = 0.02 + 0.6 * (i % 20) / 20.0, far_m = glm::length(size) + 5.0 + 4.0 * (i % 11);
        const glm::dvec3 level(std::cos(angle), std::sin(angle), 0.0),
            from = i % 2 == 0 ? centre + 60.0 * (level + glm::dvec3(0.0, 0.0, up))
                              : glm::dvec3(glm::dvec2(centre + far_m * level), low_m.z + 1.2),
            to = centre + size * glm::dvec3(0.45 * std::sin(7.1 * i), 0.45 * std::sin(3.3 * i), 0.45 * std::sin(5.7 * i)),
            d = glm::normalize(to - from);
        double nearest = 1e9;
        bool back = false;
        for (const auto& t : triangles) {
            const glm::dvec3 &a = t[0].position_m, &b = t[1].position_m, &c = t[2].position_m, n = cross_of(t);
            const double along = glm::dot(n, d), at = glm::dot(a - from, n) / along;
            const glm::dvec3 p = from + at * d;
            if (along != 0.0 && at > 0.0 && at < nearest && glm::dot(glm::cross(b - a, p - a), n) >= 0.0 &&
                glm::dot(glm::cross(c - b, p - b), n) >= 0.0 && glm::dot(glm::cross(a - c, p - c), n) >= 0.0) {
                nearest = at;
                back = along > 0.0;
            }
        }
        met.hits += nearest < 1e8 ? 1 : 0;
        met.backs += nearest < 1e8 && back ? 1 : 0;
    }
    return met;
}

/// Where fronts alone are drawn a back would be a hole: 2 % are the edges of leaves, 1 cm thick.
TEST(DressedShapes, ShowTheirFrontsFromOutside) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
        for (const Detail detail : {Detail::near, Detail::far})
            for (const Shape& shape : shapes(seed, detail)) {
                const auto [hits, backs] = met_from_outside(all_triangles(shape.object), shape.low_m, shape.high_m);
                EXPECT_GT(hits, 60) << shape.name;
                EXPECT_LE(backs, hits / (shape.object.closed ? 50 : 14)) << shape.name << ", seed " << seed << ": of " << hits;
            }
}

std::vector<std::array<SoupVertex, 3>> all_triangles(const Model& model) {
    std::vector<std::array<SoupVertex, 3>> out;
    for (const Mesh& mesh : model.meshes)
        for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
            const auto at = [&](std::size_t i) { return mesh.origin_m + glm::dvec3(mesh.vertices[mesh.indices[k + i]].position_m); };
            out.push_back({SoupVertex{at(0), {}, {}}, SoupVertex{at(1), {}, {}}, SoupVertex{at(2), {}, {}}});
        }
    return out;
}

TEST(DressedShapes, BodiesSignsAndBollardsShowTheirFrontsFromOutside) {
    const auto expect_fronts = [](const std::vector<std::array<SoupVertex, 3>>& triangles, const glm::dvec3& low_m,
                                  const glm::dvec3& high_m, std::string_view name) {
        const auto [hits, backs] = met_from_outside(triangles, low_m, high_m);
        EXPECT_GT(hits, 100) << name;
        EXPECT_LE(backs, hits / 100) << name;
    };
    for (std::uint32_t draw = 0; draw < 6; ++draw)
        for (const Model& body : {car_body({{4.4, 1.8, 1.3}, -0.88, glm::vec3(0.3F), true, draw}),
                                  van_body({{5.4, 2.0, 2.3}, -1.0, glm::vec3(0.3F), true, draw}),
                                  truck_body({{9.4, 2.5, 3.3}, -1.9, glm::vec3(0.3F), true, draw}),
                                  bus_body({{11.4, 2.5, 3.1}, -2.3, glm::vec3(0.3F), true, draw}),
                                  pedestrian_body({{0.5, 0.55, 1.75}, -0.25, glm::vec3(0.3F), true, draw}),
                                  bicycle_body({{1.75, 0.6, 1.75}, -0.4, glm::vec3(0.3F), true, draw})})
            expect_fronts(all_triangles(body), body.low_m, body.high_m, body.name);
    expect_fronts(all_triangles(DressedObject{.low = dressed_sign(0.6, 0.6, {}, Dice(1, "sign"))}), {-0.03, -0.3, -1.5}, {0.0, 0.3, 0.3},
                  "sign");
    expect_fronts(all_triangles(dressed_bollard(0.9)), {-0.05, -0.05, 0.0}, {0.05, 0.05, 0.9}, "bollard");
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

TEST(DressedSigns, ShowTheirColoursAsSheetingOfClassRA2) {
    const std::vector<Material> all = dressing_materials();
    // EN 12899-1, class RA2, at 20' and 5 degrees.
    for (const auto& [stuff, ra] : {std::pair(Stuff::sheet_white, 180.0F), std::pair(Stuff::sheet_yellow, 120.0F),
                                    std::pair(Stuff::sheet_red, 25.0F), std::pair(Stuff::sheet_blue, 14.0F)}) {
        EXPECT_EQ(all[index_of(stuff)].retro_rl, ra);
        EXPECT_NEAR(all[index_of(stuff)].retro_reference_rad, radians(20.0 / 60.0), 1e-6);
        EXPECT_EQ(all[index_of(stuff)].kind, SurfaceKind::board);
    }
    const auto area = [](const TriangleSoup& soup, Stuff stuff) { // that faces the reader
        double sum = 0.0;
        for (const SoupTriangle& t : soup.triangles) {
            const glm::dvec3 &a = soup.vertices[t.corners[0]].position_m, &b = soup.vertices[t.corners[1]].position_m,
                             &c = soup.vertices[t.corners[2]].position_m;
            if (t.material == index_of(stuff))
                sum += std::max(0.0, 0.5 * glm::cross(b - a, c - a).x);
        }
        return sum;
    };
    const Dice dice(1, "sign");
    struct Case {
        SignalFace face;
        Stuff ground, ink;
    };
    for (const auto& [face, ground, ink] : {Case{{"DE", "274", "62", "120", ""}, Stuff::sheet_white, Stuff::sheet_red},
                                            Case{{"DE", "103", "10", "-1", ""}, Stuff::sheet_white, Stuff::sheet_red},
                                            Case{{"", "306", "", "", ""}, Stuff::sheet_white, Stuff::sheet_yellow},
                                            Case{{"DE", "310", "", "", "Ulm"}, Stuff::sheet_yellow, Stuff::sheet_black},
                                            Case{{"DE", "449", "", "", ""}, Stuff::sheet_blue, Stuff::sheet_white},
                                            Case{{"DE", "206", "", "", ""}, Stuff::sheet_red, Stuff::sheet_white},
                                            Case{{"DE", "625", "20", "", ""}, Stuff::sheet_white, Stuff::sheet_red},
                                            Case{{"US", "R1-1", "", "", ""}, Stuff::sheet_white, Stuff::sheet_black}}) {
        const TriangleSoup sign = dressed_sign(0.9, 0.8, face, dice);
        EXPECT_GT(area(sign, ground), 0.2) << face.type;
        EXPECT_GT(area(sign, ink), 0.01) << face.type;
        for (const SoupVertex& v : sign.vertices) {
            EXPECT_LE(std::abs(v.position_m.y), 0.45 + 1e-9) << face.type;
            EXPECT_LE(std::abs(v.position_m.z), 0.40 + 1e-9) << face.type;
        }
    }
    // A disc of 24 corners, a ring from 0.80 to 0.98 of its radius.
    const double corners = 0.5 * 24.0 * std::sin(2.0 * pi / 24.0) * 0.4 * 0.4;
    const TriangleSoup limit = dressed_sign(0.9, 0.8, {"DE", "274", "50", "", ""}, dice);
    EXPECT_NEAR(area(limit, Stuff::sheet_white), corners, 1e-9);
    EXPECT_NEAR(area(limit, Stuff::sheet_red), corners * (0.98 * 0.98 - 0.80 * 0.80), 1e-9);
    EXPECT_NE(area(limit, Stuff::sheet_black), area(dressed_sign(0.9, 0.8, {"DE", "274", "", "70", ""}, dice), Stuff::sheet_black));
    EXPECT_EQ(area(dressed_sign(0.9, 0.8, {"DE", "274", "62", "-1", ""}, dice), Stuff::sheet_black), 0.0) << "62 is no limit";
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
    RoadMeshOptions options{.seed = seed};
    dress_ground(options);
    Scene scene = build_scene(network, options);
    add_dressing(scene, network, route, {.seed = seed});
    return scene;
}

/// Of meshes whose name begins so.
std::size_t triangles(const Scene& scene, std::string_view name) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes)
        count += mesh.name.starts_with(name) ? mesh.indices.size() / 3 : 0;
    return count;
}

bool same(const Scene& a, const Scene& b) {
    return a.materials == b.materials && std::ranges::equal(a.meshes, b.meshes, [](const Mesh& x, const Mesh& y) {
               return x.name == y.name && x.origin_m == y.origin_m && x.indices == y.indices &&
                      std::ranges::equal(x.vertices, y.vertices, [](const Vertex& v, const Vertex& w) {
                          return v.position_m == w.position_m && v.normal == w.normal && v.uv == w.uv;
                      });
           });
}

TEST(Dressing, IsTheSameForTheSameSeedAndLeavesTheRoadAlone) {
    for (const char* name : {"village.xodr", "country.xodr"}) {
        const RoadNetwork network = opendrive_text::library_road(name);
        const Route route(network, {});
        const Scene plain = build_scene(network), a = dressed(network, route, 1);
        EXPECT_TRUE(same(a, dressed(network, route, 1))) << name;
        EXPECT_FALSE(same(a, dressed(network, route, 2))) << name;
        std::size_t ground = 0;
        for (const Mesh& mesh : plain.meshes) {
            if (!mesh.name.starts_with("road "))
                continue;
            const auto there = std::ranges::find(a.meshes, mesh.name, &Mesh::name);
            ASSERT_NE(there, a.meshes.end()) << mesh.name;
            EXPECT_EQ(there->indices, mesh.indices) << mesh.name;
            ++ground;
        }
        EXPECT_GT(ground, 6U);
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

TEST(Dressing, OfAMirroredDriveIsItsImage) {
    const auto scene_of = [](bool in_mirror) {
        Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/s-bend.yaml");
        RoadNetwork network = read_opendrive(drive.road_file);
        Route::Start start = drive.start;
        if (in_mirror) {
            network = mirrored(std::move(network));
            drive.mirrored_road = true;
            start.lane = -start.lane;
        }
        return staged_scene(drive, network, Route(network, start, drive.via));
    };
    const Scene here = scene_of(false), there = scene_of(true);
    EXPECT_EQ(here.materials, there.materials);
    std::size_t compared = 0;
    for (const Mesh& mesh : here.meshes) {
        if (!mesh.name.starts_with("bush") && !mesh.name.starts_with("field fence") && !mesh.name.starts_with("grass") &&
            !mesh.name.starts_with("patches"))
            continue;
        const auto image = std::ranges::find_if(there.meshes, [&](const Mesh& other) {
            return other.name == mesh.name && other.origin_m == glm::dvec3(mesh.origin_m.x, -mesh.origin_m.y, mesh.origin_m.z);
        });
        ASSERT_NE(image, there.meshes.end()) << mesh.name;
        ASSERT_EQ(image->vertices.size(), mesh.vertices.size());
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
            ASSERT_EQ(image->vertices[i].position_m.y, -mesh.vertices[i].position_m.y) << mesh.name;
        ++compared;
    }
    EXPECT_GT(compared, 100U);
}

TEST(Dressing, HousesKeepTheirDetailAsFarAsAPixelShowsIt) {
    RoadNetwork network = opendrive_text::library_road("straight.xodr");
    RoadObject house;
    house.type = "building";
    house.name = "house";
    house.s_m = 500.0;
    house.length_m = 12.0, house.width_m = 10.0, house.height_m = 7.0;
    const auto detail = [&](double beside_m, double pixel_rad) {
        house.t_m = beside_m;
        network.roads.front().objects = {house};
        Scene scene = build_scene(network, {.leave_out = is_dressed});
        add_dressing(scene, network, Route(network, {}), {.pixel_rad = pixel_rad});
        return triangles(scene, "house");
    };
    constexpr double finest_rad = 1e-5;
    EXPECT_LT(detail(300.0, 0.7e-3), detail(300.0, finest_rad)) << "0.14 m at 0.7 mrad: 200 m";
    EXPECT_EQ(detail(180.0, 0.7e-3), detail(180.0, finest_rad));
    EXPECT_EQ(detail(300.0, 0.4e-3), detail(300.0, finest_rad)) << "a view of finer pixels";
}

TEST(Dressing, GardensStandBetweenSidewalkAndHouseWhereThereIsRoom) {
    RoadNetwork network = opendrive_text::library_road("village.xodr");
    const Route route(network, {});
    const auto gardens = [&](const Scene& scene) { return triangles(scene, "hedge of") + triangles(scene, "fence of"); };
    const Scene scene = dressed(network, route, 1);
    EXPECT_GT(gardens(scene), 1000U);
    for (const Mesh& mesh : scene.meshes)
        if (mesh.name.starts_with("hedge of") || mesh.name.starts_with("fence of"))
            for (const Vertex& v : mesh.vertices)
                if (const double y = mesh.origin_m.y + static_cast<double>(v.position_m.y); mesh.origin_m.x < 385.0 && y > 0.0) {
                    ASSERT_GT(y, 3.15 + 2.0) << mesh.name << ": behind kerb and sidewalk";
                    ASSERT_LT(y, 14.2 - 5.0) << mesh.name << ": before the fronts";
                }
    for (Road& road : network.roads)
        for (RoadObject& object : road.objects)
            if (object.type == "building" && object.t_m > 0.0)
                object.t_m = 5.15 + 5.0 + 2.0; // fronts 2 m behind the sidewalk
            else if (object.type == "building")
                object.t_m = -7.15 - 5.0 - 2.0;
    EXPECT_LT(gardens(dressed(network, route, 1)), gardens(scene) / 4) << "those of mill lane may stay";
}

TEST(Dressing, GroundKeepsItsShapeUnderGravelMeadowsAndFields) {
    const RoadNetwork network = opendrive_text::library_road("country.xodr");
    const Scene plain = build_scene(network), scene = dressed(network, Route(network, {}), 1);
    const auto has = [&](const Mesh& mesh, Stuff stuff) {
        return std::ranges::any_of(mesh.batches,
                                   [&](const Batch& b) { return b.material == index_of(RoadMaterial::count) + index_of(stuff); });
    };
    std::size_t compared = 0, fields = 0;
    for (const Mesh& mesh : plain.meshes) {
        if (mesh.name.find("of road") == std::string::npos)
            continue;
        const auto there = std::ranges::find(scene.meshes, mesh.name, &Mesh::name);
        ASSERT_NE(there, scene.meshes.end());
        EXPECT_TRUE(std::ranges::equal(there->vertices, mesh.vertices, {}, &Vertex::position_m, &Vertex::position_m)) << mesh.name;
        EXPECT_TRUE(has(*there, Stuff::gravel) && has(*there, Stuff::meadow)) << mesh.name;
        fields += has(*there, Stuff::stubble) || has(*there, Stuff::soil) ? 1U : 0U;
        ++compared;
    }
    EXPECT_GE(compared, 50U);
    EXPECT_GT(fields, 10U);
}

TEST(Dressing, PatchesLieAMillimetreAboveAsphaltAlone) {
    const RoadNetwork network = opendrive_text::library_road("village.xodr");
    const Scene scene = dressed(network, Route(network, {}), 1);
    EXPECT_GT(triangles(scene, "patches, road 1 "), 200U);
    const std::uint32_t first = index_of(RoadMaterial::count);
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.name.starts_with("patches, road 1 "))
            continue;
        EXPECT_FALSE(mesh.casts);
        for (const Batch& batch : mesh.batches) {
            EXPECT_EQ(scene.materials[batch.material].kind, SurfaceKind::road);
            EXPECT_NE(batch.material, first + index_of(Stuff::crossing)) << "this road has none";
        }
        for (const Vertex& v : mesh.vertices) {
            const glm::dvec3 p = mesh.origin_m + glm::dvec3(v.position_m);
            ASSERT_NEAR(p.z, 0.001, 2e-4);
            ASSERT_LE(p.y, 3.0 + 1e-4);
            ASSERT_GE(p.y, -5.0 - 1e-4); // the parking lane is asphalt, too
        }
    }
}

TEST(Dressing, CrosswalksBecomeZebraCrossings) {
    RoadNetwork network = opendrive_text::library_road("straight.xodr");
    RoadObject crosswalk;
    crosswalk.type = "crosswalk";
    crosswalk.s_m = 500.0;
    crosswalk.length_m = 4.0, crosswalk.width_m = 7.0;
    network.roads.front().objects = {crosswalk};
    const Scene scene = dressed(network, Route(network, {}), 1);
    const std::uint32_t paint = index_of(RoadMaterial::count) + index_of(Stuff::crossing);
    double painted_m2 = 0.0;
    for (const Mesh& mesh : scene.meshes)
        for (const Batch& batch : mesh.batches)
            for (std::uint32_t i = batch.first; batch.material == paint && i < batch.first + batch.count; i += 3) {
                const auto at = [&](std::uint32_t k) { return glm::dvec3(mesh.vertices[mesh.indices[i + k]].position_m); };
                painted_m2 += 0.5 * glm::cross(at(1) - at(0), at(2) - at(0)).z;
            }
    // 7 stripes of 0.5 m by 4 m, but for what the lines along the road cover: at most a guide line and two edge lines of 0.12 m.
    EXPECT_LE(painted_m2, 14.0 + 1e-3);
    EXPECT_GE(painted_m2, 14.0 - 3.0 * 0.12 * 4.0);
    EXPECT_EQ(scene.materials[paint].kind, SurfaceKind::marking);
    EXPECT_EQ(scene.materials[paint].retro_rl, scene.materials[index_of(RoadMaterial::marking_white)].retro_rl);
}

/// Boxes of 1 m on a road of 16 m cells, by where they stand and how high.
TEST(LaneShades, AreThoseThatRaysFromTheLampsMeet) {
    const RoadNetwork network = opendrive_text::library_road("straight.xodr");
    const Route route(network, {});
    Scene scene;
    const auto box = [&](const char* name, double x, double y, double low_m, bool casts = true) {
        TriangleSoup soup;
        append_box(soup, {x - 0.5, y - 0.5, low_m}, {x + 0.5, y + 0.5, low_m + 0.4}, 0);
        std::vector<std::size_t> all(soup.triangles.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = i;
        scene.meshes.push_back(mesh_of(soup, all, {std::round(x), 0.0, 0.0}, name));
        scene.meshes.back().casts = casts;
    };
    const double lane = route.pose(0.0).position_m.y;
    box("before the first", 500.0, lane, 0.1);
    box("in the lane", 512.0, lane, 0.1); // across a cell's border
    box("at a cell's corner", 480.0, lane + 1.6, 0.0);
    box("two lanes away", 512.0, lane + 5.0, 0.1);
    box("over the beam", 512.0, lane, 0.7);
    box("a ghost", 520.0, lane, 0.1, false);
    box("behind the road's end", 1400.0, lane, 0.1);
    EXPECT_THAT(shades_of_lane(scene, route, 1), ::testing::ElementsAre("in the lane", "at a cell's corner"));
    EXPECT_THAT(shades_of_lane(scene, route), ::testing::SizeIs(3));
}

TEST(Dressing, CyclistsRideAndBollardsStandOnSidewalks) {
    const RoadNetwork network = opendrive_text::library_road("village.xodr");
    std::size_t cyclists = 0, bollards = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        for (const Mesh& mesh : dressed(network, Route(network, {}), seed).meshes) {
            cyclists += mesh.name.starts_with("cyclist") ? 1U : 0U;
            bollards += mesh.name.starts_with("bollards") ? 1U : 0U;
            if (mesh.name.starts_with("cyclist, road 1 ") || mesh.name.starts_with("bollards, road 1 "))
                for (const Vertex& v : mesh.vertices) {
                    const double y = mesh.origin_m.y + static_cast<double>(v.position_m.y);
                    ASSERT_TRUE((y > 3.15 && y < 5.15) || (y < -3.15 && y > -7.15)) << mesh.name << " at y = " << y;
                }
        }
    EXPECT_GE(cyclists, 3U);
    EXPECT_GE(bollards, 3U);
}

} // namespace
} // namespace fernlicht
