#include "renderer/projected_beam.h"

#include "scenarios/lamps/lamp_model.h"
#include "scenarios/light/light.h"
#include "scenarios/values/errors.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

LitLamp turned_lamp(glm::dvec3 position, double yaw_rad, double factor = 1.0) {
    static const auto file = std::make_shared<LampFile>(lamp_of_model(lamp_models()[0]));
    return {"lamp", file, Pose{position, axes_from_angles(yaw_rad, 0.0, 0.0)}, factor, {}, 0.0};
}

double merged_lx(const ProjectedBeam& beam, const Pose& pose, const glm::dvec3& point) {
    const glm::dvec3 p = to_local(pose, point);
    const glm::dvec4 place = texture_from_lamp(beam.window) * glm::dvec4(-p.y, p.z, p.x, 1.0);
    return place.w > 0.0 ? projected_lx(beam, place.x / place.w, place.y / place.w) * 625.0 / glm::dot(p, p) : 0.0;
}

TEST(MergedBeam, StandsMidwayAlongTheMeanAxis) {
    const std::vector<LitLamp> lamps{turned_lamp({3.5, 0.6, 0.6}, 0.1), turned_lamp({3.5, -0.6, 0.7}, 0.3)};
    const Pose pose = merged_pose(lamps);
    EXPECT_NEAR(glm::distance(pose.position_m, glm::dvec3(3.5, 0.0, 0.65)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(pose.forward(), glm::dvec3(std::cos(0.2), std::sin(0.2), 0.0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(pose.left(), glm::dvec3(-std::sin(0.2), std::cos(0.2), 0.0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(pose.up(), glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-12);
}

TEST(MergedBeam, LampsThatAreOffDoNotMoveIt) {
    const std::vector<LitLamp> lamps{turned_lamp({3.5, 0.6, 0.6}, 0.1), turned_lamp({3.5, -0.6, 0.7}, 3.0, 0.0)};
    EXPECT_EQ(merged_pose(lamps).position_m, glm::dvec3(3.5, 0.6, 0.6));
    EXPECT_EQ(merged_pose({}), Pose());
    EXPECT_EQ(make_merged_beam({}, {4, 4, 32}).scale_lx, 0.0);
}

TEST(MergedBeam, AxesThatCancelAreRefused) {
    const std::vector<LitLamp> lamps{turned_lamp({3.5, 0.6, 0.6}, 0.0), turned_lamp({-1.0, 0.6, 0.6}, pi)};
    EXPECT_THROW(merged_pose(lamps), InputError);
}

TEST(MergedBeam, IsExactAt25MetresAndWrongNearer) {
    Moment moment;
    moment.lamps = {turned_lamp({3.5, 0.6, 0.65}, 0.02), turned_lamp({3.5, -0.6, 0.65}, -0.01, 0.7)};
    const Pose pose = merged_pose(moment.lamps);
    const ProjectedBeam beam = make_merged_beam(moment.lamps, {512, 256, 32});
    double worst_nearer = 0.0;
    for (int row = 0; row < beam.height; row += 5)
        for (int column = 0; column < beam.width; column += 7) {
            const double x = beam.window.left + (beam.window.right - beam.window.left) * (column + 0.5) / beam.width;
            const double y = beam.window.bottom + (beam.window.top - beam.window.bottom) * (row + 0.5) / beam.height;
            const glm::dvec3 direction = pose.axes * glm::normalize(glm::dvec3(1.0, -x, y));
            const glm::dvec3 exact = pose.position_m + 25.0 * direction, near = pose.position_m + 8.0 * direction;
            const double truth = target_illuminance_lx(moment, exact);
            ASSERT_NEAR(merged_lx(beam, pose, exact), truth, 1e-6 * beam.scale_lx) << row << ' ' << column; // a float, and rounding of s, t
            const double truth_near = target_illuminance_lx(moment, near);
            worst_nearer = std::max(worst_nearer, std::abs(merged_lx(beam, pose, near) - truth_near));
        }
    EXPECT_GT(worst_nearer, 0.05 * beam.scale_lx * 625.0 / 64.0);
}

TEST(MergedBeam, OneLampIsItsOwnProjection) {
    const std::vector<LitLamp> one{turned_lamp({1.0, 2.0, 0.5}, 0.4)};
    const ProjectedBeam merged = make_merged_beam(one, {128, 64, 8}), own = make_projected_beam(one[0].file->table, {128, 64, 8});
    EXPECT_NEAR(merged.window.left, own.window.left, 1e-12);
    EXPECT_NEAR(merged.window.top, own.window.top, 1e-12);
    EXPECT_NEAR(merged.scale_lx, own.scale_lx, 1e-5);
    EXPECT_NEAR(merged.worst_error_of_peak, own.worst_error_of_peak, 1e-6);
}

TEST(MergedBeam, SeesBothWindowsWhole) {
    const std::vector<LitLamp> lamps{turned_lamp({3.5, 5.0, 0.65}, 0.1), turned_lamp({3.5, -5.0, 0.65}, -0.1)};
    const TangentWindow own = lit_window(lamps[0].file->table);
    const ProjectedBeam beam = make_merged_beam(lamps, {64, 32, 32});
    EXPECT_LT(beam.window.left, own.left);
    EXPECT_GT(beam.window.right, own.right);
    EXPECT_LE(beam.window.right, 1.4);
}

TEST(MergedBeam, GoesWithTheCar) {
    std::vector<LitLamp> lamps{turned_lamp({3.5, 0.6, 0.65}, 0.02), turned_lamp({3.5, -0.6, 0.65}, -0.01)};
    const ProjectedBeam at_origin = make_merged_beam(lamps, {64, 32, 32});
    const Pose car{{3e6, -2e6, 400.0}, axes_from_angles(1.0, 0.05, 0.02)};
    const Pose before = compose(car, merged_pose(lamps));
    for (LitLamp& lamp : lamps)
        lamp.pose = compose(car, lamp.pose);
    const Pose after = merged_pose(lamps);
    EXPECT_LT(glm::distance(before.position_m, after.position_m), 1e-8); // a unit in the last place of 3e6 m is 5e-10
    EXPECT_LT(glm::distance(before.forward(), after.forward()), 1e-12);
    const ProjectedBeam far = make_merged_beam(lamps, {64, 32, 32});
    for (std::size_t i = 0; i < far.lx.size(); ++i)
        ASSERT_NEAR(static_cast<double>(far.lx[i]), static_cast<double>(at_origin.lx[i]), 1e-5 * at_origin.scale_lx);
}

} // namespace
} // namespace fernlicht
