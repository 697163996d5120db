// Lamps as eyes meet them, against hand-worked places on a level road, and what a crest hides.
#include "metrics/glare/eye_light.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

LitLamp lamp_at(const glm::dvec3& position_m, double cd) {
    auto file = std::make_shared<LampFile>();
    file->table = {{-180.0, 180.0}, {-90.0, 90.0}, {cd, cd, cd, cd}, {}, BetweenSamples::linear_cd};
    LitLamp lamp;
    lamp.name = "left";
    lamp.file = std::move(file);
    lamp.pose.position_m = position_m;
    return lamp;
}

Moment moment_with(std::vector<LitLamp> lamps) {
    Moment moment;
    moment.lamps = std::move(lamps);
    return moment;
}

// 1000 cd at 0.65 m, an eye 50 m ahead, 3.5 m to the left, 1.1 m up: d^2 = 2500 + 12.25 + 0.2025 = 2512.4525; theta = atan(sqrt(12.4525) /
// 50) = 4.0370 degrees.
TEST(EyeLight, AnOncomingEyeOnALevelRoad) {
    const glm::dvec3 eye{50.0, 3.5, 1.1}, gaze{-1.0, 0.0, 0.0};
    const auto lamps = seen_lamps(moment_with({lamp_at({0.0, 0.0, 0.65}, 1000.0)}), eye);
    ASSERT_EQ(lamps.size(), 1U);
    EXPECT_NEAR(lamps[0].facing_lx, 1000.0 / 2512.4525, 1e-12);
    const GlareSource source = glare_source(lamps[0], eye, gaze);
    EXPECT_NEAR(source.theta_deg, 4.0370, 5e-5);
    EXPECT_NEAR(source.eye_lx, 1000.0 * 50.0 / std::pow(2512.4525, 1.5), 1e-12); // cos(theta) = 50 / d
    EXPECT_EQ(glare_source(lamps[0], eye, -gaze).eye_lx, 0.0) << "from behind the eye";
}

// The lamp 10 m behind a mirror, the eye 0.5 m before the mirror: as from an image 10.5 m away, of which 0.8 is left.
TEST(EyeLight, AMirrorShowsTheLampBehindItself) {
    const glm::dvec3 mirror{0.3, 0.4, 1.0}, eye{0.0, 0.0, 1.0};
    const auto lamps = seen_lamps(moment_with({lamp_at({-9.7, 0.4, 1.0}, 500.0)}), mirror);
    const GlareSource source = mirrored_source(lamps[0], mirror, 0.8, eye, {1.0, 0.0, 0.0});
    EXPECT_NEAR(source.theta_deg, degrees(std::atan2(0.4, 0.3)), 1e-12);
    EXPECT_NEAR(source.eye_lx, 0.8 * 500.0 / (10.5 * 10.5) * 0.6, 1e-12); // cos = 0.3 / 0.5
}

TEST(EyeLight, AnglesAreExactNearTheLineOfSight) {
    EXPECT_NEAR(angle_between_deg({1.0, 0.0, 0.0}, {1.0, 1e-9, 0.0}), degrees(1e-9), 1e-20);
    EXPECT_DOUBLE_EQ(angle_between_deg({1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}), 180.0);
}

/// Our country road rises to a crest of 2500 m radius with its top about 500 m along.
TEST(EyeLight, ACrestHidesLampsAndALevelRoadDoesNot) {
    const std::filesystem::path roads = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/roads";
    const RoadNetwork level = read_opendrive(roads / "straight.xodr"), hilly = read_opendrive(roads / "country.xodr");
    const Route straight(level, {}), country(hilly, {});
    const auto hidden = [](const Route& route, double from_m, double to_m, double lamp_m, double eye_m) {
        const auto above = [&](double at_m, double height_m) {
            const Pose surface = route.pose(at_m);
            return surface.position_m + height_m * surface.up();
        };
        return road_hides(route, from_m, to_m, above(from_m, lamp_m), above(to_m, eye_m));
    };
    for (const double to_m : {10.0, 100.0, 900.0})
        EXPECT_FALSE(hidden(straight, 0.0, to_m, 0.65, 1.1)) << to_m;
    EXPECT_TRUE(hidden(straight, 0.0, 100.0, 0.65, -0.5)) << "an eye in the ground";
    // Over a crest of radius r two points of heights a and b see each other within sqrt(2 r a) + sqrt(2 r b) = 57.0 + 74.2 m.
    EXPECT_FALSE(hidden(country, 440.0, 560.0, 0.65, 1.1));
    EXPECT_TRUE(hidden(country, 425.0, 575.0, 0.65, 1.1));
    EXPECT_FALSE(hidden(country, 425.0, 575.0, 2.0, 1.1)) << "a lamp of 2 m sees over it: 100 + 74.2 m";
}

} // namespace
} // namespace fernlicht
