#include "scenarios/light/quick_light.h"

#include "scenarios/light/light.h"

#include <gtest/gtest.h>
#include <random>

namespace fernlicht {
namespace {

/// Uneven axes with a step of intensity, as cut-offs have.
CandelaTable steep_table() {
    CandelaTable table{{-40.0, -10.0, -1.0, 0.0, 0.2, 7.0, 35.0}, {-20.0, -5.0, -0.6, -0.5, 0.0, 8.0}, {}, {}, BetweenSamples::linear_cd};
    for (std::size_t v = 0; v < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            table.cd.push_back(v < 3 ? 9000.0 + 1000.0 * static_cast<double>((3 * h + v) % 5) : 40.0 * static_cast<double>(h));
    return table;
}

LitLamp lamp_with(CandelaTable table, const glm::dvec3& position_m, double yaw_rad, double pitch_rad) {
    auto file = std::make_shared<LampFile>();
    file->table = std::move(table);
    LitLamp lamp;
    lamp.file = std::move(file);
    lamp.pose = {position_m, axes_from_angles(yaw_rad, pitch_rad, 0.02)};
    lamp.intensity_factor = 0.7;
    return lamp;
}

Moment two_lamps(const CandelaTable& table) {
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = 0.2;
    moment.lamps = {lamp_with(table, {3.0, 0.6, 0.65}, 0.01, -0.01), lamp_with(table, {3.0, -0.6, 0.65}, -0.02, -0.012)};
    return moment;
}

TEST(QuickLight, BoundsHoldTheIlluminanceAndAreNarrow) {
    const Moment moment = two_lamps(steep_table());
    const QuickLight light(moment);
    std::mt19937_64 chance(7);
    std::uniform_real_distribution<double> along(-5.0, 120.0), across(-40.0, 40.0), up(-3.0, 4.0), tilt(-0.3, 0.3);
    int unknown = 0;
    for (int i = 0; i < 200000; ++i) {
        const glm::dvec3 point{along(chance), across(chance), up(chance)};
        const glm::dvec3 normal = axes_from_angles(0.3, tilt(chance), tilt(chance))[2];
        const std::pair<LuxBounds, double> found[]{{light.surface_lx(point, normal, 0.0), surface_illuminance_lx(moment, point, normal)},
                                                   {light.target_lx(point), target_illuminance_lx(moment, point)}};
        for (const auto& [bounds, truth] : found) {
            if (!std::isfinite(bounds.high_lx)) {
                ++unknown;
                continue;
            }
            ASSERT_LE(bounds.low_lx, truth);
            ASSERT_GE(bounds.high_lx, truth);
            // 1e5 cd per degree of cut-off times 7e-6 degrees, of two lamps: 1 cd.
            const double d2 = std::min(glm::dot(point - moment.lamps[0].pose.position_m, point - moment.lamps[0].pose.position_m),
                                       glm::dot(point - moment.lamps[1].pose.position_m, point - moment.lamps[1].pose.position_m));
            ASSERT_LE(bounds.high_lx - bounds.low_lx, 3.0 / d2);
        }
    }
    EXPECT_LT(unknown, 8000) << "only what is steeper than 30 degrees or on the border of the table";
}

// The far right lane of a cut-off: from a degree below it to a degree above, in steps that lie within the angles' error as well.
TEST(QuickLight, BoundsHoldAcrossACutOff) {
    const Moment moment = two_lamps(steep_table());
    const QuickLight light(moment);
    for (const double step : {1e-3, 1e-7})
        for (int i = -1000; i <= 1000; ++i) {
            const glm::dvec3 point{60.0, 0.3, 0.65 - 57.0 * std::tan(0.01 + radians(0.55)) + step * i};
            const LuxBounds bounds = light.target_lx(point);
            const double truth = target_illuminance_lx(moment, point);
            ASSERT_LE(bounds.low_lx, truth);
            ASSERT_GE(bounds.high_lx, truth);
        }
}

TEST(QuickLight, KnowsTheDarkAndWhatItDoesNotKnow) {
    Moment moment = two_lamps(steep_table());
    moment.daylight.horizontal_illuminance_lx = 0.0;
    const LuxBounds behind = QuickLight(moment).target_lx({-10.0, 0.0, 0.5}), beside = QuickLight(moment).target_lx({13.0, 30.0, 0.5});
    EXPECT_EQ(behind.high_lx, 0.0);
    EXPECT_EQ(beside.high_lx, 0.0) << "outside the table there is no light";
    EXPECT_FALSE(std::isfinite(QuickLight(moment).target_lx({3.2, 0.6, 0.0}).high_lx)) << "steeper than 30 degrees";
    EXPECT_FALSE(std::isfinite(QuickLight(moment).target_lx(moment.lamps[0].pose.position_m).high_lx)) << "in the lamp";
    const LuxBounds far = QuickLight(moment).surface_lx({63.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1.0);
    EXPECT_EQ(far.low_lx, 0.0);
    EXPECT_LT(far.high_lx, 1.0) << "13 000 cd x 0.7 x 2 lamps x 0.65 / 60^3 = 0.055 lx at most";

    CandelaTable logarithmic = steep_table(), with_gap = steep_table();
    logarithmic.rule = BetweenSamples::log_cd;
    with_gap.gaps.assign((with_gap.h_deg.size() - 1) * (with_gap.v_deg.size() - 1), 0);
    for (const CandelaTable& table : {logarithmic, with_gap})
        EXPECT_FALSE(std::isfinite(QuickLight(two_lamps(table)).target_lx({23.0, 0.0, 0.5}).high_lx));
}

// At the lamp's own place there is no direction and no distance: 0 / 0 in every term, and no light in the end.
TEST(Light, IsANumberInTheLampItself) {
    const Moment moment = two_lamps(steep_table());
    for (const LitLamp& lamp : moment.lamps) {
        EXPECT_TRUE(std::isfinite(target_illuminance_lx(moment, lamp.pose.position_m)));
        EXPECT_TRUE(std::isfinite(surface_illuminance_lx(moment, lamp.pose.position_m, {-1.0, 0.0, 0.0})));
    }
}

} // namespace
} // namespace fernlicht
