#include "metrics/road/deciding_lx.h"

#include "metrics/road/extent.h"
#include "scenarios/drives/play/advance.h"
#include "tests/metrics/straight_grid.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace fernlicht {
namespace {

using tests::straight_grid;

const std::vector<double> limits_lx{1.0, 3.0, 5.0, 10.0};

TEST(LimitSide, IsTheNumberOfLimitsThatBothBoundsReach) {
    EXPECT_EQ(limit_side({0.0, 0.99}, limits_lx), 0);
    EXPECT_EQ(limit_side({1.01, 2.99}, limits_lx), 1);
    EXPECT_EQ(limit_side({5.1, 9.9}, limits_lx), 3);
    EXPECT_EQ(limit_side({11.0, 1e6}, limits_lx), 4);
    EXPECT_EQ(limit_side({0.99, 1.01}, limits_lx), undecided_side);
    EXPECT_EQ(limit_side({1.0, 1.0}, limits_lx), undecided_side) << "a limit itself lies too near to tell";
    EXPECT_EQ(limit_side({}, limits_lx), undecided_side);
    EXPECT_EQ(limit_side({20.0, NAN}, limits_lx), undecided_side);
    EXPECT_EQ(limit_side({NAN, 20.0}, limits_lx), undecided_side);
}

// Rows of 4 m by columns of 1 m: no lane's edge moves across columns.
TEST(DecidingPoints, AreTwoRowsAndColumnsAroundADifference) {
    const ExtentGrid grid = straight_grid({.ahead_m = 40.0, .beside_m = 6.0, .along_m = 4.0, .across_m = 1.0});
    const std::size_t columns = grid.offset_m.size(), rows = grid.ahead_m.size();
    ASSERT_EQ(columns, 13U);
    ASSERT_EQ(rows, 11U);
    for (const auto& [other, row, column] :
         {std::tuple(LimitSide{2}, 5, 6), std::tuple(undecided_side, 0, 12), std::tuple(LimitSide{0}, 10, 1)}) {
        std::vector<LimitSide> sides(grid.surface.size(), 1);
        sides[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] = other;
        const std::vector<unsigned char> decides = deciding_points(grid, sides);
        for (int r = 0; r < static_cast<int>(rows); ++r)
            for (int c = 0; c < static_cast<int>(columns); ++c)
                EXPECT_EQ(decides[static_cast<std::size_t>(r) * columns + static_cast<std::size_t>(c)] != 0,
                          std::abs(r - row) <= 2 && std::abs(c - column) <= 2)
                    << r << ", " << c;
    }
    const std::vector<unsigned char> none = deciding_points(grid, std::vector<LimitSide>(grid.surface.size(), undecided_side));
    EXPECT_EQ(std::count(none.begin(), none.end(), 1), std::ssize(none)) << "where nothing is known, everything decides";
}

// The right edge of the own lane goes from -1.75 m to -4.25 m between the rows 4 and 5: its samples there are no neighbours.
TEST(DecidingPoints, AreWhereALaneWidensAtOnce) {
    ExtentGrid grid = straight_grid({.ahead_m = 40.0, .beside_m = 6.0, .along_m = 4.0, .across_m = 1.0});
    for (std::size_t row = 5; row < grid.sections.size(); ++row)
        grid.sections[row].lanes[1].right_m = -4.25;
    const std::vector<unsigned char> decides = deciding_points(grid, std::vector<LimitSide>(grid.surface.size(), 1));
    const auto decides_at = [&](std::size_t row, double offset_m) {
        const auto column = std::ranges::find(grid.offset_m, offset_m) - grid.offset_m.begin();
        return decides[row * grid.offset_m.size() + static_cast<std::size_t>(column)] != 0;
    };
    EXPECT_TRUE(decides_at(4, -2.0) && decides_at(4, -1.0)) << "the right edge before it";
    EXPECT_TRUE(decides_at(5, -5.0) && decides_at(5, -4.0)) << "and behind it";
    EXPECT_TRUE(decides_at(4, 0.0) && decides_at(5, -1.0)) << "the centre, from 0 to -1.25 m";
    EXPECT_FALSE(decides_at(3, -2.0) || decides_at(6, -4.0) || decides_at(4, -4.0));
}

/// A library drive at one of its moments.
struct Played {
    Drive drive;
    RoadNetwork network = read_opendrive(drive.road_file);
    Route route{network, drive.start, drive.via};

    Moment at(int tick, std::size_t variant) const {
        State state = start(drive);
        while (state.tick < tick)
            state = advance(state, drive);
        return moment_at(state, drive, route, drive.variants.at(variant));
    }
    ExtentGrid grid(const Moment& moment) const { return make_extent_grid(route, moment, drive.bumper_m, *drive.extent); }
};

Played played(const std::string& name) { return {read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/" + name + ".yaml")}; }

// Straight ahead, a bend, high beams, a parking lane that opens at once.
TEST(DecidingTwin, GivesTheExtentsOfTheTwin) {
    for (const auto& [name, tick] : {std::pair("first-light", 0), std::pair("first-light", 200), std::pair("s-bend", 120),
                                     std::pair("village", 180), std::pair("village", 240), std::pair("motorway", 60)}) {
        const Played drive = played(name);
        for (const std::size_t variant : {0U, 1U}) {
            const Moment moment = drive.at(tick, variant);
            const ExtentGrid grid = drive.grid(moment);
            for (const ExtentPlane plane : {ExtentPlane::road, ExtentPlane::target}) {
                const std::vector<double> exact = twin_illuminance_lx(grid, moment, plane);
                const std::vector<double> deciding = deciding_twin_lx(grid, moment, plane, limits_lx);
                const auto extents = [&](const std::vector<double>& lx) {
                    return measure_extent(grid, lx, plane, limits_lx, {20.0, 50.0, 33.3});
                };
                EXPECT_EQ(extents(deciding), extents(exact)) << name << " " << tick;
                const auto lane_errors = [&](const std::vector<double>& lx) {
                    std::vector<double> all;
                    for (const LaneGridError& error : lane_grid_errors(grid, lx, plane, limits_lx, extents(lx)))
                        all.insert(all.end(), {error.reach_m, error.edge_m, error.unlit_m, error.area_m2});
                    return all;
                };
                // Lanes whose edges run across columns decide at points of the coarser grid that the finer one does not ask for: seen
                // is 1e-5 m, far below what these figures are used for.
                const std::vector<double> from_deciding = lane_errors(deciding), from_exact = lane_errors(exact);
                ASSERT_EQ(from_deciding.size(), from_exact.size());
                for (std::size_t i = 0; i < from_exact.size(); ++i)
                    EXPECT_NEAR(from_deciding[i], from_exact[i], 1e-4) << name << " " << tick << " " << i;
                EXPECT_EQ(grid_error(grid, deciding, plane, limits_lx), grid_error(grid, exact, plane, limits_lx)) << name << " " << tick;
                const std::size_t same = static_cast<std::size_t>(
                    std::inner_product(exact.begin(), exact.end(), deciding.begin(), std::ptrdiff_t{0}, std::plus<>(), std::equal_to<>()));
                EXPECT_LT(same, exact.size() / 2) << "most points decide nothing";
            }
        }
    }
}

// A lamp of which nothing quick is known is calculated everywhere.
TEST(DecidingTwin, IsTheTwinForATableInTheLogarithm) {
    const Played drive = played("first-light");
    Moment moment = drive.at(0, 0);
    for (LitLamp& lamp : moment.lamps) {
        auto file = std::make_shared<LampFile>(*lamp.file);
        file->table.rule = BetweenSamples::log_cd;
        lamp.file = file;
    }
    const ExtentGrid grid = drive.grid(moment);
    EXPECT_EQ(deciding_twin_lx(grid, moment, ExtentPlane::target, limits_lx), twin_illuminance_lx(grid, moment, ExtentPlane::target));
}

} // namespace
} // namespace fernlicht
