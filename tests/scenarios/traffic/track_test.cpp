#include "scenarios/traffic/road_user.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(Track, GoesStraightAtEvenSpeedBetweenItsPoints) {
    const Track track({{1.0, {{10.0, 2.0, 0.5}, glm::dmat3(1.0)}, 20.0}, {3.0, {{50.0, 2.0, 0.5}, glm::dmat3(1.0)}, 20.0}});
    for (const double t : {1.0, 1.1, 1.5, 2.0, 2.9, 3.0})
        EXPECT_NEAR(glm::length(track.at(t).pose.position_m - glm::dvec3(10.0 + 20.0 * (t - 1.0), 2.0, 0.5)), 0.0, 1e-12) << t;
    EXPECT_EQ(track.at(2.0).speed_mps, 20.0);
}

TEST(Track, StandsBeforeItsFirstAndAfterItsLastPoint) {
    const Track track({{1.0, {{10.0, 0.0, 0.0}, glm::dmat3(1.0)}, 20.0}, {3.0, {{50.0, 0.0, 0.0}, glm::dmat3(1.0)}, 20.0}});
    EXPECT_EQ(track.at(0.0).pose.position_m.x, 10.0);
    EXPECT_EQ(track.at(9.0).pose.position_m.x, 50.0);
    EXPECT_EQ(track.at(9.0).speed_mps, 0.0);
    EXPECT_THROW(Track({}), std::invalid_argument);
    EXPECT_THROW(Track({{1.0, {}, 0.0}, {1.0, {}, 0.0}}), std::invalid_argument);
}

/// A quarter circle of 50 m at 10 m/s, a point each 0.1 s: a cubic Hermite stays within d^4 / (384 r^3) of the arc, here 2e-8 m.
TEST(Track, FollowsAnArcBetweenItsPoints) {
    constexpr double r = 50.0, v = 10.0;
    const auto on_arc = [](double t) {
        const double a = v * t / r;
        return TrackPoint{t, {{r * std::sin(a), r * (1.0 - std::cos(a)), 0.0}, axes_from_angles(a, 0.0, 0.0)}, v};
    };
    std::vector<TrackPoint> points;
    for (int i = 0; i <= 78; ++i)
        points.push_back(on_arc(0.1 * i));
    const Track track(points);
    for (const double t : {0.05, 1.234, 3.333, 7.77}) {
        EXPECT_NEAR(glm::length(track.at(t).pose.position_m - on_arc(t).pose.position_m), 0.0, 3e-8) << t;
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(glm::length(track.at(t).pose.axes[axis] - on_arc(t).pose.axes[axis]), 0.0, 1e-9) << t;
    }
}

} // namespace
} // namespace fernlicht
