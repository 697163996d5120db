// Warps of a lamp's map in double precision: what is seen, and the homographies against the constructions that they stand for.
#include "renderer/gl/shadows/warped_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace fernlicht::gl {
namespace {

Corners box_of(const glm::dvec3& low, const glm::dvec3& high) {
    Corners box;
    for (std::size_t i = 0; i < 8; ++i)
        box[i] = {(i & 1U) != 0U ? high.x : low.x, (i & 2U) != 0U ? high.y : low.y, (i & 4U) != 0U ? high.z : low.z};
    return box;
}

LitLamp lamp_looking(const glm::dvec3& place, double yaw_rad) {
    LitLamp lamp;
    lamp.pose = {place, axes_from_angles(yaw_rad, -0.01, 0.0)};
    lamp.intensity_factor = 1.0;
    return lamp;
}

Camera camera_at(const glm::dvec3& place, double yaw_rad, double pitch_rad) {
    View view;
    view.position_m = place;
    view.yaw_rad = yaw_rad;
    view.pitch_rad = pitch_rad;
    return camera_of(Moment{}, view);
}

const ShadowWindow wide_window{-0.6, 0.6, -0.25, 0.15};
const std::vector<Corners> road_and_wall{box_of({-5.0, -30.0, 0.0}, {200.0, 30.0, 0.0}), box_of({60.0, 5.0, 0.0}, {61.0, 9.0, 3.0})};

TEST(MapWarp, ABoxIsClippedToTheCornersOfWhatIsLeft) {
    const Corners box = box_of({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    EXPECT_EQ(clipped_box(box, {{1.0, 0.0, 0.0, 1.0}}).size(), 8U);
    EXPECT_TRUE(clipped_box(box, {{1.0, 0.0, 0.0, -2.0}}).empty());
    // Two cuts: the ends of the line where they meet belong to no face of the box but at its sides.
    const std::vector<glm::dvec3> wedge = clipped_box(box, {{-1.0, 0.0, 0.0, 0.5}, {0.0, -1.0, 0.0, 0.25}});
    const auto has = [&](const glm::dvec3& p) {
        return std::ranges::any_of(wedge, [&](const glm::dvec3& q) { return glm::length(p - q) < 1e-12; });
    };
    for (const double x : {0.0, 0.5})
        for (const double y : {0.0, 0.25})
            for (const double z : {0.0, 1.0})
                EXPECT_TRUE(has({x, y, z})) << x << " " << y << " " << z;
    for (const glm::dvec3& p : wedge)
        EXPECT_TRUE(p.x <= 0.5 + 1e-12 && p.y <= 0.25 + 1e-12);
    // Three planes that meet inside the box: their corner is on none of its faces.
    const double r = 1.0 / std::sqrt(2.0);
    const std::vector<glm::dvec3> pyramid = clipped_box(box, {{r, r, 0.0, -r}, {r, -r, 0.0, 0.0}, {0.0, 0.0, 1.0, -0.5}});
    EXPECT_TRUE(std::ranges::any_of(pyramid, [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(0.5)) < 1e-12; }));
}

/// The paper's construction step by step: into the eye's cube, then from the lamp's place there to the cube's middle.
TEST(MapWarp, PerspectiveWarpIsTheViewOfTheCubeFromTheLampsPlaceInIt) {
    for (const double lamp_x : {2.2, -3.0}) { // before the eye and behind it, which mirrors the map
        const LitLamp lamp = lamp_looking({lamp_x, 0.6, 0.65}, 0.0);
        const Camera camera = camera_at({1.5, 0.35, 1.2}, 0.0, -0.05);
        const auto seen = seen_in_beam(road_and_wall, camera, lamp, lamp.pose.position_m, wide_window, 0.05);
        ASSERT_GT(seen.size(), 8U);
        const auto warp = perspective_warp(seen, camera, lamp, lamp.pose.position_m);
        ASSERT_TRUE(warp);
        double n = 1e9, f = 0.0;
        const auto in_world = [&](const glm::dvec3& p) {
            return lamp.pose.position_m - lamp.pose.left() * p.x + lamp.pose.up() * p.y + lamp.pose.forward() * p.z;
        };
        for (const glm::dvec3& p : seen) {
            const double depth = glm::dot(camera.axis, in_world(p) - camera.eye_m);
            n = std::min(n, depth);
            f = std::max(f, depth);
        }
        const auto in_cube = [&](const glm::dvec3& p) {
            const glm::dvec3 v = p - camera.eye_m;
            const double z = glm::dot(camera.axis, v);
            return glm::dvec3(glm::dot(camera.right, v) / camera.half_extent.x / z, glm::dot(camera.up, v) / camera.half_extent.y / z,
                              (f + n) / (f - n) - 2.0 * f * n / ((f - n) * z));
        };
        const glm::dvec3 from = in_cube(lamp.pose.position_m), look = -glm::normalize(from);
        const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), look)), up = glm::cross(look, right);
        double scale = 0.0;
        for (const glm::dvec3& p : seen) {
            const glm::dvec3 way = in_cube(in_world(p)) - from, q = *warp * p;
            EXPECT_GT(q.z, 0.0);
            const double x = glm::dot(right, way) / glm::dot(look, way), y = glm::dot(up, way) / glm::dot(look, way);
            if (scale == 0.0 && std::abs(y) > 1e-3)
                scale = q.y / q.z / y;
            EXPECT_NEAR(q.x / q.z, (lamp_x > 1.5 ? 1.0 : -1.0) * scale * x, 1e-9 * std::abs(scale) + 1e-9) << lamp_x;
            EXPECT_NEAR(q.y / q.z, scale * y, 1e-9 * std::abs(scale) + 1e-9) << lamp_x;
        }
    }
}

TEST(MapWarp, TheFitPutsAllThatIsSeenIntoTheMapAndNoMore) {
    for (const double yaw : {0.0, 1.2, 3.1}) {
        const LitLamp lamp = lamp_looking({2.2, 0.6, 0.65}, 0.0);
        const Camera camera = camera_at({yaw > 2.0 ? 100.0 : (yaw > 0.0 ? 30.0 : 1.5), yaw > 0.0 ? -10.0 : 0.35, 3.0}, yaw, -0.1);
        const auto seen = seen_in_beam(road_and_wall, camera, lamp, lamp.pose.position_m, wide_window, 0.05);
        ASSERT_FALSE(seen.empty()) << yaw;
        for (const auto& warp : {std::optional(glm::dmat3(1.0)), light_space_warp(seen, camera, lamp, lamp.pose.position_m),
                                 perspective_warp(seen, camera, lamp, lamp.pose.position_m)}) {
            const auto fit = warp ? fitted(*warp, seen, 1024, 512, 0.0) : std::nullopt;
            if (!fit)
                continue; // the methods do without a warp then
            double left = 1.0, right = 0.0, bottom = 1.0, top = 0.0, least = 1e9;
            for (const glm::dvec3& p : seen) {
                const glm::dvec3 q = *fit * p;
                left = std::min(left, q.x / q.z);
                right = std::max(right, q.x / q.z);
                bottom = std::min(bottom, q.y / q.z);
                top = std::max(top, q.y / q.z);
                least = std::min(least, q.z / p.z);
            }
            EXPECT_TRUE(left > 3.5 / 1024.0 && left < 6.0 / 1024.0 && right < 1.0 - 3.5 / 1024.0 && right > 1.0 - 6.0 / 1024.0) << yaw;
            EXPECT_TRUE(bottom > 3.5 / 512.0 && bottom < 6.0 / 512.0 && top < 1.0 - 3.5 / 512.0 && top > 1.0 - 6.0 / 512.0) << yaw;
            EXPECT_NEAR(least, 1.0, 1e-9);
        }
    }
}

TEST(MapWarp, ALampAtTheEyeThatLooksTheSameWayLeavesNothingToWarp) {
    const LitLamp lamp = lamp_looking({1.5, 0.35, 1.2}, 0.0);
    const Camera camera = camera_at({1.5, 0.35, 1.2}, 0.0, -0.01);
    const auto seen = seen_in_beam(road_and_wall, camera, lamp, lamp.pose.position_m, wide_window, 0.05);
    const auto warp = light_space_warp(seen, camera, lamp, lamp.pose.position_m);
    if (warp) {
        for (const glm::dvec3& p : seen)
            EXPECT_NEAR((*warp * p).z / p.z, 1.0, 1e-6); // no perspective
    }
    EXPECT_FALSE(perspective_warp(seen, camera, lamp, lamp.pose.position_m) &&
                 fitted(*perspective_warp(seen, camera, lamp, lamp.pose.position_m), {{0.0, 0.0, -1.0}}, 64, 64, 0.0));
}

/// Moved by what is raised, a point of a plane is nearer to the lamp than the plane in all texels about.
TEST(MapWarp, SpreadIsThePlainMapsForAWindow) {
    const ShadowWindow window{-0.5, 0.5, -0.25, 0.25};
    EXPECT_NEAR(spread_of(window_homography(window, 1024, 512), 1024, 512), 1.5 / 1020.0, 1e-8);
    EXPECT_NEAR(spread_of(window_homography(window, 512, 512), 512, 512), 1.5 / 510.0, 1e-8);
}

TEST(MapWarp, EdgesShiftByWhatALampsPlaceMakesOfThem) {
    MapPlan then, now;
    then.from = now.from = {{0.0, 0.0, 0.65}, glm::dmat3(1.0)};
    now.bodies = {{-0.1, -0.08, -0.02, 0.05, 10.0, false}};
    EXPECT_DOUBLE_EQ(edge_shift(then, now), 0.0);
    now.from.position_m.y = 0.05; // aside: 5 mm a metre at 10 m
    EXPECT_NEAR(edge_shift(then, now), 0.005, 1e-12);
    now.from.position_m.y = 0.0;
    now.from.position_m.x = 0.5; // ahead: (X / (Z - m) - X / Z) at the outer side
    EXPECT_NEAR(edge_shift(then, now), std::hypot(0.1, 0.05) * 0.5 / 9.5, 1e-12);
    now.bodies[0].nearest_m = 0.4; // the lamp has passed where it begins
    EXPECT_TRUE(std::isinf(edge_shift(then, now)));
}

/// A wall along the lamp's axis begins where it enters the window, not beside the lamp.
TEST(MapWarp, BodiesAroundTheLampBeginWhereTheyEnterTheWindow) {
    const ShadowWindow window{-0.5, 0.5, -0.25, 0.25};
    const std::vector<glm::dvec3> wall{{2.0, -1.0, -50.0}, {2.0, -1.0, 80.0}, {2.0, 3.0, 80.0},
                                       {2.0, -1.0, -50.0}, {2.0, 3.0, 80.0},  {2.0, 3.0, -50.0}};
    EXPECT_NEAR(begins_in_window(wall, window), 4.0, 1e-12);
    EXPECT_NEAR(begins_in_window({wall[0], wall[1], {2.0, -0.9, 80.0}}, {-0.5, 0.5, -0.1, 0.1}), 9.542, 1e-3); // low: by its upper edge
    EXPECT_NEAR(begins_in_window({{-5.0, -5.0, 0.0}, {5.0, -5.0, 0.0}, {0.0, 5.0, 0.1}}, window), shadow_near_m, 1e-12);
    EXPECT_TRUE(std::isinf(begins_in_window({{-5.0, -5.0, -1.0}, {5.0, -5.0, -1.0}, {0.0, 5.0, -1.0}}, window)));
}

} // namespace
} // namespace fernlicht::gl
