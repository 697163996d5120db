// Real road files by others: every one is read or refused in one sentence, and what is read is finite everywhere.
#include "scenarios/roads/plan.h"
#include "scenarios/roads/road_network.h"
#include "scenarios/roads/route.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/roads/opendrive_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tuple>

namespace fernlicht {
namespace {

using namespace opendrive_text;

bool finite(const Pose& pose) {
    bool all = true;
    for (int i = 0; i < 3; ++i)
        all = all && std::isfinite(pose.position_m[i]) && std::isfinite(glm::length(pose.axes[i])) &&
              std::abs(glm::length(pose.axes[i]) - 1.0) < 1e-9;
    return all;
}

void expect_finite(const RoadNetwork& network) {
    for (const Road& road : network.roads)
        for (int i = 0; i <= 50; ++i) {
            const double s = road.length_m * i / 50.0;
            ASSERT_TRUE(finite(plan_pose(road, s))) << road.id << " s = " << s;
            const LaneSection& section = section_at(road, s);
            for (const Lane& lane : section.lanes) {
                const LaneEdges edges = lane_edges(road, section, lane.id, s);
                for (const double t : {edges.inner_t_m, edges.outer_t_m}) {
                    const Pose pose = surface_pose(network, road, s, t);
                    ASSERT_TRUE(finite(pose)) << road.id << " s = " << s << " t = " << t;
                    ASSERT_GT(pose.up().z, 0.0) << road.id << " s = " << s << " t = " << t;
                }
            }
        }
}

void expect_route(const RoadNetwork& network) {
    const Route route(network, {});
    EXPECT_GT(route.length_m(), 0.0);
    for (int i = 0; i <= 200; ++i) {
        const double distance = route.length_m() * i / 200.0;
        const Pose pose = route.pose(distance, i % 3 - 1.0);
        ASSERT_TRUE(finite(pose)) << distance;
        ASSERT_GT(pose.up().z, 0.0) << distance;
        const CrossSection cross = route.cross_section(distance);
        ASSERT_TRUE(std::any_of(cross.lanes.begin(), cross.lanes.end(), [](const RouteLane& lane) { return lane.name == "own"; }))
            << distance;
    }
}

bool has_driving_lane(const RoadNetwork& network) {
    return std::any_of(network.roads.begin(), network.roads.end(), [](const Road& road) {
        return std::any_of(road.sections[0].lanes.begin(), road.sections[0].lanes.end(),
                           [&](const Lane& lane) { return lane.id != 0 && lane.type == "driving" && travels_with_s(road, lane); });
    });
}

/// Files that break a rule of the standard may be refused; each of those is judged in opendrive_rules_test.
bool may_be_refused(const std::filesystem::path& file) { return file.string().find("qc-opendrive") != std::string::npos; }

TEST(NetworkFiles, EachIsFiniteEverywhereAndCanBeDriven) {
    const auto files = road_files(shared_roads);
    if (files.empty())
        GTEST_SKIP() << "no road files in " << shared_roads;
    int read = 0;
    for (const auto& file : files) {
        SCOPED_TRACE(file.string());
        try {
            const RoadNetwork network = read_opendrive(file);
            ++read;
            expect_finite(network);
            if (has_driving_lane(network))
                expect_route(network);
        } catch (const InputError& error) {
            EXPECT_TRUE(may_be_refused(file)) << error.what();
        }
    }
    EXPECT_GT(read, 0.9 * static_cast<double>(files.size()));
}

/// The reference line by brute force: heading integrated in closed form, position by Gauss-Legendre on very many pieces in long double.
PlanPoint clothoid_reference(double start_per_m, double end_per_m, double length_m, double ds_m) {
    using Real = long double;
    constexpr Real node = 0.57735026918962576450914878L;
    constexpr int pieces = 40'000;
    const Real change = (static_cast<Real>(end_per_m) - start_per_m) / length_m, h = static_cast<Real>(ds_m) / pieces;
    Real x = 0.0L, y = 0.0L;
    for (int i = 0; i < pieces; ++i)
        for (const Real side : {-node, node}) {
            const Real u = h * (static_cast<Real>(i) + 0.5L + 0.5L * side), heading = u * (start_per_m + 0.5L * change * u);
            x += 0.5L * h * std::cos(heading);
            y += 0.5L * h * std::sin(heading);
        }
    return {static_cast<double>(x), static_cast<double>(y), ds_m * (start_per_m + 0.5 * static_cast<double>(change) * ds_m), 0.0, 1.0};
}

PlanElement element_of(double length_m, decltype(PlanElement::shape) shape) { return {.length_m = length_m, .shape = std::move(shape)}; }

TEST(NetworkPlan, ClothoidOfEveryCurvatureAgreesWithIntegration) {
    struct Clothoid {
        double start_per_m, end_per_m, length_m;
    };
    for (const auto& [start, end, length] : {Clothoid{0.0, 0.0, 100.0},                 // straight
                                             Clothoid{0.0, 1e-12, 100.0},               // nearly straight
                                             Clothoid{1e-9, -1e-9, 5000.0},             //
                                             Clothoid{0.0, 1.0 / 150.0, 60.0},          // a country road's
                                             Clothoid{1.0 / 150.0, -1.0 / 250.0, 90.0}, // sign change
                                             Clothoid{0.01, 0.01, 300.0},               // an arc in disguise
                                             Clothoid{0.02, 0.020000001, 80.0},         //
                                             Clothoid{-0.2, 0.5, 12.0},                 // a corner
                                             Clothoid{0.0, 2.0, 25.0},                  // tightly wound: 25 rad
                                             Clothoid{5.0, -5.0, 10.0},                 // wound both ways
                                             Clothoid{1e-6, 1e-3, 1e4}}) {
        SCOPED_TRACE(fmt::format("{} to {} over {} m", start, end, length));
        PlanElement element = element_of(length, Spiral{start, end});
        const PlanElement bare = element;
        prepare(element);
        for (const double part : {0.1, 0.5, 0.77, 1.0}) {
            const PlanPoint expected = clothoid_reference(start, end, length, part * length);
            const PlanPoint cached = plan_point(element, part * length), computed = plan_point(bare, part * length);
            // The reference itself: order 4 with steps of length/40000; the worst turn here is 50 rad, so (50/40000)^4/4320 = 6e-16.
            EXPECT_NEAR(cached.x_m, expected.x_m, 1e-12 * length) << part;
            EXPECT_NEAR(cached.y_m, expected.y_m, 1e-12 * length) << part;
            EXPECT_NEAR(cached.heading_rad, expected.heading_rad, 1e-12 * (1.0 + std::abs(expected.heading_rad)));
            EXPECT_EQ(std::tuple(cached.x_m, cached.y_m), std::tuple(computed.x_m, computed.y_m));
        }
    }
}

TEST(NetworkPlan, ArcOfAnyCurvatureIsPlacedAndTurned) {
    for (const double curvature : {0.0, 1e-300, 1e-15, 1e-6, -1e-4, 0.001, 0.00999, 0.01001, -0.5, 3.0}) {
        const double length = 10.0;
        const PlanPoint point = plan_point(element_of(length, Arc{curvature}), length);
        const long double k = curvature, turn = k * length;
        const long double x = k == 0.0L ? length : std::sin(turn) / k;
        const long double half = std::sin(turn / 2.0L), y = k == 0.0L ? 0.0L : 2.0L * half * half / k;
        EXPECT_NEAR(point.x_m, static_cast<double>(x), 1e-13 * length) << curvature;
        EXPECT_NEAR(point.y_m, static_cast<double>(y), 1e-13 * length) << curvature;
        EXPECT_DOUBLE_EQ(point.heading_rad, curvature * length);
    }
    PlanElement element = element_of(20.0, Line{});
    element.x_m = 680'000.0, element.y_m = 5'400'000.0, element.heading_rad = radians(90.0);
    const PlanPoint point = plan_point(element, 5.0);
    EXPECT_NEAR(point.x_m, 680'000.0, 1e-9);
    EXPECT_NEAR(point.y_m, 5'400'005.0, 1e-9);
}

/// Arc length of v = c u^2 from 0 to u in closed form.
double parabola_length(double c, double u) {
    const double w = 2.0 * c * u;
    return (w * std::sqrt(1.0 + w * w) + std::asinh(w)) / (4.0 * c);
}

TEST(NetworkPlan, Poly3FollowsItsArcLength) {
    for (const double c : {1e-4, 0.01, 1.0, -3.0}) {
        for (const double u : {0.5, 10.0, 40.0}) {
            const double s = parabola_length(std::abs(c), u);
            PlanElement element = element_of(s, Poly3{0.0, 0.0, c, 0.0});
            const PlanPoint bare = plan_point(element, s);
            prepare(element);
            const PlanPoint point = plan_point(element, s);
            EXPECT_NEAR(point.x_m, u, 1e-9 * u) << c;
            EXPECT_NEAR(point.y_m, c * u * u, 1e-9 * std::abs(c) * u * u) << c;
            EXPECT_NEAR(point.heading_rad, std::atan(2.0 * c * u), 1e-9);
            EXPECT_EQ(bare.x_m, point.x_m);
        }
    }
}

TEST(NetworkPlan, Poly3WithSharpBendStillHasUnitSpeed) {
    PlanElement element = element_of(100.0, Poly3{0.0, 0.1, -0.02, 0.0004});
    prepare(element);
    double worst = 0.0;
    for (double s = 0.0; s < 99.0; s += 0.1) {
        const PlanPoint a = plan_point(element, s), b = plan_point(element, s + 0.01);
        worst = std::max(worst, std::abs(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / 0.01 - 1.0));
    }
    EXPECT_LT(worst, 1e-4); // the chord of 1 cm is shorter than its arc by (k h)^2 / 24
}

TEST(NetworkPlan, ParamPoly3IsTheSameCurveInBothRanges) {
    const double length = 50.0;
    // u(p) = p, v(p) = 0.002 p^2 by metres; the same by p/length.
    const PlanElement metres = element_of(length, ParamPoly3{0, 1, 0, 0, 0, 0, 0.002, 0, false});
    const PlanElement unit = element_of(length, ParamPoly3{0, length, 0, 0, 0, 0, 0.002 * length * length, 0, true});
    for (double s = 0.0; s <= length; s += 2.5) {
        const PlanPoint a = plan_point(metres, s), b = plan_point(unit, s);
        EXPECT_NEAR(a.x_m, s, 1e-12);
        EXPECT_NEAR(a.y_m, 0.002 * s * s, 1e-12);
        EXPECT_NEAR(a.x_m, b.x_m, 1e-12);
        EXPECT_NEAR(a.y_m, b.y_m, 1e-12);
        EXPECT_NEAR(a.heading_rad, b.heading_rad, 1e-14);
        EXPECT_NEAR(a.heading_rate_per_m, b.heading_rate_per_m, 1e-14);
        EXPECT_NEAR(a.speed, b.speed, 1e-14);
    }
    EXPECT_NEAR(drawn_length_m(metres), parabola_length(0.002, length), 1e-10);
}

/// Heading is the direction of motion, heading_rate its derivative: by central differences, for every shape.
TEST(NetworkPlan, HeadingAndCurvatureAreDerivatives) {
    std::vector<PlanElement> elements{element_of(80.0, Line{}), element_of(80.0, Arc{-0.01}), element_of(80.0, Spiral{0.002, -0.03}),
                                      element_of(80.0, Poly3{0.0, 0.05, 0.001, -2e-5}),
                                      element_of(80.0, ParamPoly3{0, 78, 3, -1, 0, 0, 9, -5, true})};
    for (PlanElement& element : elements) {
        element.heading_rad = 2.0;
        prepare(element);
        for (double s = 1.0; s < 79.0; s += 3.7) {
            const double h = 1e-4;
            const PlanPoint a = plan_point(element, s - h), m = plan_point(element, s), b = plan_point(element, s + h);
            EXPECT_NEAR(std::remainder(std::atan2(b.y_m - a.y_m, b.x_m - a.x_m) - m.heading_rad, 2.0 * pi), 0.0, 1e-8);
            EXPECT_NEAR((b.heading_rad - a.heading_rad) / (2.0 * h), m.heading_rate_per_m, 1e-8);
            EXPECT_NEAR(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / (2.0 * h), m.speed, 1e-8);
        }
    }
}

// Our own roads are what their headers say: lengths, radii, continuous lines and grades.

TEST(LibraryRoads, AreNamedReadWithoutWarningAndContinueFromRecordToRecord) {
    for (const std::filesystem::path& file : road_files(library_roads)) {
        SCOPED_TRACE(file);
        const RoadNetwork network = read_opendrive(file);
        EXPECT_EQ(network.name, "fernlicht " + file.stem().string() + (file.stem() == "country" ? " road" : ""));
        EXPECT_TRUE(network.warnings.empty());
        for (const Road& road : network.roads) {
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
                const Pose before = surface_pose({}, road, grade.s0 - 1e-7, 0.0), after = surface_pose({}, road, grade.s0, 0.0);
                EXPECT_LT(std::abs(before.position_m.z - after.position_m.z), 1e-6) << "height at " << grade.s0;
                EXPECT_LT(std::abs(before.forward().z - after.forward().z), 1e-6) << "grade at " << grade.s0;
            }
        }
    }
    EXPECT_EQ(road_files(library_roads).size(), 16U);
}

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
