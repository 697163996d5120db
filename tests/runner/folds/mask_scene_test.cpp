// What masks take from the driver, and what others get, on the straight by hand; and what a crest hides.
#include "metrics/folds/control_fold.h"
#include "metrics/folds/mask_scene.h"
#include "runner/play/stage.h"
#include "scenarios/lamps/pixel_lamp.h"
#include "tests/metrics/folds/one_lamp_straight.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

constexpr double even_cd = 10000.0;

/// 40 columns of 1 degree that light evenly, hardly blurred; columns from `first` on so many dark.
std::shared_ptr<const LampFile> columns_dark(std::size_t first, std::size_t count) {
    PixelParts parts;
    parts.raster.push_back({40, 1, {-20.0, 20.0, -10.0, 10.0}, 0.001, 0.001, std::vector<double>(40, even_cd)});
    std::vector<float> levels(40, 1.0F);
    for (std::size_t i = first; i < first + count; ++i)
        levels[i] = 0.0F;
    return tests::file_of(PixelLamp(parts).table(levels));
}

Rating one_limit() {
    Rating limits;
    limits.photometers = {
        {.name = "eye", .on = "fixture", .position_m = {1.3, 0.35, 1.2}, .faces = PhotometerFacing::forward, .why = ""},
        {.name = "mirror", .on = "fixture", .position_m = {1.9, 0.9, 1.0}, .faces = PhotometerFacing::backward, .why = ""}};
    limits.limits = {{"near", {{15.0, 60.0, 2.0, {}}, {60.0, 120.0, 0.5, {}}}, Known::assumed, ""}};
    RatingRow row;
    row.photometers = {"eye"};
    row.limits = "near";
    limits.rows = {row};
    return limits;
}

struct Masked : testing::Test {
    OneLampStraight straight{even_cd, 1.0};
    Rating limits = one_limit();
    Masked() { straight.drive.seeing.visibility = VisibilityParameters{}; }
    Moment moment(const std::shared_ptr<const LampFile>& file) {
        straight.drive.lamp_sets.front().lamps.front().file = file;
        return moment_at(start(straight.drive), straight.drive, straight.route, straight.drive.lamp_sets.front());
    }
    MaskLight light(const MaskPlaces& places, const Moment& moment) const {
        return MaskScene(straight.drive, straight.route, limits, places, default_targets().front(), moment)
            .light(moment, VisibilityFold(straight.drive, straight.route));
    }
    /// Who stands 100 m before the lamp on the other lane, or so far to the left, and looks towards it, or away.
    void stand(bool oncoming, double left_m = 3.5) {
        Pose pose = straight.route.pose(straight.drive.bumper_m + 100.0, left_m);
        if (oncoming)
            pose.axes = pose.axes * axes_from_angles(pi, 0.0, 0.0);
        RoadUser user;
        user.name = "other";
        user.track = std::make_shared<const Track>(std::vector<TrackPoint>{{0.0, pose, 0.0}, {10.0, pose, 0.0}});
        straight.drive.traffic = {user};
    }
};

/// A dark column from H 0 to 1 degrees takes a wedge out of lane and verge: over its area I / d^2 adds up to I theta ln(to / from).
TEST_F(Masked, ADarkColumnTakesAWedgeOfLight) {
    const MaskPlaces fine{.row_m = 0.5, .across_m = 0.02};
    const MaskLight full = light(fine, moment(columns_dark(0, 0))), dark = light(fine, moment(columns_dark(20, 1)));
    const double area_m2 = (fine.to_m - fine.from_m) * (3.5 + fine.verge_m);
    const double lost = even_cd * radians(1.0) * std::log(fine.to_m / fine.from_m) / area_m2;
    EXPECT_NEAR(full.both_lx - dark.both_lx, lost, 0.003 * lost);
    // From where it leaves the lane, 1.75 m to the right, the rest lies on the verge.
    const double leaves_m = 1.75 / std::tan(radians(1.0)), theta = radians(1.0);
    const double on_lane = even_cd * (theta * std::log(leaves_m / fine.from_m) + 1.75 * (1.0 / leaves_m - 1.0 / fine.to_m)) / (180.0 * 3.5);
    EXPECT_NEAR(full.lane_lx - dark.lane_lx, on_lane, 0.003 * on_lane);
    EXPECT_NEAR(full.both_lx * area_m2, full.lane_lx * 180.0 * 3.5 + full.verge_lx * 180.0 * 3.0, 1e-6);
    // The usual cells are coarser, and tell as much.
    const MaskLight usual_full = light({}, moment(columns_dark(0, 0))), usual_dark = light({}, moment(columns_dark(20, 1)));
    EXPECT_NEAR(usual_full.both_lx - usual_dark.both_lx, lost, 0.05 * lost);
}

TEST_F(Masked, TheVergeIsOnTheKerbsSide) {
    const std::shared_ptr<const LampFile> left_dark = columns_dark(0, 20);
    EXPECT_GT(light({}, moment(left_dark)).verge_lx, 1.0);
    EXPECT_EQ(light({.left_hand = true}, moment(left_dark)).verge_lx, 0.0);
}

TEST_F(Masked, AnOncomingEyeGetsTheLightAcrossItsGazeAndHasALimit) {
    stand(true);
    const MaskLight found = light({}, moment(columns_dark(0, 0)));
    ASSERT_EQ(found.eyes.size(), 1U);
    const double along = 100.0 - 1.3, beside = 3.5 - 0.35, up = 1.2 - 0.65;
    const double d = std::sqrt(along * along + beside * beside + up * up);
    EXPECT_NEAR(found.eyes[0].distance_m, std::hypot(along, beside), 1e-6);
    EXPECT_NEAR(found.eyes[0].lx, even_cd * along / (d * d * d), 1e-6);
    EXPECT_EQ(found.eyes[0].limit_lx, 0.5);
    ASSERT_EQ(found.walkers.size(), 1U);
    EXPECT_NEAR(found.walkers[0].ahead_m, 100.0 - 3.6, 1e-3) << "level with the front, 3.6 m before its rear axle";
    EXPECT_GT(found.walkers[0].left.number().value(), 0.0);
    // Dark from H -4 to -1 degrees, the lamp lights neither the eye nor who stands at the left edge.
    const MaskLight dark = light({}, moment(columns_dark(16, 3)));
    EXPECT_NEAR(dark.eyes[0].lx, 0.0, 1e-6);
    EXPECT_LT(dark.walkers[0].left.number().value_or(0.0), found.walkers[0].left.number().value());
    EXPECT_EQ(dark.walkers[0].right, found.walkers[0].right);
}

TEST_F(Masked, ThePrecedingCarHasMirrorsAndNoPedestrianBesideIt) {
    stand(false);
    const MaskLight found = light({}, moment(columns_dark(0, 0)));
    ASSERT_EQ(found.eyes.size(), 1U);
    EXPECT_NEAR(found.eyes[0].distance_m, std::hypot(101.9, 3.5 + 0.9), 1e-6);
    EXPECT_FALSE(found.eyes[0].limit_lx) << "no row has its mirrors";
    EXPECT_TRUE(found.walkers.empty());
}

/// From the left lane of the motorway the verge lies beyond the right one: light from H 0 to 5 degrees meets that lane, but no verge yet.
TEST_F(Masked, TheVergeLiesBeyondTheOtherLanes) {
    straight.network = read_opendrive(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/roads/motorway.xodr");
    straight.route = Route(straight.network, {"1", -3, 300.0});
    const MaskLight found = light({.to_m = 50.0}, moment(columns_dark(25, 15)));
    EXPECT_GT(found.lane_lx, 1.0);
    EXPECT_EQ(found.verge_lx, 0.0);
}

/// A lamp of 1000 cd on the front of the oncoming car, seen beside the target that the driver looks at, by the general equation.
TEST_F(Masked, OtherLampsVeilThePedestrian) {
    stand(true);
    Moment lit = moment(columns_dark(0, 0));
    const MaskLight clear = light({}, lit);
    LitLamp lamp;
    lamp.file = tests::file_of(tests::even_table(1000.0));
    lamp.pose = lit.bodies.at(0).pose;
    lamp.pose.position_m = to_parent(lamp.pose, {3.6, 0.0, 0.65});
    lamp.body = 0;
    lit.other_lamps = {lamp};
    const MaskLight veiled = light({}, lit);
    ASSERT_EQ(veiled.walkers.size(), 1U);
    const double ahead_m = veiled.walkers[0].ahead_m, along = straight.drive.bumper_m + ahead_m - 1.3;
    const glm::dvec3 to_target{along, -1.75 - 0.35, 0.1 - 1.2}, to_lamp{along, 3.5 - 0.35, 0.65 - 1.2};
    const double theta = angle_between_deg(to_target, to_lamp);
    const double lx = 1000.0 / glm::dot(to_lamp, to_lamp) * std::cos(radians(theta));
    const double veil = lx * (10.0 / std::pow(theta, 3.0) + (5.0 / (theta * theta) + 0.05 / theta) * (1.0 + std::pow(0.4, 4.0)) + 0.00125);
    const double level = VisibilityFold(straight.drive, straight.route)
                             .level_at(lit, default_targets().front(), Across::right_edge, ahead_m, veil)
                             .number()
                             .value();
    EXPECT_NEAR(veiled.walkers[0].right.number().value(), level, 1e-6 * level);
    EXPECT_LT(level, 0.9 * clear.walkers[0].right.number().value());
    // Light from H -1 to 0 degrees leaves the target's background dark: glare makes its level no better known.
    lit.lamps.front().file = columns_dark(20, 20);
    EXPECT_FALSE(light({}, lit).walkers[0].right.number());
}

/// From the rear of the car ahead on, 99.1 m before the lamp, he shades 0.9 m to each side, and ever more behind him.
TEST_F(Masked, WhatLiesInSomebodysShadowIsNoLoss) {
    const MaskPlaces behind{.from_m = 110.0, .row_m = 0.5, .across_m = 0.02, .above_m = 0.65};
    const std::shared_ptr<const LampFile> full = columns_dark(0, 0);
    double expected = 0.0;
    for (double d = 110.25; d < 200.0; d += 0.5)
        expected += even_cd / (d * d) * (1.0 - 0.9 * d / 99.1 / 1.75) / 180.0;
    stand(false, 0.0);
    EXPECT_NEAR(light(behind, moment(full)).lane_lx, expected, 0.005 * expected);
}

/// The oncoming car begins behind the crest: no light reaches it, whatever the lamps do.
TEST(OverACrest, NobodyGetsLightWhoIsHidden) {
    Drive drive = read_drive(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/drives/adaptive-crest.yaml");
    std::erase_if(drive.lamp_sets, [](const LampSet& lamp_set) { return lamp_set.name != "matrix"; });
    drive.seeing.visibility = VisibilityParameters{};
    const Stage stage(std::move(drive));
    const LampSet& lamp_set = stage.drive.lamp_sets.front();
    const Moment moment = moments_at({0}, stage, lamp_set).front();
    ASSERT_TRUE(moment.bodies.at(0).visible);
    ASSERT_GT(facing_lx(seen_lamps(moment, to_parent(moment.bodies[0].pose, {1.5, 0.0, 1.1}))), 0.0) << "as the crow flies";
    ControlFold fold(stage.drive, stage.route);
    fold.add(moment, lamp_set);
    EXPECT_EQ(value(fold.readings(), "control_others_max_lx"), 0.0);
    Rating limits = one_limit();
    const VisibilityFold visibility(stage.drive, stage.route);
    const auto light = [&](const Moment& now) {
        return MaskScene(stage.drive, stage.route, limits, {}, default_targets().front(), now).light(now, visibility);
    };
    const MaskLight found = light(moment);
    ASSERT_FALSE(found.eyes.empty());
    EXPECT_EQ(found.eyes[0].lx, 0.0);
    // Nor does it veil who stands beside another one, on this side of the crest and without lamps.
    Moment near = moment;
    near.bodies.at(1).pose = stage.route.pose(moment.distance_m + 60.0, 3.5);
    near.bodies[1].pose.axes = near.bodies[1].pose.axes * axes_from_angles(pi, 0.0, 0.0);
    std::erase_if(near.other_lamps, [](const LitLamp& lamp) { return lamp.body == 1; });
    ASSERT_FALSE(near.other_lamps.empty());
    Moment dark = near;
    dark.other_lamps.clear();
    ASSERT_EQ(light(near).walkers.size(), 1U);
    EXPECT_EQ(light(near).walkers[0].right, light(dark).walkers[0].right);
}

} // namespace
} // namespace fernlicht
