#include "runner/findings/summary.h"

#include "scenarios/drives/edits/mirrored_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <set>

namespace fernlicht {
namespace {

using ::testing::HasSubstr;

LaneExtent reaching(double reach_m, const std::string& lane = "own", double threshold_lx = 5.0, bool cut_off = false) {
    LaneExtent extent;
    extent.threshold_lx = threshold_lx;
    extent.lane = lane;
    extent.reach_centre_m = reach_m;
    extent.reach_left_edge_m = reach_m - 1.0;
    extent.reach_right_edge_m = reach_m + 2.0;
    extent.reach_is_cut_off = cut_off;
    extent.widths = {{20.0, 2.0, -1.0, 0.1 * reach_m}};
    extent.area_m2 = 10.0 * reach_m;
    return extent;
}

/// Moments with these rendered extents of the own lane; the twin reaches half a metre farther.
PlayedCell played(const std::vector<LaneExtent>& extents) {
    PlayedCell lamp_set;
    for (const LaneExtent& extent : extents) {
        ExtentRow row;
        row.tick = static_cast<int>(lamp_set.extents.size());
        row.rendered = {extent};
        row.twin = {extent};
        row.twin[0].reach_centre_m += 0.5;
        row.nudged.as_is = {extent};
        row.nudged.nudged[0] = {extent}; // aim up
        row.nudged.nudged[0][0].reach_centre_m += 7.0 + row.tick;
        row.nudged.nudged[2] = {reaching(1.1 * extent.reach_centre_m, extent.lane, extent.threshold_lx, extent.reach_is_cut_off)};
        row.grid_errors = {{5.0, Surface::road, "own", 0.02, 0.03, 0.04, 0.5}, {5.0, Surface::road, "all", {}, {}, {}, 3.0}};
        lamp_set.extents.push_back(row);
    }
    return lamp_set;
}

/// Readings of such a lamp set.
Readings summarise(PlayedCell lamp_set, const Drive& drive) {
    lamp_set.extent_summaries = summarise_extents(lamp_set, *drive.extent);
    return extent_readings(lamp_set);
}

Drive looking_200_m() {
    Drive drive;
    drive.extent = ExtentParameters{};
    drive.extent->width_at_m = {20.0};
    return drive;
}

const Reading& find(const Readings& readings, const std::string& name) {
    for (const Reading& reading : readings)
        if (reading.name() == name)
            return reading;
    throw std::out_of_range("no reading " + name);
}

double found(const Readings& readings, const std::string& name) { return find(readings, name).value.number().value(); }

TEST(Summary, MediansMinimaAndPercentilesOverTheMomentsInOneOrder) {
    const std::pair<const char*, double> expected[] = {{"reach_5lx_road_own_m", 60.0},
                                                       {"reach_5lx_road_own_min_m", 50.0},
                                                       {"reach_5lx_road_own_p05_m", 51.0},
                                                       {"reach_5lx_road_own_p95_m", 78.0},
                                                       {"reach_5lx_road_own_left_edge_m", 59.0},
                                                       {"reach_5lx_road_own_right_edge_m", 62.0},
                                                       {"unlit_before_reach_5lx_road_own_m", 0.0},
                                                       {"width_5lx_road_own_at_20m_m", 6.0},
                                                       {"width_5lx_road_own_at_20m_min_m", 5.0},
                                                       {"width_5lx_road_own_at_20m_p05_m", 5.1},
                                                       {"area_5lx_road_own_m2", 600.0},
                                                       {"area_5lx_road_own_min_m2", 500.0},
                                                       {"area_5lx_road_own_p05_m2", 510.0},
                                                       {"reach_5lx_road_own_twin_difference_m", 0.5},
                                                       {"reach_5lx_road_own_twin_difference_worst_m", 0.5},
                                                       {"reach_5lx_road_own_grid_error_m", 0.02},
                                                       {"reach_5lx_road_own_edge_grid_error_m", 0.03},
                                                       {"unlit_before_reach_5lx_road_own_grid_error_m", 0.04},
                                                       {"area_5lx_road_own_grid_error_m2", 0.5}};
    const Readings readings = summarise(played({reaching(60.0), reaching(50.0), reaching(80.0)}), looking_200_m());
    ASSERT_EQ(readings.size(), std::size(expected));
    for (std::size_t i = 0; i < readings.size(); ++i) {
        EXPECT_EQ(readings[i].name(), expected[i].first);
        EXPECT_DOUBLE_EQ(readings[i].value.number().value(), expected[i].second) << expected[i].first;
        EXPECT_TRUE(readings[i].name().ends_with(readings[i].unit()));
    }
}

// Statistics of the nudged moments less those as the lamps are: 60, 50 and 80 m become 67, 58 and 89.
TEST(Summary, EachStatisticMovesByItself) {
    const Readings readings = summarise(played({reaching(60.0), reaching(50.0), reaching(80.0)}), looking_200_m());
    EXPECT_DOUBLE_EQ(find(readings, "reach_5lx_road_own_m").sensitivity.aim_up.value(), 7.0);
    EXPECT_DOUBLE_EQ(find(readings, "reach_5lx_road_own_min_m").sensitivity.aim_up.value(), 8.0);
    EXPECT_NEAR(find(readings, "reach_5lx_road_own_p95_m").sensitivity.aim_up.value(), 8.8, 1e-9) << "86.8 less 78";
    EXPECT_NEAR(find(readings, "area_5lx_road_own_min_m2").sensitivity.brighter.value(), 50.0, 1e-9);
    EXPECT_NEAR(find(readings, "width_5lx_road_own_at_20m_m").sensitivity.brighter.value(), 0.6, 1e-9);
    EXPECT_FALSE(find(readings, "reach_5lx_road_own_m").sensitivity.aim_down.has_value()) << "not looked at";
    EXPECT_EQ(find(readings, "reach_5lx_road_own_grid_error_m").sensitivity, Sensitivity{});
}

TEST(Summary, NamesSayLimitPlaneAndLane) {
    LaneExtent extent = reaching(60.0, "left 1", 0.5);
    extent.surface = Surface::target;
    const Readings readings = summarise(played({extent}), looking_200_m());
    EXPECT_DOUBLE_EQ(found(readings, "reach_0.5lx_target_left_1_m"), 60.0);
}

TEST(Summary, BothSidesHaveTheSameFiguresAndTheGridsAreaErrorOfAllComesFirst) {
    for (const auto& [lane, other] : {std::pair("own", "own"), std::pair("all", "all"), std::pair("left 1", "right 1")}) {
        std::multiset<std::string> here, there;
        for (const Reading& reading : summarise(played({reaching(60.0, lane)}), looking_200_m()))
            here.insert(other_side(reading.name()));
        for (const Reading& reading : summarise(played({reaching(60.0, other)}), looking_200_m()))
            there.insert(reading.name());
        EXPECT_EQ(here, there);
    }
    const Reading area = summarise(played({reaching(60.0, "all")}), looking_200_m()).at(15);
    EXPECT_EQ(std::pair(area.name(), area.value), std::pair(std::string("area_5lx_road_all_grid_error_m2"), Value(3.0)));
}

// Three of four moments measured: the median lies between the 2nd and the 3rd and is exact, whatever the fourth would be.
TEST(Summary, LightBeyondTheGridRanksAboveAll) {
    const Readings readings =
        summarise(played({reaching(200.0, "own", 5.0, true), reaching(150.0), reaching(140.0), reaching(130.0)}), looking_200_m());
    EXPECT_DOUBLE_EQ(found(readings, "reach_5lx_road_own_m"), 145.0);
    EXPECT_DOUBLE_EQ(found(readings, "reach_5lx_road_own_min_m"), 130.0);
}

TEST(Summary, WhatRestsOnALowerBoundIsOne) {
    const Readings readings = summarise(played({reaching(200.0, "own", 5.0, true), reaching(150.0)}), looking_200_m());
    const Reading& median = find(readings, "reach_5lx_road_own_m");
    EXPECT_EQ(median.value, Value::at_least(175.0)) << "half way from 150 to what may be anything beyond 200";
    EXPECT_DOUBLE_EQ(found(readings, "reach_5lx_road_own_min_m"), 150.0);
    EXPECT_EQ(find(readings, "area_5lx_road_own_m2").value, Value::at_least(1750.0));
    EXPECT_DOUBLE_EQ(found(readings, "area_5lx_road_own_min_m2"), 1500.0);
    EXPECT_EQ(find(readings, "reach_5lx_road_own_twin_difference_worst_m").value, Value(0.5)) << "both beyond: left out";
}

TEST(Summary, WhatTellsOfAReachThatGoesOnSaysSo) {
    PlayedCell beyond = played({reaching(200.0, "own", 5.0, true), reaching(200.0, "own", 5.0, true)});
    for (ExtentRow& row : beyond.extents) {
        row.grid_errors[0].reach = row.grid_errors[0].edge = Value::not_measured(reach_beyond);
    }
    const std::string why = "the reach lies beyond the end of grid, road or lane in every moment";
    const Readings none = summarise(beyond, looking_200_m());
    EXPECT_EQ(find(none, "reach_5lx_road_own_m").sensitivity, Sensitivity{}) << "a bound moves by nobody knows how much";
    for (const char* name : {"reach_5lx_road_own_grid_error_m", "reach_5lx_road_own_edge_grid_error_m"}) {
        EXPECT_FALSE(find(none, name).value.measured()) << name;
        EXPECT_EQ(find(none, name).value.reason(), why) << name;
    }
    PlayedCell once = played({reaching(200.0, "own", 5.0, true), reaching(150.0)});
    once.extents[0].grid_errors[0].reach = Value::not_measured(reach_beyond);
    EXPECT_DOUBLE_EQ(found(summarise(once, looking_200_m()), "reach_5lx_road_own_grid_error_m"), 0.02) << "the other moment's";
}

// Near the road's end the grid shrinks: 12 m "at least" must not become the drive's smallest reach.
TEST(Summary, TheRoadsEndIsNotAShortReach) {
    const Readings readings = summarise(played({reaching(60.0), reaching(12.0, "own", 5.0, true), reaching(62.0)}), looking_200_m());
    EXPECT_DOUBLE_EQ(found(readings, "reach_5lx_road_own_min_m"), 60.0);
    EXPECT_DOUBLE_EQ(found(readings, "area_5lx_road_own_min_m2"), 600.0);
    EXPECT_THAT(find(readings, "reach_5lx_road_own_min_m").where, HasSubstr("2 moments, 1 left out"));
    const Readings none = summarise(played({reaching(12.0, "own", 5.0, true)}), looking_200_m());
    EXPECT_FALSE(find(none, "reach_5lx_road_own_m").value.measured());
    EXPECT_EQ(find(none, "reach_5lx_road_own_m").value.reason(), "cut off by the end of the road or lane in every moment");
}

TEST(Summary, TheWholeWidthHasNoCentre) {
    const Readings all = summarise(played({reaching(60.0, "all")}), looking_200_m()),
                   own = summarise(played({reaching(60.0)}), looking_200_m());
    EXPECT_THAT(find(all, "reach_5lx_road_all_m").where, HasSubstr("whole width, on the road, line that reaches farthest, median"));
    EXPECT_THAT(find(all, "reach_5lx_road_all_left_edge_m").where, HasSubstr("leftmost line looked at, median"));
    EXPECT_THAT(find(all, "reach_5lx_road_all_right_edge_m").where, HasSubstr("rightmost line looked at, median"));
    EXPECT_THAT(find(own, "reach_5lx_road_own_m").where, HasSubstr("own lane, on the road, centre, median"));
    EXPECT_THAT(find(own, "reach_5lx_road_own_left_edge_m").where, HasSubstr("own lane, on the road, left edge, median"));
}

TEST(Summary, WidthsThatWereNeverLookedAtAreNotMeasured) {
    Drive drive = looking_200_m();
    drive.extent->width_at_m = {20.0, 300.0};
    const Reading width = find(summarise(played({reaching(60.0)}), drive), "width_5lx_road_own_at_300m_m");
    EXPECT_FALSE(width.value.measured());
    EXPECT_EQ(width.value.reason(), "not there in any moment");
}

TEST(Summary, TwinAloneIsNotTakenForRendered) {
    PlayedCell lamp_set = played({reaching(60.0)});
    lamp_set.extents[0].rendered.clear();
    EXPECT_FALSE(find(summarise(lamp_set, looking_200_m()), "reach_5lx_road_own_m").value.measured());
}

TEST(Summary, TimesOfPasses) {
    PlayedCell lamp_set;
    lamp_set.passes = {{"frame", {0.010, 0.012, 0.030}}, {"shadow", {}}};
    const Readings readings = times(lamp_set);
    EXPECT_DOUBLE_EQ(found(readings, "frame_time_median_ms"), 12.0);
    EXPECT_NEAR(found(readings, "frame_time_p95_ms"), 28.2, 1e-9);
    EXPECT_NEAR(found(readings, "frame_time_spread_ms"), 28.2 - 10.2, 1e-9);
    EXPECT_FALSE(find(readings, "shadow_time_median_ms").value.measured());
    EXPECT_TRUE(is_time(readings[0].key));
}

} // namespace
} // namespace fernlicht
