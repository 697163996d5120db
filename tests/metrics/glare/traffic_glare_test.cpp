// Lamps of others in the own driver's eyes, by hand.
#include "metrics/glare/eye_light.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// 5000 cd in all directions ahead, 50 m before the eye and 3.5 m to the left, on body 0.
Moment oncoming() {
    auto file = std::make_shared<LampFile>();
    file->table = {{-80.0, 80.0}, {-80.0, 80.0}, {5000.0, 5000.0, 5000.0, 5000.0}, {}, BetweenSamples::linear_cd};
    Moment moment;
    moment.other_lamps = {{"other left", file, {{50.0, 3.5, 1.2}, axes_from_angles(pi, 0.0, 0.0)}, 1.0, {}, 0.0, 0, {0.16, 0.12}}};
    moment.bodies = {{"other", {{53.0, 3.5, 0.0}, axes_from_angles(pi, 0.0, 0.0)}, true, 0.0}};
    return moment;
}

const std::vector<BodyBox> cars(2, BodyBox{{4.5, 1.8, 1.45}, -0.9});

TEST(TrafficGlare, IsIntensityOverDistanceSquaredAcrossTheGaze) {
    const std::vector<GlareSource> seen = traffic_glare(oncoming(), {0.0, 0.0, 1.2}, {1.0, 0.0, 0.0}, cars);
    ASSERT_EQ(seen.size(), 1U);
    const double d2 = 50.0 * 50.0 + 3.5 * 3.5;
    EXPECT_NEAR(seen[0].eye_lx, 5000.0 / d2 * 50.0 / std::sqrt(d2), 1e-9);
    EXPECT_NEAR(seen[0].theta_deg, degrees(std::atan(3.5 / 50.0)), 1e-9);
}

TEST(TrafficGlare, IsHiddenByAnotherCarAndNotByItsOwn) {
    Moment moment = oncoming();
    const auto count = [&] { return traffic_glare(moment, {0.0, 0.0, 1.2}, {1.0, 0.0, 0.0}, cars).size(); };
    moment.bodies.push_back({"between", {{30.0, 2.1, 0.0}, glm::dmat3(1.0)}, true, 0.0});
    EXPECT_EQ(count(), 0U);
    moment.bodies[1].visible = false;
    EXPECT_EQ(count(), 1U);
    moment.bodies[1] = {"beside", {{30.0, 5.0, 0.0}, glm::dmat3(1.0)}, true, 0.0};
    EXPECT_EQ(count(), 1U);
}

TEST(TrafficGlare, KnowsWhereABoxEnds) {
    const BodyBox box{{4.0, 2.0, 1.5}, -1.0}; // x -1..3, y -1..1, z 0..1.5
    EXPECT_TRUE(box_hides(box, {}, {-5.0, 0.0, 1.0}, {5.0, 0.0, 1.0}));
    EXPECT_FALSE(box_hides(box, {}, {-5.0, 0.0, 1.6}, {5.0, 0.0, 1.6}));
    EXPECT_FALSE(box_hides(box, {}, {-5.0, 0.0, 1.0}, {-1.1, 0.0, 1.0})) << "ends before it";
    EXPECT_FALSE(box_hides(box, {}, {3.1, 0.0, 1.0}, {9.0, 0.0, 1.0})) << "begins behind it";
}

} // namespace
} // namespace fernlicht
