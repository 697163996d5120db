// Strips of a cross-section: side by side, in the right colours, dashes where they belong.
#include "scenarios/roads/mesh/mesh_cross_section.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/mesh_terrain.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "tests/scenarios/roads/mesh_checks.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace fernlicht {
namespace {

using namespace mesh_checks;

Lane lane_across(int id, const char* type, double width) {
    Lane lane{.id = id, .type = type};
    if (id != 0)
        lane.widths.push_back({0.0, width, 0.0, 0.0, 0.0});
    return lane;
}

RoadMark mark(MarkKind kind, const char* colour = "white") { return {.kind = kind, .colour = colour}; }

/// 100 m, two driving lanes of 3 m; `centre` between them, `edge` at the right.
Road road_with(MarkKind centre, MarkKind edge) {
    Road road;
    road.length_m = 100.0;
    road.plan.push_back({.length_m = 100.0});
    LaneSection section{.end_m = 100.0,
                        .lanes = {lane_across(1, "driving", 3.0), lane_across(0, "none", 0.0), lane_across(-1, "driving", 3.0)}};
    section.lanes[1].marks.push_back(mark(centre));
    section.lanes[2].marks.push_back(mark(edge));
    road.sections.push_back(section);
    return road;
}

void expect_side_by_side(const std::vector<Strip>& strips) {
    for (std::size_t i = 0; i < strips.size(); ++i) {
        EXPECT_LE(strips[i].right_t_m, strips[i].left_t_m);
        if (i > 0) {
            EXPECT_DOUBLE_EQ(strips[i].right_t_m, strips[i - 1].left_t_m);
        }
    }
}

double painted_width(const std::vector<Strip>& strips) {
    double width = 0.0;
    for (const Strip& strip : strips)
        if (strip.material == RoadMaterial::marking_white || strip.material == RoadMaterial::marking_yellow)
            width += strip.left_t_m - strip.right_t_m;
    return width;
}

TEST(MeshCrossSection, BrokenLineIsThereInDashesWithStationsAtBothEnds) {
    const Road road = road_with(MarkKind::broken, MarkKind::none);
    const SectionProfile profile(road, road.sections[0]);
    EXPECT_NEAR(painted_width(profile.strips(2.0, 2.0)), 0.12, 1e-12); // 4 m dash, 8 m gap
    EXPECT_EQ(painted_width(profile.strips(6.0, 6.0)), 0.0);
    EXPECT_NEAR(painted_width(profile.strips(13.0, 13.0)), 0.12, 1e-12);
    EXPECT_EQ(profile.strips(6.0, 6.0).size(), 1U) << "lanes of one material are one strip";
    std::vector<double> stations;
    SectionProfile(road, road.sections[0]).append_stations(stations);
    for (const double expected : {0.0, 4.0, 12.0, 16.0, 96.0, 100.0})
        EXPECT_NE(std::find(stations.begin(), stations.end(), expected), stations.end()) << expected;
}

TEST(MeshCrossSection, EdgeLineStaysOnTheRoad) {
    const Road road = road_with(MarkKind::none, MarkKind::solid);
    const std::vector<Strip> strips = SectionProfile(road, road.sections[0]).strips(50.0, 50.0);
    expect_side_by_side(strips);
    EXPECT_DOUBLE_EQ(strips.front().right_t_m, -3.0);
    EXPECT_NEAR(painted_width(strips), 0.12, 1e-12);
}

TEST(MeshCrossSection, DoubleLinesHaveAGapOfTheirWidth) {
    const Road road = road_with(MarkKind::solid_solid, MarkKind::none);
    const std::vector<Strip> strips = SectionProfile(road, road.sections[0]).strips(50.0, 50.0);
    expect_side_by_side(strips);
    EXPECT_NEAR(painted_width(strips), 0.24, 1e-12);
    ASSERT_GE(strips.size(), 5U); // asphalt, line, gap, line, asphalt
    const Strip& gap = strips[2];
    EXPECT_EQ(gap.material, RoadMaterial::asphalt);
    EXPECT_NEAR(gap.left_t_m - gap.right_t_m, 0.12, 1e-12);
    EXPECT_NEAR(gap.right_t_m, -0.06, 1e-12);
}

TEST(MeshCrossSection, SolidBrokenHasTheSolidLineOnTheLeftOfTheCentre) {
    const Road road = road_with(MarkKind::solid_broken, MarkKind::none);
    const std::vector<Strip> in_gap = SectionProfile(road, road.sections[0]).strips(6.0, 6.0);
    EXPECT_NEAR(painted_width(in_gap), 0.12, 1e-12);
    for (const Strip& strip : in_gap)
        if (strip.material == RoadMaterial::marking_white) {
            EXPECT_GT(strip.right_t_m, 0.0);
        }
}

TEST(MeshCrossSection, PaintIsCutAtItsLanesAndFineDashesAreSolid) {
    Road road = road_with(MarkKind::solid, MarkKind::solid);
    road.sections[0].lanes[2].widths[0].a = 0.1;
    const std::vector<Strip> strips = SectionProfile(road, road.sections[0]).strips(50.0, 50.0);
    expect_side_by_side(strips);
    EXPECT_DOUBLE_EQ(strips.front().right_t_m, -0.1);
    EXPECT_DOUBLE_EQ(strips.back().left_t_m, 3.0);
    Road other_road = road_with(MarkKind::broken, MarkKind::none);
    other_road.sections[0].lanes[1].marks[0].stripes.push_back({0.12, 1e-6, 1e-6, 0.0, 0.0});
    const SectionProfile profile(other_road, other_road.sections[0]);
    std::vector<double> stations;
    profile.append_stations(stations);
    EXPECT_LT(stations.size(), 20U);
    EXPECT_NEAR(painted_width(profile.strips(33.0, 33.0)), 0.12, 1e-12);
}

TEST(MeshCrossSection, RaisedSidewalkHasAKerbFace) {
    Road road = road_with(MarkKind::none, MarkKind::none);
    Lane walk = lane_across(-2, "sidewalk", 2.0);
    walk.heights.push_back({0.0, 0.12, 0.15});
    road.sections[0].lanes.push_back(walk);
    const std::vector<Strip> strips = SectionProfile(road, road.sections[0]).strips(50.0, 50.0);
    expect_side_by_side(strips);
    const auto face = std::find_if(strips.begin(), strips.end(), [](const Strip& s) { return s.kerb_face && s.right_h_m != s.left_h_m; });
    ASSERT_NE(face, strips.end());
    EXPECT_DOUBLE_EQ(face->right_t_m, -3.0);
    EXPECT_DOUBLE_EQ(face->right_h_m, 0.12);
    EXPECT_DOUBLE_EQ(face->left_h_m, 0.0);
    EXPECT_DOUBLE_EQ(strips.front().right_h_m, 0.15);
}

// R_L of the road's materials in EN 1436's 30 m geometry, and what lanes and paint are made of.

/// L / E_perp in mcd/m2/lx, light at 1.24 degrees and eye at 2.29 degrees above the surface, both in one vertical plane.
double total_rl_mcd(const Material& material) {
    const double incidence_rad = 1.24 * pi / 180.0, view_rad = 2.29 * pi / 180.0;
    const double y = 0.2126 * static_cast<double>(material.albedo.r) + 0.7152 * static_cast<double>(material.albedo.g) +
                     0.0722 * static_cast<double>(material.albedo.b);
    const double diffuse = y * std::sin(incidence_rad) / pi;
    const double retro =
        static_cast<double>(material.retro_rl) * std::exp((static_cast<double>(material.retro_reference_rad) - (view_rad - incidence_rad)) /
                                                          static_cast<double>(material.retro_falloff_rad));
    return 1000.0 * (diffuse + retro);
}

const Material& named(const std::vector<Material>& all, const std::string& name) { return *std::ranges::find(all, name, &Material::name); }

TEST(MeshMaterials, RoadSurfacesHaveTheirRlAndBoardsTheirRa) {
    const std::vector<Material> all = road_materials();
    EXPECT_NEAR(total_rl_mcd(named(all, "asphalt")), 15.0, 0.01);
    EXPECT_NEAR(total_rl_mcd(named(all, "marking-white")), 150.0, 0.1);
    EXPECT_NEAR(total_rl_mcd(named(all, "marking-yellow")), 120.0, 0.1);
    Material diffuse = named(road_materials(), "asphalt");
    diffuse.retro_rl = 0.0F;
    EXPECT_NEAR(total_rl_mcd(diffuse), 0.551, 0.001); // 0.08 sin(1.24 deg) / pi
    const Material board = named(road_materials(), "board");
    EXPECT_EQ(board.kind, SurfaceKind::board);
    EXPECT_FLOAT_EQ(board.retro_rl, 180.0F);
    EXPECT_NEAR(static_cast<double>(board.retro_reference_rad), 0.33 * pi / 180.0, 1e-7);
}

TEST(MeshMaterials, AllAreNamedPhysicalAndChosenByLaneType) {
    for (const Material& material : road_materials()) {
        EXPECT_FALSE(material.name.empty());
        for (const float albedo : {material.albedo.r, material.albedo.g, material.albedo.b}) {
            EXPECT_GT(albedo, 0.0F);
            EXPECT_LT(albedo, 1.0F);
        }
        EXPECT_GE(material.retro_rl, 0.0F);
    }
    EXPECT_EQ(lane_material("driving"), RoadMaterial::asphalt);
    EXPECT_EQ(lane_material("shoulder"), RoadMaterial::asphalt);
    EXPECT_EQ(lane_material("sidewalk"), RoadMaterial::concrete);
    EXPECT_EQ(lane_material("median"), RoadMaterial::verge);
    EXPECT_EQ(lane_material("none"), RoadMaterial::verge);
    EXPECT_EQ(marking_material("yellow"), RoadMaterial::marking_yellow);
    EXPECT_EQ(marking_material("standard"), RoadMaterial::marking_white);
}

// What stands beside a road: where, how high, and which way it looks.

/// A straight level road of 100 m to the east.
RoadNetwork plain_road() {
    RoadNetwork network{.roads = {road_with(MarkKind::none, MarkKind::none)}};
    network.roads[0].id = "1";
    return network;
}

RoadObject object(const char* type, double length, double width, double height) {
    return {.id = "7", .type = type, .s_m = 50.0, .t_m = -6.0, .length_m = length, .width_m = width, .height_m = height};
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

TEST(MeshObjects, BoxesAndPostsHaveTheirSizesAndFlatThingsAreLeftOut) {
    const std::vector<Triangle> box = of_object(object("barrier", 4.0, 0.5, 1.0), "barrier");
    EXPECT_EQ(box.size(), 12U);
    expect_near(box_of(box).low, {48.0, -6.25, 0.0});
    expect_near(box_of(box).high, {52.0, -5.75, 1.0});
    for (const Triangle& triangle : box) {
        const glm::dvec3 outward = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0 - glm::dvec3(50.0, -6.0, 0.5);
        EXPECT_GT(glm::dot(triangle.cross(), outward), 0.0);
        EXPECT_GT(glm::dot(triangle.normals[0], outward), 0.0);
    }
    for (const char* type : {"crosswalk", "parkingSpace", "roadMark", "patch"})
        EXPECT_TRUE(of_object(object(type, 4.0, 3.0, 0.1), type).empty()) << type;
    EXPECT_TRUE(of_object(object("obstacle", 4.0, 3.0, 0.0), "obstacle").empty());
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
    return {.id = "9", .s_m = 50.0, .t_m = t, .z_offset_m = 2.1, .width_m = 0.9, .height_m = 0.7, .facing_forward = facing_forward};
}

TEST(MeshSignals, BoardsFaceTheTrafficAndLightsDoNotReflect) {
    const Board forward = board_of(signal(-5.0, true));
    EXPECT_LT(forward.normal.x, -0.999) << "traffic in +s comes from the west";
    EXPECT_LT(forward.box.high.x, 50.0) << "before its post";
    EXPECT_NEAR(forward.box.low.z, 2.1, 1e-3);
    EXPECT_NEAR(forward.box.high.z, 2.8, 1e-3);
    EXPECT_NEAR(forward.box.high.y - forward.box.low.y, 0.9, 1e-3);
    EXPECT_TRUE(forward.has_post);
    EXPECT_GT(board_of(signal(5.0, false)).normal.x, 0.999);
    EXPECT_FALSE(board_of(signal(-1.5, true)).has_post);
    RoadSignal light = signal(-5.0, true);
    light.dynamic = true;
    EXPECT_EQ(board_of(light).normal, glm::dvec3(0.0));
    EXPECT_TRUE(board_of(light).has_post);
}

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
