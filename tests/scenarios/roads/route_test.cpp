#include "scenarios/roads/route.h"

#include "scenarios/values/errors.h"
#include "tests/scenarios/roads/opendrive_text.h"
#include "tests/trial.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using namespace opendrive_text;
using testing::HasSubstr;

RoadNetwork network_with(const std::string& roads) { return network_of(file(roads)); }

std::string refusal(const RoadNetwork& network, const Route::Start& start, const std::vector<std::string>& via = {}) {
    return tests::refusal_of([&] { const Route route(network, start, via); }, "");
}

void expect_position(const Pose& pose, double x, double y, double tolerance = 1e-9) {
    EXPECT_NEAR(pose.position_m.x, x, tolerance);
    EXPECT_NEAR(pose.position_m.y, y, tolerance);
}

TEST(Route, RightLanesRunAlongSAndLeftOnesAgainstIt) {
    const RoadNetwork network = network_with(road({}));
    const Route route(network, {});
    EXPECT_NEAR(route.length_m(), 100.0, 1e-9);
    expect_position(route.pose(30.0), 30.0, -1.75);
    expect_position(route.pose(30.0, 1.0), 30.0, -0.75);
    EXPECT_NEAR(route.pose(30.0).forward().x, 1.0, 1e-12);
    EXPECT_NEAR(route.pose(30.0).up().z, 1.0, 1e-12);
    expect_position(route.pose(-5.0), 0.0, -1.75);
    expect_position(route.pose(500.0), 100.0, -1.75);
    const Route other_route(network, {"1", 1, 100.0});
    expect_position(other_route.pose(30.0), 70.0, 1.75);
    expect_position(other_route.pose(30.0, 1.0), 70.0, 0.75); // left of one who drives towards -x is -y
    EXPECT_NEAR(other_route.pose(30.0).forward().x, -1.0, 1e-12);
    EXPECT_NEAR(other_route.pose(30.0).left().y, -1.0, 1e-12);
    EXPECT_EQ(other_route.place(30.0).first, "1");
    EXPECT_NEAR(other_route.place(30.0).second, 70.0, 1e-9);
}

TEST(Route, LeftHandTrafficStartsOnTheLeft) {
    const RoadNetwork network = network_with(road({.attributes = R"(rule="LHT" junction="-1")"}));
    const Route route(network, {});
    expect_position(route.pose(30.0), 30.0, 1.75);
    EXPECT_NEAR(route.pose(30.0).forward().x, 1.0, 1e-12);
    const Route other(network, {"1", -1, 100.0});
    expect_position(other.pose(30.0), 70.0, -1.75);
}

TEST(Route, CrossSectionAsTheDriverSeesIt) {
    const RoadNetwork network = network_with(road({.lanes = section(0.0, lane(2, "1.5", {}, "sidewalk") + lane(1, "3.0"),
                                                                    lane(-1, "3.5") + lane(-2, "2.0", {}, "shoulder") + lane(-3, "0"))}));
    const CrossSection ahead = Route(network, {}).cross_section(10.0);
    ASSERT_EQ(ahead.lanes.size(), 4U);
    const std::vector<std::string> names{"left 2", "left 1", "own", "right 1"};
    const std::vector<double> left{6.25, 4.75, 1.75, -1.75};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(ahead.lanes[i].name, names[i]);
        EXPECT_NEAR(ahead.lanes[i].left_m, left[i], 1e-12);
    }
    EXPECT_NEAR(ahead.lanes[3].right_m, -3.75, 1e-12);
    EXPECT_FALSE(ahead.lanes[1].same_direction);
    EXPECT_TRUE(ahead.lanes[3].same_direction);
    EXPECT_NEAR(ahead.paved_left_m, 4.75, 1e-12);
    EXPECT_NEAR(ahead.paved_right_m, -3.75, 1e-12);

    const CrossSection back = Route(network, {"1", 1, 100.0}).cross_section(10.0);
    ASSERT_EQ(back.lanes.size(), 4U);
    EXPECT_EQ(back.lanes.front().type, "shoulder");
    EXPECT_EQ(back.lanes.front().name, "left 2");
    EXPECT_EQ(back.lanes[2].name, "own");
    EXPECT_EQ(back.lanes[3].type, "sidewalk");
    EXPECT_NEAR(back.lanes.front().left_m, 1.5 + 5.5, 1e-12);
    EXPECT_NEAR(back.paved_right_m, -1.5, 1e-12);
}

/// On a circle the lane's centre is longer or shorter than the reference line by its radius.
TEST(Route, DistanceIsThatOfTheLane) {
    const RoadNetwork network = network_with(road({.plan = geometry(0.0, 0.0, 0.0, 0.0, 100.0, R"(<arc curvature="0.02"/>)")}));
    const Route outer(network, {});
    EXPECT_NEAR(outer.length_m(), 100.0 * (50.0 + 1.75) / 50.0, 1e-9);
    const double turned = 20.0 / 51.75;
    expect_position(outer.pose(20.0), 51.75 * std::sin(turned), 50.0 - 51.75 * std::cos(turned));
    EXPECT_NEAR(Route(network, {"1", 1, 100.0}).length_m(), 100.0 * 48.25 / 50.0, 1e-9);
}

/// Over a grade, with roll, widening lanes, a lane offset, spirals: equal distances are equal metres.
TEST(Route, DistanceIsMetresOnTheSurface) {
    RoadText text{.length = "200"};
    text.plan = geometry(0.0, 0.0, 0.0, 0.3, 60.0, R"(<spiral curvStart="0" curvEnd="0.02"/>)");
    PlanElement first;
    first.heading_rad = 0.3, first.length_m = 60.0, first.shape = Spiral{0.0, 0.02};
    const PlanPoint joint = plan_point(first, 60.0);
    text.plan += geometry(60.0, joint.x_m, joint.y_m, joint.heading_rad, 140.0, R"(<spiral curvStart="0.02" curvEnd="-0.03"/>)");
    text.profiles = R"(<elevationProfile><elevation s="0" a="5" b="0.06" c="0.0004" d="-4e-6"/></elevationProfile>
        <lateralProfile><superelevation s="0" a="0" b="0" c="0" d="0"/><superelevation s="30" a="0" b="0.002" c="0" d="0"/>
        <superelevation s="60" a="0.06" b="0" c="0" d="0"/></lateralProfile>)";
    text.lanes = R"(<laneOffset s="0" a="0" b="0" c="0" d="0"/><laneOffset s="80" a="0" b="0.01" c="0" d="0"/>)" +
                 section(0.0, "", R"(<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0.0001" d="-5e-7"/></lane>)");
    const RoadNetwork network = network_with(road(text));
    const Route route(network, {});
    double worst = 0.0, walked = 0.0;
    for (double d = 0.0; d + 0.05 <= route.length_m(); d += 0.05) {
        const double step = glm::distance(route.pose(d).position_m, route.pose(d + 0.05).position_m);
        walked += step;
        worst = std::max(worst, std::abs(step / 0.05 - 1.0));
    }
    EXPECT_LT(worst, 2e-5); // measured 9e-6: Hermite interpolation on cells of 5 m; chords of 5 cm are shorter by 4e-8
    EXPECT_NEAR(walked, route.length_m(), 0.05);
}

TEST(Route, PoseIsOrthonormalAndAlongTheLane) {
    RoadText text;
    text.profiles = R"(<elevationProfile><elevation s="0" a="0" b="0.1" c="0" d="0"/></elevationProfile>
        <lateralProfile><superelevation s="0" a="0.05" b="0" c="0" d="0"/></lateralProfile>)";
    text.lanes = section(0.0, lane(1), R"(<lane id="-1" type="driving"><width sOffset="0" a="2" b="0.02" c="0" d="0"/></lane>)");
    const RoadNetwork network = network_with(road(text));
    for (const auto& start : {Route::Start{"1", -1, 0.0}, Route::Start{"1", 1, 100.0}}) {
        const Route route(network, start);
        for (double d = 1.0; d < 90.0; d += 10.0) {
            const Pose pose = route.pose(d, 0.3), ahead = route.pose(d + 1e-4, 0.3);
            EXPECT_NEAR(glm::length(glm::cross(pose.forward(), pose.left()) - pose.up()), 0.0, 1e-12);
            EXPECT_GT(pose.up().z, 0.9);
            EXPECT_NEAR(glm::length(glm::normalize(ahead.position_m - pose.position_m) - pose.forward()), 0.0, 1e-6);
        }
    }
}

TEST(Route, FollowsLaneLinksOverSections) {
    const RoadNetwork network = network_with(road(
        {.lanes = section(0.0, "", lane(-1, "3.5", R"(<successor id="-2"/>)")) +
                  section(40.0, "",
                          lane(-1, "3", R"(<successor id="-1"/>)") + lane(-2, "3.5", R"(<predecessor id="-1"/><successor id="-1"/>)")) +
                  section(70.0, "", lane(-1, "3.5", R"(<predecessor id="-2"/>)"))}));
    const Route route(network, {});
    ASSERT_EQ(route.legs().size(), 3U);
    EXPECT_EQ(route.legs()[1].lane, -2);
    EXPECT_NEAR(route.legs()[2].start_m, 70.0, 1e-9);
    expect_position(route.pose(50.0), 50.0, -3.0 - 1.75);
    expect_position(route.pose(80.0), 80.0, -1.75);
}

TEST(Route, LaneWithoutLinkGoesOnWhereItsCentreDoes) {
    RoadText text{.lanes = section(0.0, lane(1), lane(-1)) + section(50.0, lane(1), lane(-1, "3.4"))};
    const RoadNetwork same = network_with(road(text));
    EXPECT_NEAR(Route(same, {}).length_m(), 100.0, 1e-6);
    text.lanes = section(0.0, lane(1), lane(-1)) + section(50.0, lane(1), lane(-1, "8"));
    const RoadNetwork ends = network_with(road(text));
    EXPECT_NEAR(Route(ends, {}).length_m(), 50.0, 1e-9);
}

/// Two roads end to end, the second one drawn against the first.
TEST(Route, CrossesARoadBorderIntoAReversedRoad) {
    RoadText first, second;
    first.link = R"(<successor elementType="road" elementId="2" contactPoint="end"/>)";
    first.lanes = section(0.0, lane(1, "3.5", R"(<successor id="-1"/>)"), lane(-1, "3.5", R"(<successor id="1"/>)"));
    second.id = "2";
    second.link = R"(<successor elementType="road" elementId="1" contactPoint="end"/>)";
    second.plan = geometry(0.0, 200.0, 0.0, pi, 100.0);
    second.lanes = section(0.0, lane(1, "3.5", R"(<successor id="-1"/>)"), lane(-1, "3.5", R"(<successor id="1"/>)"));
    const RoadNetwork network = network_with(road(first) + road(second));
    EXPECT_TRUE(network.warnings.empty()) << network.warnings.front();
    const Route route(network, {});
    EXPECT_NEAR(route.length_m(), 200.0, 1e-9);
    EXPECT_FALSE(route.legs()[1].with_s);
    expect_position(route.pose(150.0), 150.0, -1.75);
    EXPECT_NEAR(route.pose(150.0).forward().x, 1.0, 1e-12);
    EXPECT_EQ(route.place(150.0), (std::pair<std::string, double>("2", 50.0)));
}

/// A road into a junction with a straight connecting road and one to the left.
std::string fork() {
    RoadText in, straight, left, ahead, aside;
    const std::string both = R"(<predecessor id="-1"/><successor id="-1"/>)";
    in.link = R"(<successor elementType="junction" elementId="9"/>)";
    in.lanes = section(0.0, "", lane(-1));
    const auto connecting = [&](RoadText& r, const std::string& id, const std::string& next, const std::string& plan) {
        r.id = id, r.length = "20", r.plan = plan, r.attributes = R"(junction="9")";
        r.link = R"(<predecessor elementType="road" elementId="1" contactPoint="end"/><successor elementType="road" elementId=")" + next +
                 R"(" contactPoint="start"/>)";
        r.lanes = section(0.0, "", lane(-1, "3.5", both));
    };
    const double radius = 20.0 / (pi / 2.0);
    connecting(left, "11", "3", geometry(0.0, 100.0, 0.0, 0.0, 20.0, fmt::format(R"(<arc curvature="{}"/>)", 1.0 / radius)));
    connecting(straight, "10", "2", geometry(0.0, 100.0, 0.0, 0.0, 20.0));
    ahead.id = "2", ahead.plan = geometry(0.0, 120.0, 0.0, 0.0, 100.0);
    ahead.link = R"(<predecessor elementType="junction" elementId="9"/>)";
    aside.id = "3", aside.plan = geometry(0.0, 100.0 + radius, radius, pi / 2.0, 100.0);
    aside.link = R"(<predecessor elementType="junction" elementId="9"/>)";
    ahead.lanes = aside.lanes = section(0.0, "", lane(-1, "3.5", R"(<predecessor id="-1"/>)"));
    return road(in) + road(left) + road(straight) + road(ahead) + road(aside) + R"(<junction id="9">
        <connection id="0" incomingRoad="1" connectingRoad="11" contactPoint="start"><laneLink from="-1" to="-1"/></connection>
        <connection id="1" incomingRoad="1" connectingRoad="10" contactPoint="start"><laneLink from="-1" to="-1"/></connection>
        </junction>)";
}

TEST(Route, TakesTheLeastTurnAtAJunction) {
    const RoadNetwork network = network_with(fork());
    const Route route(network, {});
    EXPECT_NEAR(route.length_m(), 220.0, 1e-9);
    EXPECT_EQ(route.place(150.0).first, "2");
}

TEST(Route, ViaNamesTheRoadBehindOrWithinTheJunctionAndMustExist) {
    const RoadNetwork network = network_with(fork());
    EXPECT_EQ(Route(network, {}, {"3"}).place(180.0).first, "3");
    EXPECT_EQ(Route(network, {}, {"11"}).place(180.0).first, "3");
    EXPECT_EQ(Route(network, {}, {"1", "10", "2"}).place(180.0).first, "2");
    EXPECT_THAT(refusal(network, {}, {"2", "3"}), HasSubstr("does not meet road '3'"));
    EXPECT_THAT(refusal(network, {"7", 0, 0.0}), HasSubstr("found no road '7', expected one of the roads 1, 11, 10, 2, 3"));
    EXPECT_THAT(refusal(network, {"1", -4, 0.0}), HasSubstr("found no lane -4 at s = 0 m of road '1', expected one of the lanes -1"));
    EXPECT_THAT(refusal(network, {"1", 0, 100.5}), HasSubstr("outside road '1'"));
    EXPECT_THAT(refusal(network, {"1", 0, std::nan("")}), HasSubstr("outside road '1'"));
    EXPECT_THAT(refusal(network, {"2", 0, 100.0}), HasSubstr("growing"));
}

TEST(Route, ARingIsDrivenOnceRound) {
    RoadText ring;
    const double length = 2.0 * pi * 50.0;
    ring.length = fmt::format("{}", length);
    ring.plan = geometry(0.0, 0.0, 0.0, 0.0, length, R"(<arc curvature="0.02"/>)");
    ring.link =
        R"(<predecessor elementType="road" elementId="1" contactPoint="end"/><successor elementType="road" elementId="1" contactPoint="start"/>)";
    ring.lanes = section(0.0, "", lane(-1, "3.5", R"(<predecessor id="-1"/><successor id="-1"/>)"));
    const RoadNetwork network = network_with(road(ring));
    EXPECT_NEAR(Route(network, {}).length_m(), 2.0 * pi * 51.75, 1e-9);
}

} // namespace
} // namespace fernlicht
