// Our own roads are what their headers say: lengths, radii, continuous lines and grades.
#include "scenarios/roads/road_network.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace fernlicht {
namespace {

RoadNetwork library_road(const char* name) {
    return read_opendrive(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/roads" / name);
}

class LibraryRoads : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(LibraryRoads, AreNamedAndReadWithoutWarning) {
    const RoadNetwork network = library_road(GetParam().first);
    EXPECT_EQ(network.name, GetParam().second);
    EXPECT_TRUE(network.warnings.empty());
}

TEST_P(LibraryRoads, ContinueFromRecordToRecord) {
    for (const Road& road : library_road(GetParam().first).roads) {
        const RoadNetwork alone;
        for (const PlanElement& element : road.plan) {
            if (element.s_m == 0.0)
                continue;
            const Pose before = plan_pose(road, element.s_m - 1e-7), after = plan_pose(road, element.s_m);
            EXPECT_LT(glm::distance(before.position_m, after.position_m), 1e-6) << "road " << road.id << " at " << element.s_m;
            EXPECT_LT(glm::distance(before.forward(), after.forward()), 1e-6) << "road " << road.id << " at " << element.s_m;
        }
        for (const Cubic& grade : road.elevation) {
            if (grade.s0 == 0.0)
                continue;
            const Pose before = surface_pose(alone, road, grade.s0 - 1e-7, 0.0), after = surface_pose(alone, road, grade.s0, 0.0);
            EXPECT_LT(std::abs(before.position_m.z - after.position_m.z), 1e-6) << "height at " << grade.s0;
            EXPECT_LT(std::abs(before.forward().z - after.forward().z), 1e-6) << "grade at " << grade.s0;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, LibraryRoads,
                         testing::Values(std::pair("bench.xodr", "fernlicht bench"), std::pair("straight.xodr", "fernlicht straight"),
                                         std::pair("s-bend.xodr", "fernlicht s-bend"), std::pair("country.xodr", "fernlicht country road"),
                                         std::pair("iihs-left-150.xodr", "fernlicht iihs-left-150"),
                                         std::pair("iihs-right-150.xodr", "fernlicht iihs-right-150"),
                                         std::pair("iihs-left-250.xodr", "fernlicht iihs-left-250"),
                                         std::pair("iihs-right-250.xodr", "fernlicht iihs-right-250"),
                                         std::pair("motorway.xodr", "fernlicht motorway"), std::pair("village.xodr", "fernlicht village")));

/// Signed radius of the reference line, left positive, from three of its points.
double radius_m(const Road& road, double s) {
    const Pose a = plan_pose(road, s - 1.0), b = plan_pose(road, s + 1.0);
    const double turn = std::asin(a.forward().x * b.forward().y - a.forward().y * b.forward().x);
    return 2.0 / turn;
}

TEST(LibraryRoadShapes, SBendHasTheFourBendsOfItsHeader) {
    const Road road = library_road("s-bend.xodr").roads.at(0);
    EXPECT_DOUBLE_EQ(road.length_m, 1560.0);
    EXPECT_NEAR(radius_m(road, 310.0), 150.0, 1e-3);
    EXPECT_NEAR(radius_m(road, 530.0), -150.0, 1e-3);
    EXPECT_NEAR(radius_m(road, 970.0), 250.0, 1e-3);
    EXPECT_NEAR(radius_m(road, 1230.0), -250.0, 1e-3);
}

TEST(LibraryRoadShapes, IihsBendsHaveTheirRadiusAndNoStepInCurvature) {
    for (const auto& [name, radius] : {std::pair("iihs-left-150.xodr", 150.0), std::pair("iihs-right-150.xodr", -150.0),
                                       std::pair("iihs-left-250.xodr", 250.0), std::pair("iihs-right-250.xodr", -250.0)}) {
        const Road road = library_road(name).roads.at(0);
        EXPECT_DOUBLE_EQ(road.length_m, 710.0);
        for (const double s : {310.0, 380.0, 450.0})
            EXPECT_NEAR(radius_m(road, s), radius, 1e-3) << name << ' ' << s;
        // Curvature along the clothoids of 100 m: linear from 0 at 200 m to 1/R at 300 m, and back from 460 m to 560 m.
        for (const double share : {0.25, 0.5, 0.75})
            for (const double s : {200.0 + 100.0 * share, 560.0 - 100.0 * share})
                EXPECT_NEAR(1.0 / radius_m(road, s), share / radius, 1e-7) << name << ' ' << s;
        EXPECT_NEAR(plan_pose(road, 100.0).forward().y, 0.0, 1e-12);
        const glm::dvec3 end = plan_pose(road, 700.0).forward();
        EXPECT_NEAR(std::atan2(end.y, end.x), 260.0 / radius, 1e-9) << "160 m of arc and twice half of 100 m";
    }
}

TEST(LibraryRoadShapes, CountryRoadHasItsCrestDipAndBanks) {
    const RoadNetwork network = library_road("country.xodr");
    const Road& road = network.roads.at(0);
    EXPECT_DOUBLE_EQ(road.length_m, 1500.0);
    const auto height = [&](double s) { return surface_pose(network, road, s, 0.0).position_m.z; };
    const auto vertical_radius = [&](double s) { return 100.0 / (height(s + 10.0) - 2.0 * height(s) + height(s - 10.0)); };
    EXPECT_NEAR(vertical_radius(500.0), -2500.0, 1.0);
    EXPECT_NEAR(vertical_radius(800.0), 1500.0, 1.0);
    EXPECT_NEAR(radius_m(road, 320.0), 280.0, 1e-2);
    EXPECT_NEAR(radius_m(road, 700.0), -180.0, 1e-2);
    const auto bank = [&](double s) { return surface_pose(network, road, s, 1.0).position_m.z - height(s); };
    EXPECT_NEAR(bank(320.0), -0.04, 1e-3) << "the left bend leans to the left";
    EXPECT_NEAR(bank(700.0), 0.05, 1e-3);
    EXPECT_GT(road.objects.size(), 100U);
    EXPECT_GE(road.signals.size(), 8U);
}

TEST(LibraryRoadShapes, MotorwayHasTwoLanesEachWay) {
    const Road road = library_road("motorway.xodr").roads.at(0);
    int left = 0, right = 0;
    for (const Lane& lane : road.sections.at(0).lanes)
        if (lane.type == "driving")
            ++(lane.id > 0 ? left : right);
    EXPECT_EQ(left, 2);
    EXPECT_EQ(right, 2);
    EXPECT_NEAR(radius_m(road, 1100.0), 2000.0, 0.1);
}

TEST(LibraryRoadShapes, VillageRoadsMeetAtTheJunction) {
    const RoadNetwork network = library_road("village.xodr");
    ASSERT_EQ(network.junctions.size(), 1U);
    EXPECT_EQ(network.junctions[0].connections.size(), 6U);
    for (const Road& road : network.roads) {
        if (road.junction == "-1")
            continue;
        ASSERT_TRUE(road.predecessor && road.successor) << road.id;
        for (const bool at_start : {true, false}) {
            const RoadLink& link = at_start ? *road.predecessor : *road.successor;
            const Road* other = network.find(link.id);
            ASSERT_NE(other, nullptr);
            const glm::dvec3 own = plan_pose(road, at_start ? 0.0 : road.length_m).position_m;
            const glm::dvec3 their = plan_pose(*other, link.contact_start ? 0.0 : other->length_m).position_m;
            EXPECT_LT(glm::distance(own, their), 1e-6) << "road " << road.id << (at_start ? " start" : " end");
        }
    }
}

} // namespace
} // namespace fernlicht
