// A mirrored road is the road in a mirror: every pose, lane and way through it, on our roads, on one of every kind of geometry, and on
// those of others where they are.
#include "scenarios/roads/road_network.h"

#include "scenarios/roads/route.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/roads/mesh_checks.h"
#include "tests/scenarios/roads/opendrive_text.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace fernlicht {
namespace {

using namespace opendrive_text;

/// Numbers only change their sign; where shapes are written anew, heights of metres are rounded at 1e-16 of 1000 m.
constexpr double rounding_m = 1e-9;

glm::dvec3 image(const glm::dvec3& v) { return {v.x, -v.y, v.z}; }

void expect_image(const Pose& found, const Pose& original, const std::string& where) {
    EXPECT_LT(glm::length(found.position_m - image(original.position_m)), rounding_m) << where;
    EXPECT_LT(glm::length(found.forward() - image(original.forward())), rounding_m) << where;
    EXPECT_LT(glm::length(found.left() + image(original.left())), rounding_m) << where << ": left is right in a mirror";
    EXPECT_LT(glm::length(found.up() - image(original.up())), rounding_m) << where;
}

void expect_mirrored(const RoadNetwork& network, const RoadNetwork& other, const std::string& name) {
    for (std::size_t r = 0; r < network.roads.size(); ++r) {
        const Road &road = network.roads[r], &turned = other.roads[r];
        EXPECT_NE(road.left_hand_traffic, turned.left_hand_traffic);
        for (int i = 0; i <= 40; ++i) {
            const double s = road.length_m * i / 40.0;
            const std::string where = fmt::format("{} road {} s {}", name, road.id, s);
            for (const double t : {-12.0, -3.0, 0.0, 1.5, 9.0})
                expect_image(surface_pose(other, turned, s, -t), surface_pose(network, road, s, t), where);
            const LaneSection &section = section_at(road, s), &there = section_at(turned, s);
            ASSERT_EQ(section.lanes.size(), there.lanes.size());
            for (const Lane& lane : section.lanes) {
                const auto found = std::ranges::find(there.lanes, -lane.id, &Lane::id);
                ASSERT_NE(found, there.lanes.end()) << where;
                if (lane.id != 0) { // the centre has no traffic
                    EXPECT_EQ(travels_with_s(road, lane), travels_with_s(turned, *found)) << where;
                }
                const LaneEdges edges = lane_edges(road, section, lane.id, s), mirrored = lane_edges(turned, there, -lane.id, s);
                EXPECT_NEAR(mirrored.inner_t_m, -edges.inner_t_m, rounding_m) << where;
                EXPECT_NEAR(mirrored.outer_t_m, -edges.outer_t_m, rounding_m) << where;
            }
        }
    }
}

std::string other_name(const std::string& lane) {
    return lane.starts_with("left") ? "right" + lane.substr(4) : lane.starts_with("right") ? "left" + lane.substr(5) : lane;
}

void expect_same_way(const RoadNetwork& network, const RoadNetwork& other, const std::string& name) {
    const Route route(network, {}), turned(other, {});
    ASSERT_NEAR(route.length_m(), turned.length_m(), 1e-6) << name;
    for (int i = 0; i <= 60; ++i) {
        const double distance = 0.999 * route.length_m() * i / 60.0;
        const std::string where = fmt::format("{} at {} m", name, distance);
        expect_image(turned.pose(distance, -1.5), route.pose(distance, 1.5), where);
        CrossSection cross = route.cross_section(distance);
        const CrossSection there = turned.cross_section(distance);
        std::ranges::reverse(cross.lanes);
        ASSERT_EQ(cross.lanes.size(), there.lanes.size()) << where;
        for (std::size_t lane = 0; lane < cross.lanes.size(); ++lane) {
            EXPECT_EQ(other_name(cross.lanes[lane].name), there.lanes[lane].name) << where;
            EXPECT_EQ(cross.lanes[lane].same_direction, there.lanes[lane].same_direction) << where;
            EXPECT_NEAR(cross.lanes[lane].left_m, -there.lanes[lane].right_m, 1e-6) << where;
        }
        EXPECT_NEAR(cross.paved_left_m, -there.paved_right_m, 1e-6) << where;
    }
}

TEST(MirroredRoad, OfOurRoadsIsTheirImage) {
    for (const auto& file : road_files(library_roads)) {
        const RoadNetwork network = read_opendrive(file), other = mirrored(network);
        expect_mirrored(network, other, file.filename());
        expect_same_way(network, other, file.filename());
    }
}

TEST(MirroredRoad, OfEveryKindOfGeometryIsItsImage) {
    const RoadNetwork network = network_of(file(R"(<road id="1" length="100" junction="-1"><planView>
        <geometry s="0" x="0" y="0" hdg="0.3" length="20"><line/></geometry>
        <geometry s="20" x="19.1" y="5.9" hdg="0.3" length="20"><arc curvature="0.01"/></geometry>
        <geometry s="40" x="37.4" y="14" hdg="0.5" length="20"><spiral curvStart="0.01" curvEnd="-0.02"/></geometry>
        <geometry s="60" x="55" y="23" hdg="0.4" length="20"><poly3 a="0" b="0" c="0.004" d="-0.0001"/></geometry>
        <geometry s="80" x="73" y="31" hdg="0.4" length="20"><paramPoly3 aU="0" bU="20" cU="0" dU="0" aV="0" bV="0" cV="1.5" dV="-0.5"/></geometry>
        </planView><elevationProfile><elevation s="0" a="2" b="0.02" c="0" d="0"/></elevationProfile>
        <lateralProfile><superelevation s="0" a="0.02" b="0.0005" c="0" d="0"/>
        <shape s="0" t="-3.5" a="0.1" b="-0.02" c="0.003" d="-0.0004"/><shape s="0" t="0" a="0.0496" b="-0.0137" c="0.01" d="0.001"/>
        <shape s="100" t="-3.5" a="0.3" b="-0.02" c="0" d="0"/><shape s="100" t="0" a="0.23" b="-0.02" c="0.01" d="0"/></lateralProfile>
        <lanes><laneOffset s="0" a="0.3" b="0.01" c="0" d="0"/><laneSection s="0">
        <left><lane id="1" type="driving"><border sOffset="0" a="3.4" b="0.01" c="0" d="0"/></lane></left>
        <center><lane id="0" type="none"><roadMark sOffset="0" type="solid broken" width="0.12"/></lane></center>
        <right><lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></right>
        </laneSection></lanes></road>)"));
    const RoadNetwork other = mirrored(network);
    ASSERT_FALSE(network.roads[0].shapes.empty());
    expect_mirrored(network, other, "every kind");
    EXPECT_EQ(other.roads[0].sections[0].lanes[1].marks[0].kind, MarkKind::broken_solid);
    expect_mirrored(other, mirrored(other), "twice");
    for (int i = 0; i <= 20; ++i)
        EXPECT_LT(glm::length(surface_pose(network, network.roads[0], 5.0 * i, 2.0).position_m -
                              surface_pose(other, mirrored(other).roads[0], 5.0 * i, 2.0).position_m),
                  rounding_m);
}

TEST(MirroredRoad, OfOthersRoadsIsTheirImage) {
    if (!std::filesystem::is_directory(shared_roads))
        GTEST_SKIP() << "no folder " << shared_roads;
    std::size_t read = 0;
    for (const auto& file : road_files(shared_roads)) {
        if (std::filesystem::file_size(file) > 300'000)
            continue;
        try {
            const RoadNetwork network = read_opendrive(file);
            expect_mirrored(network, mirrored(network), file.filename());
            ++read;
        } catch (const InputError&) { // not ours to judge here
        }
    }
    EXPECT_GT(read, 10U);
}

/// Ground by material: area, and the middle of it. Where triangles meet may differ; what they cover does not.
TEST(MirroredRoad, IsMeshedToTheImageOfTheMesh) {
    struct Cover {
        double area_m2 = 0.0;
        glm::dvec3 moment{0.0};
    };
    const auto covers = [](const Scene& scene) {
        std::map<std::string, Cover> all;
        for (const mesh_checks::Triangle& triangle : mesh_checks::triangles(scene, "")) {
            const auto& [a, b, c] = triangle.corners;
            Cover& cover = all[scene.materials[triangle.material].name];
            cover.area_m2 += triangle.area();
            cover.moment += triangle.area() / 3.0 * (a + b + c);
        }
        return all;
    };
    const RoadNetwork network = library_road("village.xodr");
    const auto original = covers(build_scene(network, {.textures = false})),
               other = covers(build_scene(mirrored(network), {.textures = false}));
    ASSERT_EQ(original.size(), other.size());
    for (const auto& [name, cover] : original) {
        const Cover& there = other.at(name);
        EXPECT_NEAR(there.area_m2, cover.area_m2, 1e-4 * cover.area_m2) << name; // float vertices, and the mesher's own error bound
        EXPECT_LT(glm::length(there.moment / there.area_m2 - image(cover.moment / cover.area_m2)), 0.05) << name;
    }
}

} // namespace
} // namespace fernlicht
