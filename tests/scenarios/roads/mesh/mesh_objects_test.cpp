// What stands beside a road: where, how high, and which way it looks.
#include "scenarios/roads/mesh/mesh_objects.h"
#include "tests/scenarios/roads/mesh_checks.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using namespace mesh_checks;

/// A straight level road of 100 m to the east.
RoadNetwork plain_road() {
    Road road;
    road.id = "1";
    road.length_m = 100.0;
    PlanElement element;
    element.length_m = 100.0;
    road.plan.push_back(element);
    LaneSection section;
    section.end_m = 100.0;
    for (const int id : {1, 0, -1}) {
        Lane lane;
        lane.id = id;
        if (id != 0)
            lane.widths.push_back({0.0, 3.0, 0.0, 0.0, 0.0});
        section.lanes.push_back(lane);
    }
    road.sections.push_back(section);
    RoadNetwork network;
    network.roads.push_back(road);
    return network;
}

RoadObject object(const char* type, double length, double width, double height) {
    RoadObject object;
    object.id = "7";
    object.type = type;
    object.s_m = 50.0;
    object.t_m = -6.0;
    object.length_m = length;
    object.width_m = width;
    object.height_m = height;
    return object;
}

struct Box {
    glm::dvec3 low{1e9}, high{-1e9};
};

Box box_of(const std::vector<Triangle>& all) {
    Box box;
    for (const Triangle& triangle : all)
        for (const glm::dvec3& corner : triangle.corners) {
            box.low = glm::min(box.low, corner);
            box.high = glm::max(box.high, corner);
        }
    return box;
}

std::vector<Triangle> of_object(const RoadObject& one, const std::string& mesh_name) {
    RoadNetwork network = plain_road();
    network.roads[0].objects.push_back(one);
    return triangles(build_scene(network), mesh_name);
}

void expect_near(const glm::dvec3& found, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(found, expected), 1e-3) << found.x << " " << found.y << " " << found.z;
}

TEST(MeshObjects, BoxHasItsSizeAndFacesOutwards) {
    const std::vector<Triangle> box = of_object(object("barrier", 4.0, 0.5, 1.0), "barrier");
    EXPECT_EQ(box.size(), 12U);
    expect_near(box_of(box).low, {48.0, -6.25, 0.0});
    expect_near(box_of(box).high, {52.0, -5.75, 1.0});
    for (const Triangle& triangle : box) {
        const glm::dvec3 outward = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0 - glm::dvec3(50.0, -6.0, 0.5);
        EXPECT_GT(glm::dot(triangle.cross(), outward), 0.0);
        EXPECT_GT(glm::dot(triangle.normals[0], outward), 0.0);
    }
}

TEST(MeshObjects, FlatThingsAreLeftOut) {
    for (const char* type : {"crosswalk", "parkingSpace", "roadMark", "patch"})
        EXPECT_TRUE(of_object(object(type, 4.0, 3.0, 0.1), type).empty()) << type;
    EXPECT_TRUE(of_object(object("obstacle", 4.0, 3.0, 0.0), "obstacle").empty());
}

TEST(MeshObjects, PostIsRoundWithALid) {
    const std::vector<Triangle> post = of_object(object("pole", 0.0, 0.0, 5.0), "pole");
    EXPECT_EQ(post.size(), 12U * 2U + 10U);
    EXPECT_NEAR(box_of(post).high.z, 5.0, 1e-3);
}

TEST(MeshObjects, TreeStandsOnTheGroundAndEndsAtItsHeight) {
    RoadObject tree = object("tree", 0.0, 0.0, 12.0);
    tree.radius_m = 2.0;
    const Box box = box_of(of_object(tree, "trees"));
    EXPECT_NEAR(box.low.z, 0.0, 1e-3);
    EXPECT_NEAR(box.high.z, 12.0, 1e-3);
    EXPECT_NEAR(box.high.x, 52.0, 1e-3);
}

TEST(MeshObjects, DelineatorReflectsBothWays) {
    RoadObject post = object("pole", 0.1, 0.12, 1.0);
    post.name = "delineator";
    bool west = false, east = false;
    for (const Triangle& triangle : of_object(post, "delineator"))
        if (triangle.material == index_of(RoadMaterial::board)) {
            west = west || triangle.normals[0].x < -0.99;
            east = east || triangle.normals[0].x > 0.99;
        }
    EXPECT_TRUE(west && east);
}

TEST(MeshObjects, ConcaveOutlineGetsAWholeRoof) {
    const std::vector<glm::dvec3> ell{{0, 0, 3}, {4, 0, 3}, {4, 1, 3}, {1, 1, 3}, {1, 3, 3}, {0, 3, 3}};
    double area = 0.0;
    for (const auto& ear : triangulated(ell))
        area += 0.5 * glm::length(glm::cross(ell[ear[1]] - ell[ear[0]], ell[ear[2]] - ell[ear[0]]));
    EXPECT_NEAR(area, 4.0 + 2.0, 1e-12);
    EXPECT_TRUE(triangulated({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, -1, 0}}).empty()) << "crosses itself";
}

struct Board {
    Box box;
    glm::dvec3 normal{0.0};
    bool has_post = false;
};

Board board_of(const RoadSignal& signal) {
    RoadNetwork network = plain_road();
    network.roads[0].signals.push_back(signal);
    std::vector<Triangle> front;
    Board board;
    for (const Triangle& triangle : triangles(build_scene(network), "signal 9")) {
        if (triangle.material == index_of(RoadMaterial::board))
            front.push_back(triangle);
        board.has_post = board.has_post || triangle.material == index_of(RoadMaterial::post);
    }
    board.box = box_of(front);
    board.normal = front.empty() ? glm::dvec3(0.0) : front.front().normals[0];
    return board;
}

RoadSignal signal(double t, bool facing_forward) {
    RoadSignal signal;
    signal.id = "9";
    signal.s_m = 50.0;
    signal.t_m = t;
    signal.z_offset_m = 2.1;
    signal.width_m = 0.9;
    signal.height_m = 0.7;
    signal.facing_forward = facing_forward;
    return signal;
}

TEST(MeshSignals, BoardFacesTheTrafficItIsFor) {
    const Board forward = board_of(signal(-5.0, true));
    EXPECT_LT(forward.normal.x, -0.999) << "traffic in +s comes from the west";
    EXPECT_LT(forward.box.high.x, 50.0) << "before its post";
    EXPECT_NEAR(forward.box.low.z, 2.1, 1e-3);
    EXPECT_NEAR(forward.box.high.z, 2.8, 1e-3);
    EXPECT_NEAR(forward.box.high.y - forward.box.low.y, 0.9, 1e-3);
    EXPECT_TRUE(forward.has_post);
    EXPECT_GT(board_of(signal(5.0, false)).normal.x, 0.999);
}

TEST(MeshSignals, NoPostStandsOnALane) { EXPECT_FALSE(board_of(signal(-1.5, true)).has_post); }

TEST(MeshSignals, TrafficLightsDoNotReflect) {
    RoadSignal light = signal(-5.0, true);
    light.dynamic = true;
    EXPECT_EQ(board_of(light).normal, glm::dvec3(0.0));
    EXPECT_TRUE(board_of(light).has_post);
}

} // namespace
} // namespace fernlicht
