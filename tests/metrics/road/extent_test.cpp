#include "metrics/road/extent.h"
#include "tests/metrics/straight_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <tuple>

namespace fernlicht {
namespace {

using tests::extent_of, tests::lit_by, tests::straight_grid, tests::StraightGrid;

constexpr double pi_ = 3.14159265358979323846;

// A lamp of constant intensity I at height h above offset 0 of the bumper: E = I h / d^3 on the road.
struct BareLamp {
    double cd = 10000.0, height_m = 0.65;
    double road_lx(double ahead_m, double offset_m) const {
        return cd * height_m / std::pow(ahead_m * ahead_m + offset_m * offset_m + height_m * height_m, 1.5);
    }
    double target_lx(double ahead_m, double offset_m) const { return cd / (ahead_m * ahead_m + offset_m * offset_m + height_m * height_m); }
    /// Distance on the road at which the limit is met, along offset `b`.
    double road_reach_m(double threshold_lx, double b = 0.0) const {
        return std::sqrt(std::pow(cd * height_m / threshold_lx, 2.0 / 3.0) - height_m * height_m - b * b);
    }
    double target_reach_m(double threshold_lx, double b = 0.0) const { return std::sqrt(cd / threshold_lx - height_m * height_m - b * b); }
};

class BareLampOnTheRoad : public ::testing::Test {
  protected:
    const BareLamp lamp{};
    const ExtentGrid grid = straight_grid({});
    const std::vector<double> lx = lit_by(grid, [this](double x, double y) { return lamp.road_lx(x, y); }), limits{1.0, 3.0, 5.0, 10.0};
    const std::vector<LaneExtent> extents = measure_extent(grid, lx, Surface::road, limits, {5.0, 10.0});
};

// Straight in ln E over a cell c, the error of a power law x^-3 is about c^2 / (8 x): 2.5 mm at 12 m.
TEST_F(BareLampOnTheRoad, ReachesWhereTheLawSaysInLanesFromLeftToRight) {
    for (const double limit : limits) {
        const LaneExtent own = extent_of(extents, "own", limit);
        EXPECT_NEAR(own.reach_centre_m, lamp.road_reach_m(limit), 0.004) << limit;
        EXPECT_NEAR(own.reach_left_edge_m, lamp.road_reach_m(limit, 1.75), 0.004) << limit;
        EXPECT_EQ(own.reach_left_edge_m, own.reach_right_edge_m) << "the lamp and the lane are symmetrical";
        EXPECT_EQ(own.unlit_before_reach_m, 0.0);
        EXPECT_FALSE(own.reach_is_cut_off);
        EXPECT_NEAR(extent_of(extents, "left 1", limit).reach_centre_m, lamp.road_reach_m(limit, 3.5), 0.004);
        EXPECT_NEAR(extent_of(extents, "right 1", limit).reach_right_edge_m, lamp.road_reach_m(limit, 3.25), 0.004);
    }
    ASSERT_EQ(extents.size(), 16U);
    EXPECT_EQ(extents[0].lane, "left 1");
    EXPECT_FALSE(extents[0].same_direction);
    EXPECT_EQ(extents[4].lane, "own");
    EXPECT_TRUE(extents[4].same_direction);
    EXPECT_EQ(extents[8].lane, "right 1");
    EXPECT_EQ(extents[12].lane, "all");
}

// Lit inside the circle r about the lamp's foot; the half ahead of the bumper counts.
TEST_F(BareLampOnTheRoad, AreasAreThoseOfTheCircle) {
    for (const double limit : limits) {
        const double radius_m = lamp.road_reach_m(limit);
        const LaneExtent all = extent_of(extents, "all", limit);
        EXPECT_NEAR(all.area_m2 / (0.5 * pi_ * radius_m * radius_m), 1.0, 1e-3) << limit;
        EXPECT_NEAR(all.reach_centre_m, radius_m, 0.004);
    }
    // Half the circle between the chords at offsets a and b: integral of sqrt(r^2 - y^2).
    const auto up_to = [](double r, double y) { return 0.5 * (y * std::sqrt(r * r - y * y) + r * r * std::asin(y / r)); };
    const double radius_m = lamp.road_reach_m(3.0);
    const auto between = [&](double right_m, double left_m) { return up_to(radius_m, left_m) - up_to(radius_m, right_m); };
    EXPECT_NEAR(extent_of(extents, "own", 3.0).area_m2 / between(-1.75, 1.75), 1.0, 1e-3);
    EXPECT_NEAR(extent_of(extents, "left 1", 3.0).area_m2 / between(1.75, 5.25), 1.0, 1e-3);
    EXPECT_NEAR(extent_of(extents, "right 1", 3.0).area_m2 / between(-3.25, -1.75), 1.0, 1e-3);
}

TEST_F(BareLampOnTheRoad, WidthIsTheChord) {
    const double half_m = std::sqrt(std::pow(lamp.road_reach_m(3.0), 2) - 100.0);
    const LaneExtent all = extent_of(extents, "all", 3.0);
    ASSERT_EQ(all.widths.size(), 2U);
    EXPECT_EQ(all.widths[1].at_m, 10.0);
    EXPECT_NEAR(all.widths[1].left_m, half_m, 1e-3);
    EXPECT_NEAR(all.widths[1].right_m, -half_m, 1e-3);
    EXPECT_NEAR(all.widths[1].width_m, 2.0 * half_m, 2e-3);
    const LaneExtent own = extent_of(extents, "own", 3.0);
    EXPECT_DOUBLE_EQ(own.widths[1].left_m, 1.75);
    EXPECT_DOUBLE_EQ(own.widths[1].width_m, 3.5);
}

std::vector<LaneExtent> evenly_lit(const ExtentGrid& grid, double lx, double threshold_lx, const std::vector<double>& width_at_m = {}) {
    return measure_extent(grid, std::vector<double>(grid.surface.size(), lx), Surface::road, {threshold_lx}, width_at_m);
}

TEST(Extent, OnATargetFacingTheLamp) {
    const BareLamp lamp;
    const ExtentGrid grid = straight_grid({.ahead_m = 120.0});
    const auto extents =
        measure_extent(grid, lit_by(grid, [&](double x, double y) { return lamp.target_lx(x, y); }), Surface::target, {1.0, 5.0}, {});
    EXPECT_NEAR(extent_of(extents, "own", 1.0).reach_centre_m, lamp.target_reach_m(1.0), 1e-3);
    EXPECT_NEAR(extent_of(extents, "own", 5.0).reach_left_edge_m, lamp.target_reach_m(5.0, 1.75), 2e-3);
    EXPECT_EQ(extent_of(extents, "own", 5.0).surface, Surface::target);
}

TEST(Extent, BeyondTheGridIsCutOffAndLanesOutsideAreLeftOut) {
    const ExtentGrid grid = straight_grid({.ahead_m = 30.0});
    const auto extents = evenly_lit(grid, 7.0, 5.0, {20.0, 50.0});
    for (const LaneExtent& extent : extents) {
        EXPECT_TRUE(extent.reach_is_cut_off) << extent.lane;
        EXPECT_EQ(extent.reach_centre_m, 30.0) << extent.lane;
        ASSERT_EQ(extent.widths.size(), 1U) << "50 m was not looked at";
        EXPECT_EQ(extent.widths[0].at_m, 20.0);
    }
    EXPECT_NEAR(extent_of(extents, "all", 5.0).area_m2, 30.0 * 40.0, 1e-9);
    EXPECT_NEAR(extent_of(extents, "own", 5.0).area_m2, 30.0 * 3.5, 1e-9);
    EXPECT_NEAR(extent_of(extents, "all", 5.0).widths[0].width_m, 40.0, 1e-12);
    const ExtentGrid other_grid = straight_grid({.ahead_m = 10.0, .beside_m = 3.0});
    const auto other_extents = evenly_lit(other_grid, 7.0, 5.0);
    ASSERT_EQ(other_extents.size(), 2U);
    EXPECT_EQ(other_extents[0].lane, "own");
    EXPECT_EQ(other_extents[1].lane, "all");
}

TEST(Extent, UnlitIsZeroEverywhere) {
    const ExtentGrid grid = straight_grid({.ahead_m = 30.0});
    const auto extents = evenly_lit(grid, 0.0, 1.0, {20.0});
    ASSERT_EQ(extents.size(), 4U);
    for (const LaneExtent& extent : extents) {
        EXPECT_EQ(std::tuple(extent.reach_centre_m, extent.area_m2), std::tuple(0.0, 0.0));
        EXPECT_FALSE(extent.reach_is_cut_off);
        ASSERT_EQ(extent.widths.size(), 1U);
        EXPECT_EQ(extent.widths[0].width_m, 0.0);
    }
}

// Lit between y = -x/10 and y = x/10, up to 50 m: a triangle of area 250, 4 m wide at 20 m. E is linear across the edge, 1 lx on it,
// so that the linear fall-back at the dark side would be seen; slope small enough for the logarithm to agree to a millimetre.
TEST(Extent, WedgeHasItsWidthsAndArea) {
    const ExtentGrid grid = straight_grid({.ahead_m = 50.0, .beside_m = 6.0});
    const auto wedge = [](double x, double y) { return std::exp(x / 10.0 - std::abs(y)); };
    const auto extents = measure_extent(grid, lit_by(grid, wedge), Surface::road, {1.0}, {20.0, 33.3});
    const LaneExtent all = extent_of(extents, "all", 1.0);
    EXPECT_NEAR(all.area_m2, 250.0, 1e-9);
    ASSERT_EQ(all.widths.size(), 2U);
    EXPECT_NEAR(all.widths[0].width_m, 4.0, 1e-12);
    EXPECT_NEAR(all.widths[1].left_m, 3.33, 1e-12);
    EXPECT_NEAR(all.widths[1].right_m, -3.33, 1e-12);
    // The own lane is dark on its edge until x = 17.5 m, then lit throughout.
    const LaneExtent own = extent_of(extents, "own", 1.0);
    EXPECT_NEAR(own.area_m2, 17.5 * 1.75 + 32.5 * 3.5, 1e-9);
    EXPECT_NEAR(own.widths[0].width_m, 3.5, 1e-12);
    EXPECT_TRUE(own.reach_is_cut_off);
}

TEST(Extent, OfADarkGapAndOfTwoPools) {
    const ExtentGrid grid = straight_grid({.ahead_m = 60.0});
    const auto extents = measure_extent(
        grid, lit_by(grid, [](double x, double) { return (x >= 10.0 && x <= 20.0) || (x >= 30.0 && x <= 40.0) ? 10.0 : 0.1; }),
        Surface::road, {1.0}, {});
    // Half a cell of fall-off at each of the four edges: 10 : 0.1 about 1.
    const LaneExtent own = extent_of(extents, "own", 1.0);
    EXPECT_NEAR(own.reach_centre_m, 40.25, 1e-12);
    EXPECT_NEAR(own.unlit_before_reach_m, 9.75 + 9.5, 1e-12);
    // Two separate pools of light: the edges are the outermost, the width leaves the dark between them out.
    const ExtentGrid other_grid = straight_grid({.ahead_m = 10.0, .beside_m = 4.0});
    const auto pools = [](double, double y) { return std::abs(y) >= 1.0 && std::abs(y) <= 2.0 ? 10.0 : 0.0; };
    const auto other_extents = measure_extent(other_grid, lit_by(other_grid, pools), Surface::road, {5.0}, {5.0});
    const LaneExtent::Width width = extent_of(other_extents, "all", 5.0).widths.at(0);
    EXPECT_NEAR(width.left_m, 2.0625, 1e-12);
    EXPECT_NEAR(width.right_m, -2.0625, 1e-12);
    EXPECT_NEAR(width.width_m, 2.0 * 1.125, 1e-12);
}

TEST(Extent, FollowsLanesThatEndOrRunSlanting) {
    ExtentGrid grid = straight_grid({.ahead_m = 40.0});
    for (std::size_t row = 0; row < grid.sections.size(); ++row)
        if (grid.ahead_m[row] > 25.0)
            grid.sections[row].lanes.erase(grid.sections[row].lanes.begin()); // the oncoming lane is gone
    const auto extents = evenly_lit(grid, 7.0, 5.0, {20.0, 30.0});
    const LaneExtent left = extent_of(extents, "left 1", 5.0);
    EXPECT_EQ(left.reach_centre_m, 25.0);
    EXPECT_TRUE(left.reach_is_cut_off);
    EXPECT_NEAR(left.area_m2, 25.0 * 3.5, 1e-9);
    ASSERT_EQ(left.widths.size(), 1U);
    EXPECT_EQ(left.widths[0].at_m, 20.0);
    ExtentGrid other_grid = straight_grid({.ahead_m = 40.0});
    for (std::size_t row = 0; row < other_grid.sections.size(); ++row)
        other_grid.sections[row].lanes = {{"own", "driving", -1, true, 1.0 + other_grid.ahead_m[row] * 0.05, -1.0}};
    const auto other_extents = evenly_lit(other_grid, 7.0, 5.0, {10.3});
    const LaneExtent own = extent_of(other_extents, "own", 5.0);
    EXPECT_NEAR(own.area_m2, 40.0 * 2.0 + 0.5 * 40.0 * 2.0, 1e-9);
    EXPECT_NEAR(own.widths.at(0).width_m, 2.515, 1e-9);
}

// On a circular arc of 50 m radius to the left the strip from offset a to b has (R - (a + b) / 2) / R times the straight one's area.
TEST(Extent, AreaIsThatOfTheRoadNotOfTheGrid) {
    ExtentGrid grid = straight_grid({.ahead_m = 60.0, .beside_m = 6.0});
    for (std::size_t row = 0; row < grid.ahead_m.size(); ++row)
        for (std::size_t column = 0; column < grid.offset_m.size(); ++column) {
            const double angle = grid.ahead_m[row] / 50.0, radius_m = 50.0 - grid.offset_m[column];
            grid.surface[row * grid.offset_m.size() + column].position_m = {radius_m * std::sin(angle), 50.0 - radius_m * std::cos(angle),
                                                                            0.0};
        }
    const auto extents = evenly_lit(grid, 7.0, 5.0);
    EXPECT_NEAR(extent_of(extents, "left 1", 5.0).area_m2 / (60.0 * 3.5 * (50.0 - 3.5) / 50.0), 1.0, 1e-4);
    EXPECT_NEAR(extent_of(extents, "own", 5.0).area_m2 / (60.0 * 3.5), 1.0, 1e-4);
}

TEST(Extent, RefusesWhatCannotBeMeasured) {
    const ExtentGrid grid = straight_grid({.ahead_m = 10.0});
    std::vector<double> lx(grid.surface.size(), 1.0);
    EXPECT_THROW(measure_extent(grid, {1.0}, Surface::road, {1.0}, {}), std::invalid_argument);
    EXPECT_THROW(measure_extent(grid, lx, Surface::road, {0.0}, {}), std::invalid_argument);
    lx[17] = std::nan("");
    EXPECT_THROW(measure_extent(grid, lx, Surface::road, {1.0}, {}), std::invalid_argument);
    EXPECT_TRUE(measure_extent({}, {}, Surface::road, {1.0}, {}).empty());
}

/// First the own lane's, then those of the whole width.
std::vector<GridError> errors_on(const StraightGrid& size) {
    const ExtentGrid grid = straight_grid(size);
    const std::vector<double> lx = lit_by(grid, [](double x, double y) { return BareLamp{}.road_lx(x, y); });
    const std::vector<LaneExtent> measured = measure_extent(grid, lx, Surface::road, {3.0}, {});
    std::vector<GridError> errors = grid_errors(grid, lx, Surface::road, {3.0}, measured);
    EXPECT_EQ(errors.size(), measured.size());
    return errors;
}

// The error of the reach goes as the square of the cell: E = x^-3 gives c^2 / (8 x) on top of another phase in the cell.
TEST(GridErrors, AreSmallForSmoothLightAndShrinkWithTheCell) {
    const auto coarse = errors_on({.ahead_m = 60.0, .along_m = 2.0, .across_m = 0.5}),
               fine = errors_on({.ahead_m = 60.0, .along_m = 0.5, .across_m = 0.125});
    EXPECT_LT(coarse.at(0).reach.number().value(), 4.0 * 4.0 / (8.0 * 12.0));
    EXPECT_LT(fine.at(0).reach.number().value(), 0.015);
    EXPECT_GT(coarse.at(1).area.number().value(), 0.0);
    EXPECT_LT(fine[1].area.number().value(), 0.2 * coarse[1].area.number().value());
    EXPECT_EQ(std::tuple(fine[0].threshold_lx, fine[0].lane, fine[1].lane), std::tuple(3.0, "own", "all"));
    ASSERT_EQ(coarse.size(), fine.size());
    ASSERT_GT(fine.size(), 2U);
    for (std::size_t i = 0; i < fine.size(); ++i)
        for (const auto& [figure, left_m] :
             {std::pair(&GridError::reach, 0.01), std::pair(&GridError::edge, 0.01), std::pair(&GridError::area, 0.05)})
            EXPECT_LE((fine[i].*figure).number().value(), 0.3 * (coarse[i].*figure).number().value() + left_m) << fine[i].lane;
}

TEST(GridErrors, EvenNumbersOfRowsCompareTheSameGround) {
    const ExtentGrid grid = straight_grid({.ahead_m = 10.5});
    ASSERT_EQ(grid.ahead_m.size() % 2, 0U);
    const std::vector<double> lx(grid.surface.size(), 7.0);
    const auto errors = grid_errors(grid, lx, Surface::target, {5.0}, measure_extent(grid, lx, Surface::target, {5.0}, {}));
    EXPECT_EQ(errors.at(0).reach.reason(), reach_beyond); // lit to the end of both
    EXPECT_NEAR(errors.at(1).area.number().value(), 0.0, 1e-9);
    EXPECT_EQ(errors[0].surface, Surface::target);
}

// Of two reaches that both end with the grid nothing tells how far apart they are.
TEST(GridErrors, AReachThatGoesOnHasNone) {
    EXPECT_TRUE(errors_on({.ahead_m = 60.0, .along_m = 0.5, .across_m = 0.25}).at(0).reach.number());
    for (const GridError& error : errors_on({.ahead_m = 8.0, .along_m = 0.5, .across_m = 0.25}))
        EXPECT_EQ(std::tuple(error.reach.reason(), error.edge.reason()), std::tuple(reach_beyond, reach_beyond)) << error.lane;
}

/// The straight of the library, or another of its roads; a grid from the bumper, 3.6 m before the rear axle, on.
struct LibraryRoad {
    std::string name = "straight.xodr";
    RoadNetwork network = read_opendrive(FERNLICHT_SOURCE_DIR "/scenarios/library/roads/" + name);
    Route route{network, {}};
    ExtentGrid grid(double distance_m, const ExtentParameters& parameters = {}) const {
        return make_extent_grid(route, {.distance_m = distance_m}, 3.6, parameters);
    }
};

TEST(ExtentGrid, RowsBeginAtTheBumperAndColumnsReachBothSides) {
    const LibraryRoad road;
    const ExtentGrid grid = road.grid(50.0);
    ASSERT_EQ(grid.ahead_m.size(), 401U);
    EXPECT_EQ(std::tuple(grid.ahead_m.front(), grid.ahead_m.back()), std::tuple(0.0, 200.0));
    EXPECT_EQ(std::tuple(grid.offset_m.front(), grid.offset_m.back()), std::tuple(-20.0, 20.0));
    EXPECT_TRUE(std::ranges::is_sorted(grid.offset_m));
    EXPECT_TRUE(std::ranges::binary_search(grid.offset_m, 0.0));
    EXPECT_EQ(grid.sections.size(), grid.ahead_m.size());
    ASSERT_EQ(grid.surface.size(), grid.ahead_m.size() * grid.offset_m.size());
    for (const std::size_t row : {std::size_t{0}, std::size_t{137}, std::size_t{400}})
        for (std::size_t column = 0; column < grid.offset_m.size(); column += 9)
            EXPECT_EQ(grid.surface[row * grid.offset_m.size() + column], road.route.pose(53.6 + grid.ahead_m[row], grid.offset_m[column]));
}

TEST(ExtentGrid, IsFineOnTheRoadAndEndsWithTheRoute) {
    const LibraryRoad road;
    const ExtentGrid grid = road.grid(50.0);
    const CrossSection& section = grid.sections.front();
    for (std::size_t column = 0; column + 1 < grid.offset_m.size(); ++column) {
        const double step_m = grid.offset_m[column + 1] - grid.offset_m[column];
        const bool paved = grid.offset_m[column] >= section.paved_right_m && grid.offset_m[column + 1] <= section.paved_left_m;
        EXPECT_LE(step_m, paved ? 0.125 : 0.5);
    }
    EXPECT_LT(grid.offset_m.size(), 321U);
    const ExtentGrid near_end = road.grid(road.route.length_m() - 13.6);
    EXPECT_EQ(near_end.ahead_m.back(), 10.0) << "a route's pose is clamped: rows beyond its end would all be one place";
    EXPECT_TRUE(road.grid(road.route.length_m() - 3.0).ahead_m.empty());
}

// Nothing was looked at: there is nothing to measure, and nothing breaks.
TEST(ExtentGrid, WithoutRowsGivesNoExtents) {
    const LibraryRoad road;
    const Moment moment{.distance_m = road.route.length_m()};
    const ExtentGrid grid = road.grid(moment.distance_m);
    const std::vector<double> lx = twin_illuminance_lx(grid, moment, Surface::road);
    EXPECT_TRUE(lx.empty());
    EXPECT_TRUE(measure_extent(grid, lx, Surface::road, {1.0}, {20.0}).empty());
    EXPECT_TRUE(grid_errors(grid, lx, Surface::road, {1.0}, {}).empty());
    EXPECT_TRUE(nudged_extents(grid, moment, {1.0}, {20.0}, usual_nudges({}, {})).as_is.empty());
}

// A lane is as long as its arc: between two rows the own lane's centre advances by the cell, also on clothoids and arcs.
TEST(ExtentGrid, FollowsTheRoadInACurve) {
    const ExtentGrid grid = LibraryRoad{"s-bend.xodr"}.grid(300.0);
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
    const LibraryRoad road;
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const ExtentParameters& bad : {ExtentParameters{.cell_m = 0.0}, ExtentParameters{.cell_m = -1.0}, ExtentParameters{.cell_m = nan},
                                        ExtentParameters{.cell_m = infinity}, ExtentParameters{.cell_m = 1e-9},
                                        ExtentParameters{.ahead_m = 1e12}, ExtentParameters{.beside_m = nan}})
        EXPECT_THROW(road.grid(0.0, bad), std::invalid_argument) << bad.cell_m << ", " << bad.ahead_m << ", " << bad.beside_m;
}

} // namespace
} // namespace fernlicht
