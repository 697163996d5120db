// Figures of the page, by what stands on their axes.
#include "runner/experiments/run/run_plots.h"
#include "runner/write/plots/svg.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Lit as far as 50 m at each moment, a moment a second, at these places.
PlayedCell at(const std::vector<double>& distances_m) {
    PlayedCell played;
    played.lamp_set = "xenon";
    LaneExtent extent;
    extent.lane = "own";
    extent.threshold_lx = 1.0;
    extent.reach_centre_m = 50.0;
    for (const double distance_m : distances_m)
        played.extents.push_back({.tick = static_cast<int>(played.extents.size()),
                                  .time_s = static_cast<double>(played.extents.size()),
                                  .distance_m = distance_m,
                                  .rendered = {extent},
                                  .twin = {},
                                  .grid_errors = {},
                                  .nudged = {}});
    return played;
}

std::string reach_of(const PlayedCell& played) {
    ComparedDrive drive;
    drive.lamp_sets = {&played};
    return plots::svg_of(reach_figure(drive, Surface::road, 1.0).value());
}

TEST(PagePlots, ReachIsOverTimeWhereTheCarStandsStillOrMovesOnSprings) {
    EXPECT_THAT(reach_of(at({0.0, 20.0, 40.0})), HasSubstr("distance along the route"));
    EXPECT_THAT(reach_of(at({0.0, 20.0, 20.0, 40.0})), Not(HasSubstr("distance along the route")));
    EXPECT_THAT(reach_of(at({0.0, 20.0, 20.0, 40.0})), HasSubstr("time [s]"));
    PlayedCell sprung = at({0.0, 20.0, 40.0});
    sprung.car.resize(3);
    EXPECT_THAT(reach_of(sprung), HasSubstr("time [s]"));
}

TEST(PagePlots, ErrorOverTimeHasAPointALampSetAndTheFloor) {
    PlayedCell played = at({0.0, 20.0});
    played.technique = "photometric";
    ComparedDrive drive;
    drive.lamp_sets = {&played};
    EXPECT_FALSE(error_figure(drive)); // neither error nor time
    PixelErrors errors;
    errors.pixels = 100;
    errors.error.p95 = 0.03;
    errors.floor.p95 = 0.01;
    played.error.road = errors;
    played.error.road_p95 = {0.02, 0.04};
    EXPECT_FALSE(error_figure(drive)); // no time
    played.passes = {{"frame", {0.010, 0.012, 0.011}}};
    for (const char* part :
         {"xenon", "time a frame, driver&#39;s view alone [ms]", "lux error on the road, 95 % [%]", "noise", "photometric"})
        EXPECT_THAT(plots::svg_of(error_figure(drive).value()), HasSubstr(part));
}

} // namespace
} // namespace fernlicht
