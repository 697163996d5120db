// The car on its road, and its lamps at a moment.
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

constexpr double wheelbase_m = 2.7;

/// One road of 500 m with one lane, right of its reference line, 3.5 m wide.
RoadNetwork network(PlanElement plan, std::vector<Cubic> elevation = {}, std::vector<Cubic> superelevation = {}) {
    plan.length_m = 500.0;
    Lane lane;
    lane.id = -1;
    lane.widths = {{0.0, 3.5, 0.0, 0.0, 0.0}};
    LaneSection section;
    section.end_m = 500.0;
    section.lanes = {Lane{}, lane};
    section.lanes[0].type = "none";
    Road road;
    road.id = "1";
    road.length_m = 500.0;
    road.plan = {plan};
    road.elevation = std::move(elevation);
    road.superelevation = std::move(superelevation);
    road.sections = {section};
    RoadNetwork result;
    result.roads = {road};
    return result;
}

PlanElement straight() { return {}; }
PlanElement bend(double radius_m) {
    PlanElement plan;
    plan.shape = Arc{1.0 / radius_m};
    return plan;
}

double pitch_rad(const Pose& pose) { return std::atan2(pose.forward().z, std::hypot(pose.forward().x, pose.forward().y)); }
double roll_rad(const Pose& pose) { return std::atan2(pose.left().z, pose.up().z); }

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(EgoPose, FlatAndStraight) {
    const RoadNetwork roads = network(straight());
    const Pose ego = ego_pose(Route(roads, {}), 100.0, wheelbase_m);
    expect_near(ego.position_m, {100.0, -1.75, 0.0}, 1e-9);
    expect_near(ego.forward(), {1.0, 0.0, 0.0}, 1e-12);
    expect_near(ego.up(), {0.0, 0.0, 1.0}, 1e-12);
}

TEST(EgoPose, AConstantGradeIsThePitch) {
    const RoadNetwork roads = network(straight(), {{0.0, 5.0, 0.06, 0.0, 0.0}});
    EXPECT_NEAR(pitch_rad(ego_pose(Route(roads, {}), 100.0, wheelbase_m)), std::atan(0.06), 1e-9);
}

/// Distance along the route, which runs over hill and dale, at which the road's own s is reached.
double distance_at(const Route& route, double s_m) {
    double before = 0.0, after = route.length_m();
    for (int i = 0; i < 60; ++i)
        (route.place((before + after) / 2.0).second < s_m ? before : after) = (before + after) / 2.0;
    return before;
}

TEST(EgoPose, OverACrestBothAxlesDecide) {
    // z = -0.005 (s - 100)^2: with one axle on each side of the top, equally far, the car is level though the rear stands on a slope.
    const RoadNetwork roads = network(straight(), {{0.0, -0.5, 0.0, 0.0, 0.0}, {90.0, -0.5, 0.1, -0.005, 0.0}});
    const Route route(roads, {});
    const double half_m = wheelbase_m / 2.0;
    EXPECT_NEAR(pitch_rad(ego_pose(route, distance_at(route, 100.0 - half_m), wheelbase_m)), 0.0, 1e-5);
    EXPECT_NEAR(pitch_rad(route.pose(distance_at(route, 100.0 - half_m))), std::atan(0.01 * half_m), 1e-6);
    // Of a parabola the chord's slope is that in its middle. The wheelbase lies along the slope: 2 mm shorter seen from above.
    EXPECT_NEAR(pitch_rad(ego_pose(route, distance_at(route, 103.0), wheelbase_m)), std::atan(-0.01 * (3.0 + half_m)), 3e-5);
}

TEST(EgoPose, HeadingIsTheLanesAtTheRearAxle) {
    const RoadNetwork roads = network(bend(150.0));
    const Route route(roads, {});
    const Pose ego = ego_pose(route, 200.0, wheelbase_m);
    expect_near(ego.forward(), route.pose(200.0).forward(), 1e-9);
    expect_near(ego.position_m, route.pose(200.0).position_m, 1e-12);
    expect_near(ego.up(), {0.0, 0.0, 1.0}, 1e-9);
}

TEST(EgoPose, ABankedRoadRollsTheCar) {
    const RoadNetwork roads = network(straight(), {}, {{0.0, 0.05, 0.0, 0.0, 0.0}});
    const Pose ego = ego_pose(Route(roads, {}), 100.0, wheelbase_m);
    EXPECT_NEAR(roll_rad(ego), 0.05, 1e-9);
    EXPECT_NEAR(pitch_rad(ego), 0.0, 1e-9);
}

TEST(EgoPose, IsAFrameEverywhereAndContinuousToTheEnd) {
    const RoadNetwork roads = network(bend(-60.0), {{0.0, 0.0, 0.01, 1e-4, -1e-6}}, {{0.0, 0.0, 1e-4, 0.0, 0.0}});
    const Route route(roads, {});
    Pose before = ego_pose(route, 0.0, wheelbase_m);
    for (double s = 0.05; s <= route.length_m(); s += 0.05) {
        const Pose ego = ego_pose(route, s, wheelbase_m);
        const glm::dmat3 product = glm::transpose(ego.axes) * ego.axes;
        for (int i = 0; i < 3; ++i)
            expect_near(product[i], glm::dmat3(1.0)[i], 1e-12);
        EXPECT_GT(glm::dot(glm::cross(ego.forward(), ego.left()), ego.up()), 0.999) << s;
        EXPECT_LT(glm::length(ego.forward() - before.forward()), 0.05 / 60.0 * 1.5 + 5e-4) << s;
        before = ego;
    }
}

struct MomentTest : testing::Test {
    MomentTest() {
        drive.speed = {{0.0, 10.0}};
        drive.step_s = 1.0 / 30.0;
        drive.duration_s = 10.0;
        drive.daylight = {"moon", 0.2};
        MountedLamp lamp;
        lamp.name = "left";
        lamp.file = std::make_shared<const LampFile>();
        lamp.position_m = {3.4, 0.6, 0.65};
        lamp.pitch_rad = radians(-1.0);
        variant.lamps = {lamp, lamp};
        variant.lamps[1].name = "right";
        variant.lamps[1].position_m.y = -0.6;
    }
    Moment at(int tick) {
        return moment_at({tick, tick * drive.step_s, distance_m(drive.speed, tick * drive.step_s), 10.0}, drive, route, variant);
    }

    RoadNetwork roads = network(straight(), {{0.0, 0.0, 0.02, 0.0, 0.0}});
    Route route{roads, {}};
    Drive drive;
    Variant variant{"v", {}, {}};
};

TEST_F(MomentTest, LampsRideOnTheCar) {
    const Moment moment = at(60);
    EXPECT_EQ(moment.tick, 60);
    EXPECT_DOUBLE_EQ(moment.distance_m, 20.0);
    EXPECT_EQ(moment.daylight.name, "moon");
    ASSERT_EQ(moment.lamps.size(), 2U);
    expect_near(to_local(moment.ego, moment.lamps[0].pose.position_m), {3.4, 0.6, 0.65}, 1e-12);
    expect_near(to_local(moment.ego, moment.lamps[1].pose.position_m), {3.4, -0.6, 0.65}, 1e-12);
    EXPECT_NEAR(pitch_rad(moment.lamps[0].pose), std::atan(0.02) + radians(-1.0), 1e-9);
    EXPECT_EQ(moment.lamps[0].intensity_factor, 1.0);
}

TEST_F(MomentTest, ChangesHoldFromTheirMomentOn) {
    const auto other = std::make_shared<const LampFile>();
    for (int second = 1; second <= 9; ++second) {
        LampChange dip{static_cast<double>(second), "left", second * 0.1, {}, {}, {}, nullptr, {}, {}};
        if (second == 5)
            dip.file = other;
        if (second == 6)
            dip.pitch_rad = radians(-2.0);
        variant.changes.push_back(dip);
    }
    for (int second = 1; second <= 9; ++second) {
        // On the tick itself: 30 * second * (1 / 30) s may lie a rounding error before the second.
        EXPECT_DOUBLE_EQ(at(30 * second).lamps[0].intensity_factor, second * 0.1) << second;
        EXPECT_DOUBLE_EQ(at(30 * second - 1).lamps[0].intensity_factor, second == 1 ? 1.0 : (second - 1) * 0.1) << second;
        EXPECT_EQ(at(30 * second).lamps[1].intensity_factor, 1.0) << "the right lamp was not named";
    }
    EXPECT_EQ(at(149).lamps[0].file, variant.lamps[0].file);
    EXPECT_EQ(at(150).lamps[0].file, other);
    EXPECT_NEAR(pitch_rad(at(179).lamps[0].pose), std::atan(0.02) + radians(-1.0), 1e-9);
    EXPECT_NEAR(pitch_rad(at(299).lamps[0].pose), std::atan(0.02) + radians(-2.0), 1e-9);
}

TEST_F(MomentTest, AShortRouteCutsTheDrive) {
    drive.duration_s = 100.0;
    drive.bumper_m = 3.6;
    fit_to_route(drive, route);
    const double last_m = distance_m(drive.speed, (tick_count(drive) - 1) * drive.step_s);
    EXPECT_LE(last_m + drive.bumper_m, route.length_m());
    EXPECT_GT(last_m + drive.bumper_m + 10.0 * drive.step_s, route.length_m());
    ASSERT_EQ(drive.notes.size(), 1U);
    EXPECT_THAT(drive.notes[0], HasSubstr("instead of 100 s"));
    const Drive once = drive;
    fit_to_route(drive, route);
    EXPECT_EQ(drive.duration_s, once.duration_s) << "a drive that fits is left alone";
    EXPECT_EQ(drive.notes.size(), 1U);
}

TEST_F(MomentTest, ACarThatStandsBeyondTheEndIsRefused) {
    drive.bumper_m = 501.0;
    EXPECT_THROW(fit_to_route(drive, route), InputError);
}

} // namespace
} // namespace fernlicht
