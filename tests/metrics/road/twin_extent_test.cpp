#include "metrics/road/extent.h"

#include "scenarios/light/light.h"
#include "tests/lamps.h"
#include "tests/metrics/straight_grid.h"

#include <cmath>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using tests::extent_of, tests::straight_grid;

LitLamp lamp_with(CandelaTable table, const glm::dvec3& position_m, double pitch_rad = 0.0) {
    return {.file = tests::file_of(std::move(table)), .pose = {position_m, axes_from_angles(0.0, pitch_rad, 0.0)}};
}

CandelaTable everywhere(double cd) { return tests::even_table(cd); }

/// `cd` below the lamp's horizon, nothing above it.
CandelaTable cut_off_at_horizon(double cd) {
    return {{-180.0, 180.0}, {-90.0, 0.0, 1e-9, 90.0}, {cd, cd, cd, cd, 0.0, 0.0, 0.0, 0.0}, {}, BetweenSamples::linear_cd};
}

Moment moment_of(std::vector<LitLamp> lamps) { return {.lamps = std::move(lamps)}; }

// 0.65 m above the road, 1 % down: its cut-off meets the road 65 m ahead.
LitLamp dipped_lamp() { return lamp_with(cut_off_at_horizon(50000.0), {0.0, 0.0, 0.65}, -std::atan(0.01)); }

TEST(TwinIlluminance, IsTheLawOfLampAndRoad) {
    ExtentGrid grid = straight_grid({.ahead_m = 60.0, .target_height_m = 0.25});
    const Moment moment =
        moment_of({lamp_with(everywhere(10000.0), {-0.2, 0.6, 0.65}), lamp_with(everywhere(10000.0), {-0.2, -0.6, 0.65})});
    const auto road = twin_illuminance_lx(grid, moment, Surface::road);
    const auto target = twin_illuminance_lx(grid, moment, Surface::target);
    for (std::size_t row = 0; row < grid.ahead_m.size(); row += 7)
        for (std::size_t column = 0; column < grid.offset_m.size(); column += 5) {
            const double x = grid.ahead_m[row] + 0.2, y = grid.offset_m[column];
            double on_road = 0.0, on_target = 0.0;
            for (const double side : {0.6, -0.6}) {
                on_road += 10000.0 * 0.65 / std::pow(x * x + (y - side) * (y - side) + 0.65 * 0.65, 1.5);
                on_target += 10000.0 / (x * x + (y - side) * (y - side) + 0.4 * 0.4);
            }
            const std::size_t i = row * grid.offset_m.size() + column;
            EXPECT_NEAR(road[i] / on_road, 1.0, 1e-12);
            EXPECT_NEAR(target[i] / on_target, 1.0, 1e-12);
        }
}

TEST(TwinIlluminance, LampsThatAreOffAddExactlyNothing) {
    const ExtentGrid grid = straight_grid({.ahead_m = 20.0});
    LitLamp on = lamp_with(everywhere(1000.0), {0.0, 0.0, 0.65}), off = on;
    off.intensity_factor = 0.0;
    for (const Surface surface : {Surface::road, Surface::target}) {
        EXPECT_EQ(twin_illuminance_lx(grid, moment_of({on}), surface), twin_illuminance_lx(grid, moment_of({off, on, off}), surface));
        for (const double lx : twin_illuminance_lx(grid, moment_of({off}), surface))
            ASSERT_EQ(lx, 0.0);
    }
}

TEST(TwinIlluminance, TheSkyLightsTheRoadAloneAndThreadsChangeNothing) {
    const ExtentGrid grid = straight_grid({.ahead_m = 5.0});
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = 0.2;
    EXPECT_EQ(twin_illuminance_lx(grid, moment, Surface::road).front(), 0.2);
    EXPECT_EQ(twin_illuminance_lx(grid, moment, Surface::target).front(), 0.0);
    const ExtentGrid other_grid = straight_grid({});
    const Moment other_moment = moment_of({dipped_lamp(), lamp_with(everywhere(1234.5), {0.1, 0.6, 0.7})});
    const auto with_all = twin_illuminance_lx(other_grid, other_moment, Surface::road);
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(with_all, twin_illuminance_lx(other_grid, other_moment, Surface::road));
}

TEST(TwinExtent, ReachesWhereTheLawSaysOrTheCutOffEnds) {
    const ExtentGrid grid = straight_grid({.ahead_m = 120.0, .target_height_m = 0.25});
    const Moment moment = moment_of({lamp_with(everywhere(10000.0), {0.0, 0.0, 0.65})});
    const auto road = measure_extent(grid, twin_illuminance_lx(grid, moment, Surface::road), Surface::road, {3.0}, {});
    const auto target = measure_extent(grid, twin_illuminance_lx(grid, moment, Surface::target), Surface::target, {1.0}, {});
    EXPECT_NEAR(extent_of(road, "own", 3.0).reach_centre_m, std::sqrt(std::pow(6500.0 / 3.0, 2.0 / 3.0) - 0.65 * 0.65), 3e-3);
    EXPECT_NEAR(extent_of(target, "own", 1.0).reach_centre_m, std::sqrt(10000.0 - 0.4 * 0.4), 1e-3);
    // At the cut-off I / 65^2 = 11.8 lx: every lower limit ends there, 65 m ahead on the road, h / tan(dip). 65 m is a row of the grid.
    const ExtentGrid other_grid = straight_grid({.ahead_m = 100.0, .across_m = 0.5});
    const auto lx = twin_illuminance_lx(other_grid, moment_of({dipped_lamp()}), Surface::target);
    const auto extents = measure_extent(other_grid, lx, Surface::target, {1.0, 5.0}, {});
    EXPECT_NEAR(extent_of(extents, "own", 1.0).reach_centre_m, 65.0, 0.5);
    EXPECT_NEAR(extent_of(extents, "own", 5.0).reach_centre_m, 65.0, 0.5);
    EXPECT_FALSE(extent_of(extents, "own", 1.0).reach_is_cut_off);
}

// Bounds that knew nothing of the air took points for lit that fog leaves dark.
TEST(TwinExtent, FogIsInTheBoundsToo) {
    const ExtentGrid grid = straight_grid({.ahead_m = 100.0, .beside_m = 5.0, .target_height_m = 0.25});
    Moment moment = moment_of({lamp_with(everywhere(10000.0), {-0.2, 0.6, 0.65}), dipped_lamp()});
    moment.weather.extinction_per_m = 0.03;
    for (const Surface surface : {Surface::road, Surface::target})
        EXPECT_EQ(measure_extent(grid, twin_lux_near_thresholds(grid, moment, surface, {1.0, 5.0}), surface, {1.0, 5.0}, {20.0}),
                  measure_extent(grid, twin_illuminance_lx(grid, moment, surface), surface, {1.0, 5.0}, {20.0}));
}

/// Of a reach on the own lane, metres: nudged less as it is.
double moved_m(const NudgedExtents& extents, NudgeKind kind, Surface surface, double threshold_lx) {
    const auto reach_m = [&](const std::vector<LaneExtent>& all) {
        for (const LaneExtent& extent : all)
            if (extent.surface == surface && extent.lane == "own" && extent.threshold_lx == threshold_lx)
                return extent.reach_centre_m;
        throw std::out_of_range("no such extent");
    };
    return reach_m(extents.nudged[static_cast<std::size_t>(kind)]) - reach_m(extents.as_is);
}

Nudges nudges_on_rails() { return usual_nudges({}, {}); }

// The cut-off meets the road at h / tan(dip). 65 m away 0.1 degrees more reach 77.5 m, less 55.3 m, 10 mm more height one metre more; flux
// does nothing, for the light ends at the cut-off.
TEST(NudgedExtents, CutOffAnswersToAimAndHeightAndNotToFlux) {
    const ExtentGrid grid = straight_grid({.ahead_m = 100.0, .beside_m = 2.5});
    const NudgedExtents extents = nudged_extents(grid, moment_of({dipped_lamp()}), {1.0, 3.0}, {}, nudges_on_rails());
    const double dip = std::atan(0.01), tenth = radians(0.1), between_rows_m = 0.5;
    for (const double threshold_lx : {1.0, 3.0}) {
        const auto moved = [&](NudgeKind kind) { return moved_m(extents, kind, Surface::target, threshold_lx); };
        EXPECT_NEAR(moved(NudgeKind::aim_up), 0.65 / std::tan(dip - tenth) - 65.0, between_rows_m);
        EXPECT_NEAR(moved(NudgeKind::aim_down), 0.65 / std::tan(dip + tenth) - 65.0, between_rows_m);
        EXPECT_NEAR(moved(NudgeKind::higher), 1.0, between_rows_m);
        EXPECT_NEAR(moved(NudgeKind::lower), -1.0, between_rows_m);
        EXPECT_NEAR(moved(NudgeKind::brighter), 0.0, 0.05);
        EXPECT_NEAR(moved(NudgeKind::dimmer), 0.0, 0.05);
    }
    EXPECT_TRUE(extents.nudged[static_cast<std::size_t>(NudgeKind::loaded)].empty()) << "nobody knows the springs";
}

// Constant intensity does not care for aim; d' = sqrt(I / E) answers to flux.
TEST(NudgedExtents, BareLampAnswersToFluxAndNotToAim) {
    const ExtentGrid grid = straight_grid({.ahead_m = 120.0, .beside_m = 2.5, .target_height_m = 0.65});
    const NudgedExtents extents =
        nudged_extents(grid, moment_of({lamp_with(everywhere(10000.0), {0.0, 0.0, 0.65})}), {1.0}, {}, nudges_on_rails());
    EXPECT_NEAR(moved_m(extents, NudgeKind::brighter, Surface::target, 1.0), 100.0 * (std::sqrt(1.1) - 1.0), 1e-3);
    EXPECT_NEAR(moved_m(extents, NudgeKind::dimmer, Surface::target, 1.0), 100.0 * (std::sqrt(0.9) - 1.0), 1e-3);
    EXPECT_NEAR(moved_m(extents, NudgeKind::aim_up, Surface::target, 1.0), 0.0, 1e-9);
}

// 75 kg over the rear axle: 735.75 N press springs of 43 kN/m by 17.1 mm and tyres of 400 kN/m by 1.84 mm. On 2.7 m the nose goes up by
// 0.402 degrees; levelling takes back the springs' 0.363. A lamp 3.4 m ahead and 0.65 m up rises by 3.4 sin - 18.9 mm.
TEST(Nudge, LoadTurnsTheCarAndLevellingTakesItBack) {
    Drive drive;
    drive.vehicle.emplace();
    LampSet lamp_set;
    Moment moment = moment_of({lamp_with(everywhere(1.0), {3.4, 0.6, 0.65})});
    const auto loaded = [&] { return nudged(moment, usual_nudges(drive, lamp_set).back().value()).lamps.front().pose; };
    const double springs_m = 75.0 * 9.81 / 43e3, tyres_m = 75.0 * 9.81 / 400e3, pitch_rad = (springs_m + tyres_m) / 2.7;
    EXPECT_NEAR(degrees(pitch_rad), 0.402, 0.001);
    EXPECT_NEAR(std::asin(loaded().forward().z), pitch_rad, 1e-12);
    EXPECT_NEAR(loaded().position_m.z, 0.65 * std::cos(pitch_rad) + 3.4 * std::sin(pitch_rad) - springs_m - tyres_m, 1e-12);
    lamp_set.levelling.emplace();
    EXPECT_NEAR(std::asin(loaded().forward().z), tyres_m / 2.7, 1e-12);
    EXPECT_FALSE(usual_nudges({}, {}).back().has_value());
}

} // namespace
} // namespace fernlicht
