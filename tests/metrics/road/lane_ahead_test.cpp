// Lines of sight over a lane: a level road by similar triangles, a crest by its radius.
#include "metrics/road/lane_ahead.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

const std::filesystem::path roads = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/roads";

glm::dvec3 over(const Route& route, double at_m, double height_m) {
    const Pose surface = route.pose(at_m);
    return surface.position_m + height_m * surface.up();
}

TEST(LaneAhead, MeetsTheRoadBehindATarget) {
    const RoadNetwork network = read_opendrive(roads / "straight.xodr");
    const Route route(network, {});
    const LaneAhead lane(route, 10.0, 200.0, 1.0);
    // From 1.2 m over 10 m through 0.09 m over 62.3 m: the ground is met 1.2 / 1.11 times as far away.
    const std::optional<Pose> met = lane.behind(over(route, 10.0, 1.2), over(route, 62.3, 0.09));
    ASSERT_TRUE(met);
    EXPECT_NEAR(met->position_m.x, 10.0 + 52.3 * 1.2 / 1.11, 1e-9);
    EXPECT_NEAR(met->position_m.z, 0.0, 1e-12);
    EXPECT_FALSE(lane.behind(over(route, 10.0, 1.2), over(route, 62.3, 1.2))) << "level: meets nothing";
    EXPECT_FALSE(lane.behind(over(route, 10.0, 1.2), over(route, 205.0, 0.3))) << "beyond what is known";
    EXPECT_FALSE(lane.hides(over(route, 10.0, 0.65), over(route, 200.0, 0.09)));
}

TEST(LaneAhead, ACrestHidesWhatLiesBehind) {
    const RoadNetwork network = read_opendrive(roads / "country.xodr");
    const Route route(network, {});
    const LaneAhead lane(route, 420.0, 180.0, 1.0);
    // Over a crest of 2500 m radius 1.2 m and 0.09 m see each other within sqrt(2 r a) + sqrt(2 r b) = 77.5 + 21.2 m.
    EXPECT_FALSE(lane.hides(over(route, 425.0, 1.2), over(route, 520.0, 0.09)));
    EXPECT_TRUE(lane.hides(over(route, 425.0, 1.2), over(route, 530.0, 0.09)));
}

TEST(LaneAhead, EndsWithTheRoute) {
    const RoadNetwork network = read_opendrive(roads / "straight.xodr");
    const Route route(network, {});
    EXPECT_EQ(LaneAhead(route, route.length_m() - 10.0, 200.0, 1.0).surface().size(), 11U);
    EXPECT_EQ(LaneAhead(route, route.length_m() + 10.0, 200.0, 1.0).surface().size(), 0U);
}

} // namespace
} // namespace fernlicht
