#include "scenarios/dressing/dressing.h"

#include "scenarios/dressing/dressed_object.h"
#include "scenarios/dressing/dresser.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "tests/scenarios/roads/opendrive_text.h"

#include <functional>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <set>

namespace fernlicht {
namespace {

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

TEST(Dressing, GrassGrowsAsTheGroundSlopes) {
    RoadNetwork network = opendrive_text::library_road("straight.xodr");
    constexpr double grade = 0.1;
    network.roads.front().elevation = {Cubic{0.0, 0.0, grade, 0.0, 0.0}};
    Scene scene = build_scene(network, {.leave_out = is_dressed});
    add_dressing(scene, network, Route(network, {}), {});
    std::size_t blades = 0;
    for (const Mesh& mesh : scene.meshes)
        if (mesh.name.starts_with("grass"))
            for (const Vertex& v : mesh.vertices) {
                ASSERT_NEAR(v.normal.x / v.normal.z, -grade, 0.001) << "or lamps below it would not light it";
                ++blades;
            }
    EXPECT_GT(blades, 1000U);
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

/// Corners of all triangles of the meshes that `of` takes, in the world, sorted.
std::vector<std::array<double, 9>> sorted_triangles(const Scene& scene, const std::function<bool(const Mesh&)>& of) {
    std::vector<std::array<double, 9>> out;
    for (const Mesh& mesh : scene.meshes)
        for (std::size_t i = 0; of(mesh) && i + 2 < mesh.indices.size(); i += 3) {
            std::array<double, 9>& triangle = out.emplace_back();
            for (std::size_t k = 0; k < 9; ++k)
                triangle[k] = mesh.origin_m[static_cast<int>(k % 3)] +
                              static_cast<double>(mesh.vertices[mesh.indices[i + k / 3]].position_m[static_cast<int>(k % 3)]);
        }
    std::ranges::sort(out);
    return out;
}

TEST(Dressing, MapsMeasureTheGroundWithoutDitchesUnderGravelMeadowsAndFields) {
    const RoadNetwork network = opendrive_text::library_road("country.xodr");
    const Scene plain = build_scene(network), scene = dressed(network, Route(network, {}), 1);
    const auto is_measured = [](const Mesh& mesh) {
        return mesh.name.find("of road") != std::string::npos && !mesh.name.starts_with("ditch");
    };
    EXPECT_EQ(sorted_triangles(scene, is_measured), sorted_triangles(plain, is_measured));
    std::set<std::string> stuffs;
    for (const Mesh& mesh : scene.meshes)
        for (const Batch& batch : mesh.batches)
            if (is_measured(mesh))
                stuffs.insert(scene.materials[batch.material].name);
    EXPECT_EQ(stuffs, (std::set<std::string>{"gravel", "meadow", "soil", "stubble"}));
}

TEST(Dressing, DitchesAreSeenInTheGroundThatIsMeasuredAlone) {
    const RoadNetwork network = opendrive_text::library_road("country.xodr");
    const Scene scene = dressed(network, Route(network, {}), 1);
    const auto is_ditch = [](const Mesh& mesh) { return mesh.name.starts_with("ditch"); };
    double seen_m2 = 0.0, measured_m2 = 0.0, steepest = 0.0;
    const auto plan_m2 = [](const std::array<double, 9>& t) {
        return 0.5 * std::abs((t[3] - t[0]) * (t[7] - t[1]) - (t[6] - t[0]) * (t[4] - t[1]));
    };
    for (const auto& t : sorted_triangles(scene, is_ditch)) {
        seen_m2 += plan_m2(t);
        const glm::dvec3 n =
            glm::cross(glm::dvec3(t[3] - t[0], t[4] - t[1], t[5] - t[2]), glm::dvec3(t[6] - t[0], t[7] - t[1], t[8] - t[2]));
        steepest = std::max(steepest, std::hypot(n.x, n.y) / n.z);
    }
    for (const auto& t : sorted_triangles(scene, &Mesh::measured_alone))
        measured_m2 += plan_m2(t);
    EXPECT_GT(seen_m2, 2000.0);
    EXPECT_NEAR(seen_m2, measured_m2, 1e-3 * measured_m2) << "one lies over the other";
    EXPECT_NEAR(steepest, 0.5 / 0.75 + 0.26 / 3.5, 0.05) << "1 : 1.5 under ground that falls by 0.26 m over 3.5 m";
    double most_tilted = 0.0; // away from a road on the way east, which falls by 0.26 m over 3.5 m beside it
    const Scene straight =
        dressed(opendrive_text::library_road("straight.xodr"), Route(opendrive_text::library_road("straight.xodr"), {}), 1);
    for (const Mesh& mesh : straight.meshes)
        if (is_ditch(mesh))
            for (const Vertex& v : mesh.vertices)
                most_tilted = std::max(most_tilted, static_cast<double>(v.normal.y / v.normal.z) *
                                                        (mesh.origin_m.y + static_cast<double>(v.position_m.y) > 0.0 ? 1.0 : -1.0));
    EXPECT_GT(most_tilted, 0.01);
    EXPECT_LT(most_tilted, 0.26 / 3.5 + 0.01) << "a slope that faces away is lit as the ground";
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_FALSE(mesh.casts && (mesh.measured_alone || is_ditch(mesh))) << mesh.name << ": one would speckle the other";
        for (const Batch& batch : mesh.batches)
            EXPECT_TRUE(!is_ditch(mesh) || !is_ground(scene.materials[batch.material].kind)) << mesh.name;
    }
}

TEST(Dressing, DitchesOfAMirroredRoadChangeSides) {
    const RoadNetwork network = opendrive_text::library_road("country.xodr"), image = mirrored(network);
    std::size_t dug = 0;
    for (std::size_t i = 0; i < network.roads.size(); ++i)
        for (double s = 0.0; s < network.roads[i].length_m; s += 5.0)
            for (const bool left : {true, false}) {
                const bool here = has_ditch(network.roads[i], left, {s, s}, 1);
                EXPECT_EQ(has_ditch(image.roads[i], !left, {s, s}, 1, true), here) << s;
                dug += here ? 1U : 0U;
            }
    EXPECT_GT(dug, 100U);
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
