#include "metrics/road/extent.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace fernlicht {
namespace {

RoadNetwork library_road(const char* name) { return read_opendrive(std::string(FERNLICHT_SOURCE_DIR "/scenarios/library/roads/") + name); }

Moment at(double distance_m) {
    Moment moment;
    moment.distance_m = distance_m;
    return moment;
}

TEST(ExtentGrid, RowsBeginAtTheBumperAndColumnsReachBothSides) {
    const RoadNetwork network = library_road("straight.xodr");
    const Route route(network, {});
    const ExtentGrid grid = make_extent_grid(route, at(50.0), 3.6, {});
    ASSERT_EQ(grid.ahead_m.size(), 401U);
    EXPECT_EQ(grid.ahead_m.front(), 0.0);
    EXPECT_EQ(grid.ahead_m.back(), 200.0);
    EXPECT_EQ(grid.offset_m.front(), -20.0);
    EXPECT_EQ(grid.offset_m.back(), 20.0);
    EXPECT_TRUE(std::ranges::is_sorted(grid.offset_m));
    EXPECT_TRUE(std::ranges::binary_search(grid.offset_m, 0.0));
    EXPECT_EQ(grid.sections.size(), grid.ahead_m.size());
    ASSERT_EQ(grid.surface.size(), grid.ahead_m.size() * grid.offset_m.size());
    for (const std::size_t row : {std::size_t{0}, std::size_t{137}, std::size_t{400}})
        for (std::size_t column = 0; column < grid.offset_m.size(); column += 9)
            EXPECT_EQ(grid.surface[row * grid.offset_m.size() + column], route.pose(53.6 + grid.ahead_m[row], grid.offset_m[column]));
}

TEST(ExtentGrid, IsFineOnTheRoadAndCoarseBesideIt) {
    const RoadNetwork network = library_road("straight.xodr");
    const Route route(network, {});
    const ExtentGrid grid = make_extent_grid(route, at(50.0), 3.6, {});
    const CrossSection& section = grid.sections.front();
    for (std::size_t column = 0; column + 1 < grid.offset_m.size(); ++column) {
        const double step_m = grid.offset_m[column + 1] - grid.offset_m[column];
        const bool paved = grid.offset_m[column] >= section.paved_right_m && grid.offset_m[column + 1] <= section.paved_left_m;
        EXPECT_LE(step_m, paved ? 0.125 : 0.5);
    }
    EXPECT_LT(grid.offset_m.size(), 321U);
}

TEST(ExtentGrid, EndsWithTheRoute) {
    const RoadNetwork network = library_road("straight.xodr");
    const Route route(network, {});
    const ExtentGrid near_end = make_extent_grid(route, at(route.length_m() - 13.6), 3.6, {});
    EXPECT_EQ(near_end.ahead_m.back(), 10.0) << "a route's pose is clamped: rows beyond its end would all be one place";
    EXPECT_TRUE(make_extent_grid(route, at(route.length_m() - 3.0), 3.6, {}).ahead_m.empty());
}

// Nothing was looked at: there is nothing to measure, and nothing breaks.
TEST(ExtentGrid, WithoutRowsGivesNoExtents) {
    const RoadNetwork network = library_road("straight.xodr");
    const Route route(network, {});
    const ExtentGrid grid = make_extent_grid(route, at(route.length_m()), 3.6, {});
    const Moment moment = at(route.length_m());
    const std::vector<double> lx = twin_illuminance_lx(grid, moment, ExtentPlane::road);
    EXPECT_TRUE(lx.empty());
    EXPECT_TRUE(measure_extent(grid, lx, ExtentPlane::road, {1.0}, {20.0}).empty());
    EXPECT_TRUE(grid_error(grid, lx, ExtentPlane::road, {1.0}).empty());
    EXPECT_TRUE(reach_sensitivity(grid, moment, {1.0}).empty());
}

// A lane is as long as its arc: between two rows the own lane's centre advances by the cell, also on clothoids and arcs.
TEST(ExtentGrid, FollowsTheRoadInACurve) {
    const RoadNetwork network = library_road("s-bend.xodr");
    const Route route(network, {});
    const ExtentGrid grid = make_extent_grid(route, at(300.0), 3.6, {});
    const std::size_t columns = grid.offset_m.size();
    const auto centre = static_cast<std::size_t>(std::ranges::lower_bound(grid.offset_m, 0.0) - grid.offset_m.begin());
    double turned = 0.0;
    for (std::size_t row = 0; row + 1 < grid.ahead_m.size(); ++row) {
        const Pose& a = grid.surface[row * columns + centre];
        const Pose& b = grid.surface[(row + 1) * columns + centre];
        // Distances run along the reference line where the lane's centre is longer or shorter by the curve: at most 3 %.
        EXPECT_NEAR(glm::length(b.position_m - a.position_m), 0.5, 0.015);
        turned += std::abs(glm::cross(a.forward(), b.forward()).z);
    }
    EXPECT_GT(turned, 0.3) << "the road must curve for this test to mean anything";
}

TEST(ExtentGrid, RefusesParametersThatGiveNoGrid) {
    const RoadNetwork network = library_road("straight.xodr");
    const Route route(network, {});
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {0.0, -1.0, nan, infinity, 1e-9}) {
        ExtentParameters parameters;
        parameters.cell_m = bad;
        EXPECT_THROW(make_extent_grid(route, at(0.0), 3.6, parameters), std::invalid_argument) << bad;
    }
    ExtentParameters parameters;
    parameters.ahead_m = 1e12;
    EXPECT_THROW(make_extent_grid(route, at(0.0), 3.6, parameters), std::invalid_argument);
    parameters = {};
    parameters.beside_m = nan;
    EXPECT_THROW(make_extent_grid(route, at(0.0), 3.6, parameters), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
